//! Position errors, by their mean and their largest.

use abbe::identify::Figures;
use serde::Serialize;

/// Position errors.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct Sizes {
    /// The mean of their norms.
    pub mean: f64,
    /// The standard error of that, configurations counted; none if there is only one.
    pub standard_error: Option<f64>,
    /// The root mean square.
    pub rms: f64,
    /// The largest.
    pub max: f64,
    /// What 95 % of them do not exceed.
    pub p95: f64,
}

impl From<Figures> for Sizes {
    fn from(Figures { mean, standard_error, rms, max, p95, .. }: Figures) -> Self {
        let standard_error = Some(standard_error).filter(|error| error.is_finite());
        Self { mean, standard_error, rms, max, p95 }
    }
}
