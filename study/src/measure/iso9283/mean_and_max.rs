//! A figure over all configurations.

use serde::Serialize;

/// Over all configurations.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct MeanAndMax {
    /// The mean.
    pub mean: f64,
    /// The largest.
    pub max: f64,
}

impl MeanAndMax {
    /// None of nothing.
    pub(super) fn new(values: impl IntoIterator<Item = f64>) -> Option<Self> {
        let values: Vec<f64> = values.into_iter().collect();
        let max = values.iter().copied().reduce(f64::max)?;
        Some(Self { mean: values.iter().sum::<f64>() / values.len() as f64, max })
    }

    /// Of the three turns, each by itself.
    pub(super) fn of_turns(values: &[[f64; 3]]) -> Option<[Self; 3]> {
        let [a, b, c] = [0, 1, 2].map(|axis| Self::new(values.iter().map(|value| value[axis])));
        Some([a?, b?, c?])
    }
}
