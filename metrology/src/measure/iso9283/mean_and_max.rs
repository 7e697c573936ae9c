//! Mean and maximum over all configurations.

use serde::Serialize;

/// Mean and maximum over all configurations, in the length unit or rad.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct MeanAndMax {
    /// The mean.
    pub mean: f64,
    /// The maximum.
    pub max: f64,
}

impl MeanAndMax {
    /// Returns none without values.
    pub(super) fn new(values: impl IntoIterator<Item = f64>) -> Option<Self> {
        let values: Vec<f64> = values.into_iter().collect();
        let max = values.iter().copied().reduce(f64::max)?;
        Some(Self { mean: values.iter().sum::<f64>() / values.len() as f64, max })
    }

    /// Computes both for each of three angles.
    pub(super) fn of_turns(values: &[[f64; 3]]) -> Option<[Self; 3]> {
        let [a, b, c] = [0, 1, 2].map(|axis| Self::new(values.iter().map(|value| value[axis])));
        Some([a?, b?, c?])
    }
}
