//! Improvement of one model over another.

use abbe::identify::Comparison;
use serde::Serialize;

/// Difference between the position errors of two models at the same points.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct Gain {
    /// Mean reduction of the error, in the length unit; negative if the second model is worse.
    pub mean: f64,
    /// Standard error of the mean, in the length unit, with configurations as independent samples;
    /// none for a single configuration.
    pub standard_error: Option<f64>,
    /// Probability of a mean at least as far from 0 by chance if both models are equally good:
    /// paired t-test.
    pub p: f64,
}

impl From<Comparison> for Gain {
    fn from(Comparison { gain, standard_error, p, .. }: Comparison) -> Self {
        Self { mean: gain + 0.0, standard_error: Some(standard_error).filter(|error| error.is_finite()), p }
    }
}
