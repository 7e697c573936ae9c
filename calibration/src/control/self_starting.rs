//! Self-starting charts: standard normal scores of a series relative to its earlier numbers, and
//! quantiles of the normal distribution.

use core::f64::consts::{FRAC_1_SQRT_2, TAU};

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

/// Returns the quantile of the standard normal distribution; limited to ±8.2 by double precision.
pub fn normal_quantile(probability: f64) -> f64 {
    if probability > 0.5 {
        return -normal_quantile(1.0 - probability);
    }
    let p = probability.max(1e-16);
    // Abramowitz and Stegun 26.2.23, accurate to 4.5e-4; then Halley's iterations on Φ(x) =
    // erfc(−x/√2)/2.
    let t = (-2.0 * p.ln()).sqrt();
    let above = 2.515_517 + t * (0.802_853 + t * 0.010_328);
    let below = 1.0 + t * (1.432_788 + t * (0.189_269 + t * 0.001_308));
    let mut x = above / below - t;
    for _ in 0..3 {
        let density = (-0.5 * x * x).exp() / TAU.sqrt();
        let step = (0.5 * libm::erfc(-x * FRAC_1_SQRT_2) - p) / density;
        x -= step / (1.0 + 0.5 * x * step);
    }
    x
}

#[cfg(test)]
mod tests;
