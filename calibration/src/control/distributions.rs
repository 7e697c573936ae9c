//! Normal and Student's t distributions.

use core::f64::consts::{FRAC_1_SQRT_2, FRAC_2_PI, TAU};

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

/// Returns the two-sided tail probability of Student's t.
///
/// Abramowitz and Stegun 26.7.3 and 26.7.4, with θ = atan(t/√ν):
/// `1 − 2/π (θ + sin θ (cos θ + 2/3 cos³ θ + …))` for odd ν,
/// `1 − sin θ (1 + 1/2 cos² θ + 1·3/(2·4) cos⁴ θ + …)` for even ν.
pub fn student_tails(t: f64, freedom: usize) -> f64 {
    let angle = (t.abs() / (freedom.max(1) as f64).sqrt()).atan();
    let (sine, cosine) = angle.sin_cos();
    let odd = freedom % 2;
    let (mut term, mut sum) = (if odd == 1 { cosine } else { 1.0 }, 0.0);
    let mut k = 1 + odd;
    while k < freedom {
        sum += term;
        term *= cosine * cosine * k as f64 / (k + 1) as f64;
        k += 2;
    }
    let within = if odd == 1 { FRAC_2_PI * (angle + sine * sum) } else { sine * sum };
    (1.0 - within).clamp(0.0, 1.0)
}

/// Returns the quantile of Student's t for a probability above one half.
pub fn student_quantile(probability: f64, freedom: usize) -> f64 {
    let (mut low, mut high) = (0.0, 1e6);
    for _ in 0..100 {
        let middle = f64::midpoint(low, high);
        if 0.5 * student_tails(middle, freedom) > 1.0 - probability { low = middle } else { high = middle }
    }
    high
}

#[cfg(test)]
mod tests {
    use super::{normal_quantile, student_quantile, student_tails};

    #[test]
    fn quantiles_are_those_of_the_tables() {
        for (p, x) in [(0.5, 0.0), (0.975, 1.959_963_985), (1e-6, -4.753_424_309), (0.999, 3.090_232_306)] {
            assert!((normal_quantile(p) - x).abs() < 1e-8, "{p}: {}", normal_quantile(p));
        }
        for (freedom, x) in [(1, 12.706_205), (2, 4.302_653), (5, 2.570_582), (8, 2.306_004), (30, 2.042_272)]
        {
            assert!((student_quantile(0.975, freedom) - x).abs() < 1e-5, "{freedom}");
            assert!((student_tails(x, freedom) - 0.05).abs() < 1e-6, "{freedom}");
        }
        assert_eq!(student_tails(0.0, 7), 1.0);
    }
}
