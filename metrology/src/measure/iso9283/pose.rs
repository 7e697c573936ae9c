//! Pose accuracy and pose repeatability of one configuration, 7.2.1 and 7.2.2.
//!
//! `AP_p = |ē|` is the distance of the barycentre from the commanded point, `AP_a = ā − a_c`; with
//! `l_j = |e_j − ē|`, `RP_l = l̄ + 3 S_l`, and `RP_a = ±3 S_a`.

use super::super::errors::Visit;
use super::visits::{deviation, mean};
use abbe::analysis::sampling::norm;

/// Characteristics of one configuration.
pub(super) struct Characteristics {
    pub(super) ap: f64,
    /// Absolute values of AP_a, AP_b, AP_c.
    pub(super) ap_turns: [f64; 3],
    pub(super) rp: f64,
    pub(super) rp_turns: [f64; 3],
}

impl Characteristics {
    pub(super) fn new(visits: &[&Visit]) -> Self {
        let centre = mean(visits, Visit::position);
        let distance = |row: &&Visit| {
            let error = row.position();
            norm(std::array::from_fn(|k| error[k] - centre[k]))
        };
        let lengths: Vec<f64> = visits.iter().map(distance).collect();
        let turns = |axis: usize| visits.iter().map(|row| row.turn()[axis]).collect::<Vec<_>>();
        Self {
            ap: norm(centre),
            ap_turns: mean(visits, Visit::turn).map(f64::abs),
            rp: lengths.iter().sum::<f64>() / lengths.len() as f64 + 3.0 * deviation(&lengths),
            rp_turns: [0, 1, 2].map(|axis| 3.0 * deviation(&turns(axis))),
        }
    }
}
