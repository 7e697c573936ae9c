//! Drift of pose characteristics, 7.6.
//!
//! Visits of a configuration in order of time, in groups of ten: `dAP = max |AP_{t=0} − AP_T|`,
//! `dRP = max |RP_{t=0} − RP_T|`.

use serde::Serialize;

use super::{MeanAndMax, Visits, pose::Characteristics};

/// Number of visits in a value of AP and RP, as in the standard.
const CYCLES: usize = 10;

/// Configurations with at least twenty visits.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Drift {
    /// Number of configurations.
    pub configurations: usize,
    /// Largest number of groups of one configuration.
    pub most: usize,
    /// `dAP_p`.
    pub dap: MeanAndMax,
    /// `dAP_a`, `dAP_b`, `dAP_c`, in rad.
    pub dap_turns: Option<[MeanAndMax; 3]>,
    /// `dRP_l`.
    pub drp: MeanAndMax,
    /// `dRP_a`, `dRP_b`, `dRP_c`, in rad.
    pub drp_turns: Option<[MeanAndMax; 3]>,
}

impl Drift {
    /// Returns none if no configuration has twenty visits.
    pub(super) fn new(groups: &[Visits<'_>], oriented: bool) -> Option<Self> {
        let series = |group: &Visits<'_>| {
            let blocks = group.chunks_exact(CYCLES).map(Characteristics::new);
            Some(blocks.collect::<Vec<_>>()).filter(|blocks| blocks.len() > 1)
        };
        let all: Vec<Vec<Characteristics>> = groups.iter().filter_map(series).collect();
        let largest = |value: &dyn Fn(&Characteristics) -> f64| {
            let drift = |blocks: &Vec<Characteristics>| {
                blocks.iter().map(|block| (value(block) - value(&blocks[0])).abs()).fold(0.0, f64::max)
            };
            MeanAndMax::new(all.iter().map(drift))
        };
        let turns = |value: fn(&Characteristics) -> [f64; 3]| {
            let [a, b, c] = [0, 1, 2].map(|axis| largest(&|block| value(block)[axis]));
            Some([a?, b?, c?]).filter(|_| oriented)
        };
        Some(Self {
            configurations: all.len(),
            most: all.iter().map(Vec::len).max()?,
            dap: largest(&|block| block.ap)?,
            dap_turns: turns(|block| block.ap_turns),
            drp: largest(&|block| block.rp)?,
            drp_turns: turns(|block| block.rp_turns),
        })
    }
}
