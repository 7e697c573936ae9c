//! Tests of `derivatives.rs`.

use super::derivative;

#[test]
fn of_known_functions() {
    let f = |t: f64| {
        let inverse_sine = (0.99 + t).asin();
        inverse_sine.is_finite().then(|| [t.sin(), t.exp(), 3.0 * t, t * t, 0.0, inverse_sine])
    };
    // The last one exists only for steps below 0.01.
    let exact = [1.0, 1.0, 3.0, 0.0, 0.0, 1.0 / (1.0 - 0.99_f64 * 0.99).sqrt()];
    let found = derivative(0.1, f).unwrap();
    for (found, exact) in found.iter().zip(exact) {
        assert!((found - exact).abs() < 1e-9, "{found} instead of {exact}");
    }
    assert_eq!(derivative(0.1, |_| None), None);
}
