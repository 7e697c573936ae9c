//! Statistics of position errors.

use abbe::identify::Figures;
use serde::Serialize;

/// Statistics of the norms of position errors, in the length unit.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct Sizes {
    /// Mean norm.
    pub mean: f64,
    /// Standard error of the mean, by the number of configurations; `None` if there is only one.
    pub standard_error: Option<f64>,
    /// Root mean square.
    pub rms: f64,
    /// Largest norm.
    pub max: f64,
    /// 95th percentile.
    pub p95: f64,
}

impl From<Figures> for Sizes {
    fn from(Figures { mean, standard_error, rms, max, p95, .. }: Figures) -> Self {
        let standard_error = Some(standard_error).filter(|error| error.is_finite());
        Self { mean, standard_error, rms, max, p95 }
    }
}
