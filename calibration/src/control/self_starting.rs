//! Self-starting charts: standard normal scores of a series relative to its earlier numbers.

use super::distributions::normal_quantile;
use crate::identify::student_beyond;

/// Running mean and variance of a series.
///
/// `Q_k = Φ⁻¹(T_{k−2}(√((k−1)/k) (x_k − x̄_{k−1}) / s_{k−1}))`: for normal numbers of any mean and
/// standard deviation, these are independent and standard normal from the third on. Quesenberry,
/// *SPC Q charts for start-up processes*, 1991. A chart thus needs no reference period, and has its
/// stated false-alarm rate from the first day.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct SelfStarting {
    count: usize,
    mean: f64,
    squares: f64,
}

impl SelfStarting {
    /// Returns the standard normal score of the next number; 0 for the first two.
    pub fn next(&mut self, x: f64) -> f64 {
        let Self { count, mean, squares } = *self;
        let n = count as f64;
        let away = x - mean;
        let scatter = (squares / (n - 1.0) * (1.0 + 1.0 / n)).sqrt();
        let standard = match (count, away) {
            (0 | 1, _) | (_, 0.0) => 0.0,
            // Half of the two-sided probability.
            _ => {
                let beyond = student_beyond(away / scatter.max(1e-300), n - 1.0);
                -normal_quantile(0.5 * beyond).copysign(-away)
            }
        };
        let moved = mean + away / (n + 1.0);
        *self = Self { count: count + 1, mean: moved, squares: squares + away * (x - moved) };
        standard
    }
}

#[cfg(test)]
mod tests;
