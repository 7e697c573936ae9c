//! Characteristics of ISO 9283:1998 from repeated visits.
//!
//! Errors `e_j` of visit j are real minus commanded. Orientation errors are rotation vectors from
//! the commanded to the real orientation: to first order, the deviations of the standard's angles
//! a, b, c about x, y, z.

mod directions;
mod distances;
mod drift;
mod mean_and_max;
mod pose;
#[cfg(test)]
mod tests;
mod visits;

use serde::Serialize;

use super::errors::Visit;
pub use directions::Directions;
pub use distances::Distances;
pub use drift::Drift;
pub use mean_and_max::MeanAndMax;
use visits::{Visits, mean, visits};

/// Characteristics of configurations with more than one visit.
#[derive(Clone, Debug, Serialize)]
pub struct Repeated {
    /// Number of configurations.
    pub configurations: usize,
    /// Number of visits.
    pub visits: usize,
    /// Smallest number of visits of a configuration; the standard requires 30.
    pub fewest: usize,
    /// Pose accuracy AP_p, 7.2.1; none without repeated visits.
    pub ap: Option<MeanAndMax>,
    /// Absolute values of AP_a, AP_b, AP_c, 7.2.1, in rad; none without measured orientations.
    pub ap_turns: Option<[MeanAndMax; 3]>,
    /// Pose repeatability RP_l, 7.2.2.
    pub rp: Option<MeanAndMax>,
    /// RP_a, RP_b, RP_c, 7.2.2, in rad.
    pub rp_turns: Option<[MeanAndMax; 3]>,
    /// Three standard deviations about the barycentres, along x, y, z, in the length unit.
    pub three_sigma: Option<[f64; 3]>,
    /// Multi-directional pose accuracy variation, 7.2.3; none without several directions of
    /// approach.
    pub directions: Option<Directions>,
    /// Distance accuracy and repeatability, 7.3.
    pub distances: Option<Distances>,
    /// Drift of pose characteristics, 7.6.
    pub drift: Option<Drift>,
}

/// Returns the errors of each visit relative to the barycentre of its configuration.
pub(super) fn about_barycentres(rows: &[Visit]) -> Vec<[f64; 3]> {
    visits(rows).iter().flat_map(about).collect()
}

fn about(visits: &Visits) -> Vec<[f64; 3]> {
    let centre = mean(visits, |row| row.position());
    visits.iter().map(|row| std::array::from_fn(|k| row.error[k] - centre[k])).collect()
}

/// Computes all characteristics that the rows admit; `oriented` if orientations were measured.
pub(super) fn repeated(rows: &[Visit], oriented: bool) -> Repeated {
    let groups = visits(rows);
    let every: Vec<pose::Characteristics> =
        groups.iter().map(|group| pose::Characteristics::new(group)).collect();
    let turns = |value: fn(&pose::Characteristics) -> [f64; 3]| {
        let values: Vec<[f64; 3]> = every.iter().map(value).collect();
        MeanAndMax::of_turns(&values).filter(|_| oriented)
    };
    let visits: usize = groups.iter().map(Vec::len).sum();
    // The barycentre of each configuration takes one degree of freedom.
    let freedom = visits.saturating_sub(groups.len()) as f64;
    let about: Vec<[f64; 3]> = groups.iter().flat_map(about).collect();
    let three_sigma =
        std::array::from_fn(|k| 3.0 * (about.iter().map(|e| e[k] * e[k]).sum::<f64>() / freedom).sqrt());
    Repeated {
        configurations: groups.len(),
        visits,
        fewest: groups.iter().map(Vec::len).min().unwrap_or_default(),
        ap: MeanAndMax::new(every.iter().map(|pose| pose.ap)),
        ap_turns: turns(|pose| pose.ap_turns),
        rp: MeanAndMax::new(every.iter().map(|pose| pose.rp)),
        rp_turns: turns(|pose| pose.rp_turns),
        three_sigma: (freedom > 0.0).then_some(three_sigma),
        directions: Directions::new(rows, oriented),
        distances: Distances::new(&groups, oriented),
        drift: Drift::new(&groups, oriented),
    }
}
