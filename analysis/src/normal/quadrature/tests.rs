//! Tests of `quadrature.rs`.

use super::integral;

#[test]
fn polynomials_and_peaks() {
    let power = |n: i32| integral(&move |x: f64| x.powi(n), -1.0, 2.0, 1e-12);
    for n in 0..=22 {
        let exact = (2_f64.powi(n + 1) - (-1_f64).powi(n + 1)) / f64::from(n + 1);
        assert!((power(n) / exact - 1.0).abs() < 1e-13, "{n}");
    }
    let peak = integral(&|x: f64| 1.0 / (1e-4 + x * x), -1.0, 1.0, 1e-12);
    assert!((peak - 200.0 * 100_f64.atan()).abs() < 1e-10, "{peak}");
}
