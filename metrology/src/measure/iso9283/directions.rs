//! Multi-directional pose accuracy variation, 7.2.3.
//!
//! `vAP_p = max |ḡ_h − ḡ_k|` over the barycentres of a configuration approached from directions h
//! and k; `vAP_a = max |ā_h − ā_k|`.

use abbe::analysis::sampling::norm;
use std::collections::BTreeMap;

use serde::Serialize;

use super::{super::errors::Visit, MeanAndMax, mean};

/// Configurations that were approached from several directions.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Directions {
    /// Number of configurations.
    pub configurations: usize,
    /// Smallest number of directions; the standard requires three.
    pub fewest: usize,
    /// Smallest number of visits from a direction; the standard requires 30.
    pub fewest_visits: usize,
    /// `vAP_p`.
    pub vap: MeanAndMax,
    /// `vAP_a`, `vAP_b`, `vAP_c`: rad.
    pub vap_turns: Option<[MeanAndMax; 3]>,
}

impl Directions {
    /// Returns none if no configuration was approached from two directions.
    pub(super) fn new(rows: &[Visit], oriented: bool) -> Option<Self> {
        let mut configurations: BTreeMap<u32, BTreeMap<u32, Vec<&Visit>>> = BTreeMap::new();
        for row in rows {
            let directions = configurations.entry(row.configuration).or_default();
            directions.entry(row.direction).or_default().push(row);
        }
        configurations.retain(|_, directions| directions.len() > 1);
        let (mut positions, mut turns) = (Vec::new(), Vec::new());
        for directions in configurations.values() {
            let centres = |value: fn(&Visit) -> [f64; 3]| {
                directions.values().map(|visits| mean(visits, value)).collect::<Vec<_>>()
            };
            positions.push(largest(&centres(Visit::position), norm));
            let centres = centres(Visit::turn);
            turns.push([0, 1, 2].map(|axis| largest(&centres, |difference| difference[axis].abs())));
        }
        let every = || configurations.values().flat_map(BTreeMap::values).map(Vec::len);
        Some(Self {
            configurations: configurations.len(),
            fewest: configurations.values().map(BTreeMap::len).min()?,
            fewest_visits: every().min()?,
            vap: MeanAndMax::new(positions)?,
            vap_turns: MeanAndMax::of_turns(&turns).filter(|_| oriented),
        })
    }
}

/// Returns the largest difference of two values.
fn largest(values: &[[f64; 3]], size: impl Fn([f64; 3]) -> f64) -> f64 {
    let pairs = values.iter().enumerate().flat_map(|(i, a)| values[..i].iter().map(move |b| (a, b)));
    pairs.map(|(a, b)| size(std::array::from_fn(|k| a[k] - b[k]))).fold(0.0, f64::max)
}
