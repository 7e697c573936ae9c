//! Monte Carlo simulation on the exact chain, and quantiles of a sample with standard errors.

mod monte_carlo;
#[cfg(test)]
mod tests;

pub use monte_carlo::{MonteCarlo, monte_carlo};

/// Quantile of a sample.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Quantile {
    /// Probability: the share of the values at or below the quantile.
    pub probability: f64,
    /// Value, in the length unit.
    pub value: f64,
    /// Standard error of the value, in the length unit.
    pub standard_error: f64,
}

impl Quantile {
    /// Returns the quantile `x_⌈pN⌉` of N sorted values. The number of values below the true
    /// quantile is binomial with the standard deviation `d = √(N p (1 − p))`; the standard error is
    /// half the difference of the values at that many ranks to either side,
    /// `(x_{pN+d} − x_{pN−d}) / 2`, for any distribution.
    fn from_sorted(sorted: &[f64], probability: f64) -> Self {
        let count = sorted.len() as f64;
        let at = |rank: f64| {
            let index = (rank.ceil().max(1.0) as usize - 1).min(sorted.len().saturating_sub(1));
            sorted.get(index).copied().unwrap_or_default()
        };
        let rank = probability * count;
        let spread = (rank * (1.0 - probability)).sqrt();
        let standard_error = (at(rank + spread) - at(rank - spread)) / 2.0;
        Self { probability, value: at(rank), standard_error }
    }
}
