//! Tests of quantiles.

use super::Quantile;

#[test]
fn of_equally_spaced_values() {
    let sorted = (1..=10_000).map(|i| f64::from(i) / 10_000.0).collect::<Vec<_>>();
    let Quantile { value, standard_error, .. } = Quantile::from_sorted(&sorted, 0.5);
    assert!((value - 0.5).abs() < 1e-12);
    // √(p (1 − p) / N) divided by a density of 1.
    assert!((standard_error - 0.005).abs() < 1e-4);
    assert_eq!(Quantile::from_sorted(&[], 0.5).value, 0.0);
    assert_eq!(Quantile::from_sorted(&[3.0], 0.99).value, 3.0);
}
