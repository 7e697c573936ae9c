//! What ISO 9283:1998 says of configurations that were visited again.
//!
//! Errors are real minus commanded, `e_j` of visit j; turns are the rotation vector from the commanded orientation to the real one:
//! to first order the deviations of the standard's angles a, b, c about x, y, z.

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

/// Configurations that were visited more than once.
#[derive(Clone, Debug, Serialize)]
pub struct Repeated {
    /// How many there are.
    pub configurations: usize,
    /// How many visits they had.
    pub visits: usize,
    /// The fewest visits of a configuration that counts; the standard asks for 30.
    pub fewest: usize,
    /// Pose accuracy AP_p, 7.2.1; none without repeated configurations.
    pub ap: Option<MeanAndMax>,
    /// AP_a, AP_b, AP_c, 7.2.1, either sign: rad; none where orientations were not measured.
    pub ap_turns: Option<[MeanAndMax; 3]>,
    /// Pose repeatability RP_l, 7.2.2.
    pub rp: Option<MeanAndMax>,
    /// RP_a, RP_b, RP_c, 7.2.2: rad.
    pub rp_turns: Option<[MeanAndMax; 3]>,
    /// Three standard deviations about the barycentres, along x, y, z.
    pub three_sigma: Option<[f64; 3]>,
    /// Multi-directional variation, 7.2.3: where configurations were approached from several directions.
    pub directions: Option<Directions>,
    /// Distance accuracy and repeatability, 7.3.
    pub distances: Option<Distances>,
    /// Drift of pose characteristics, 7.6.
    pub drift: Option<Drift>,
}

/// The errors of every visit about the barycentre of its configuration.
pub(super) fn about_barycentres(rows: &[Visit]) -> Vec<[f64; 3]> {
    visits(rows).iter().flat_map(about).collect()
}

fn about(visits: &Visits) -> Vec<[f64; 3]> {
    let centre = mean(visits, |row| row.position());
    visits.iter().map(|row| std::array::from_fn(|k| row.error[k] - centre[k])).collect()
}

/// All characteristics that the rows admit; `oriented` where orientations were measured.
pub(super) fn repeated(rows: &[Visit], oriented: bool) -> Repeated {
    let groups = visits(rows);
    let every: Vec<pose::Characteristics> =
        groups.iter().map(|group| pose::Characteristics::new(group)).collect();
    let turns = |value: fn(&pose::Characteristics) -> [f64; 3]| {
        let values: Vec<[f64; 3]> = every.iter().map(value).collect();
        MeanAndMax::of_turns(&values).filter(|_| oriented)
    };
    let visits: usize = groups.iter().map(Vec::len).sum();
    // One degree of freedom of each configuration goes into its barycentre.
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
