//! Normal distribution.

use core::f64::consts::{FRAC_1_SQRT_2, TAU};

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
