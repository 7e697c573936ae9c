//! Distance accuracy and distance repeatability, 7.3.2 and 7.3.3.
//!
//! With `D_j = |P_1j − P_2j|` between the j-th visits of two configurations and the commanded
//! `D_c`, `AD = D̄ − D_c` and `RD = ±3 √(Σ (D_j − D̄)²/(n − 1))`; for orientations
//! `D_a = a_1 − a_2`.

use abbe::analysis::sampling::vectors::distance;
use serde::Serialize;

use super::super::errors::Visit;
use super::mean_and_max::MeanAndMax;
use super::visits::{Visits, deviation};

/// Pairs of configurations with equal numbers of visits.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Distances {
    /// Number of pairs.
    pub pairs: usize,
    /// Absolute value of `AD_p`.
    pub ad: MeanAndMax,
    /// Absolute values of `AD_a`, `AD_b`, `AD_c`, in rad.
    pub ad_turns: Option<[MeanAndMax; 3]>,
    /// `RD_p`.
    pub rd: MeanAndMax,
    /// `RD_a`, `RD_b`, `RD_c`, in rad.
    pub rd_turns: Option<[MeanAndMax; 3]>,
}

/// Number of configurations whose pairs are evaluated.
const CONFIGURATIONS: usize = 20;

impl Distances {
    /// Returns none if no two configurations have equal numbers of visits.
    pub(super) fn new(groups: &[Visits<'_>], oriented: bool) -> Option<Self> {
        let groups = &groups[..groups.len().min(CONFIGURATIONS)];
        let pairs = groups.iter().enumerate().flat_map(|(i, a)| groups[..i].iter().map(move |b| (a, b)));
        let pairs: Vec<_> = pairs.filter(|(a, b)| a.len() == b.len()).collect();
        let (mut ad, mut rd, mut ad_turns, mut rd_turns) = (Vec::new(), Vec::new(), Vec::new(), Vec::new());
        for (a, b) in &pairs {
            let visits = || a.iter().zip(b.iter());
            // D_j − D_c: commands of one configuration can differ by the resolution of the joints.
            let distances: Vec<f64> = visits()
                .map(|(a, b)| distance(a.point, b.point) - distance(commanded(a), commanded(b)))
                .collect();
            ad.push((distances.iter().sum::<f64>() / distances.len() as f64).abs());
            rd.push(3.0 * deviation(&distances));
            let turn =
                |axis: usize| visits().map(|(a, b)| a.turn()[axis] - b.turn()[axis]).collect::<Vec<_>>();
            let turns = [0, 1, 2].map(turn);
            ad_turns.push([0, 1, 2].map(|k| (turns[k].iter().sum::<f64>() / turns[k].len() as f64).abs()));
            rd_turns.push([0, 1, 2].map(|k| 3.0 * deviation(&turns[k])));
        }
        Some(Self {
            pairs: pairs.len(),
            ad: MeanAndMax::new(ad)?,
            ad_turns: MeanAndMax::of_turns(&ad_turns).filter(|_| oriented),
            rd: MeanAndMax::new(rd)?,
            rd_turns: MeanAndMax::of_turns(&rd_turns).filter(|_| oriented),
        })
    }
}

fn commanded(row: &Visit) -> [f64; 3] {
    std::array::from_fn(|k| row.point[k] - row.error[k])
}
