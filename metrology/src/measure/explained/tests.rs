//! Tests of `explained.rs`.

use super::{likely, mahalanobis};

/// C = diag(1, 4, 9) + 1 1ᵀ, e = (1, 2, 3): by Sherman and Morrison eᵀC⁻¹e = 3 − (11/6)²/(1 +
/// 49/36).
#[test]
fn distances_are_in_units_of_the_covariance() {
    let covariance = [[2.0, 1.0, 1.0], [1.0, 5.0, 1.0], [1.0, 1.0, 10.0]];
    let expected = 3.0 - (11.0_f64 / 6.0).powi(2) / (1.0 + 49.0 / 36.0);
    assert!((mahalanobis(covariance, [1.0, 2.0, 3.0]) - expected.sqrt()).abs() < 1e-14);
}

/// Sums of the binomial distribution, computed independently: of 20 rows, P(≤ 15) = 0.0026 and
/// P(≤ 16) = 0.016; P(20) = 0.36.
#[test]
fn likely_shares_are_those_of_the_binomial_distribution() {
    assert_eq!(likely(20), [16.0 / 20.0, 1.0]);
    let [low, high] = likely(1000);
    let [lower, higher] = likely(1001);
    assert!((low - lower).abs() < 2e-3 && (high - higher).abs() < 2e-3, "{low} {lower} {high} {higher}");
}
