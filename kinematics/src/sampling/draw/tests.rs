//! Tests of `draw.rs`.

use super::*;
use crate::sampling::stream;

/// Compares the variance, and the share of the draws within half the magnitude, with the
/// integrals of the densities.
#[test]
fn draws_are_distributed_as_they_say() {
    let count = 1_000_000;
    for (distribution, half) in [
        (Distribution::Uniform, 0.5),
        (Distribution::Normal, libm::erf(0.5 / core::f64::consts::SQRT_2)),
        (Distribution::Triangular, 0.75),
        (Distribution::Arcsine, 1.0 / 3.0),
        (
            Distribution::Ball { part: 0, parts: 2 },
            (0.25_f64.sqrt().asin() + 0.1875_f64.sqrt()) * 2.0 / core::f64::consts::PI,
        ),
        (Distribution::Ball { part: 0, parts: 3 }, 11.0 / 16.0),
    ] {
        let mut random = stream(3, 0);
        let (mut sum, mut squares, mut fourth, mut within) = (0.0, 0.0, 0.0, 0);
        for _ in 0..count {
            let point = draw_parts(distribution, &mut random);
            let x = point[2 * usize::from(distribution == Distribution::ALL[5])];
            assert!(!distribution.is_bounded() || norm(point) <= 1.0);
            assert!(!distribution.is_bounded() || x.abs() <= distribution.bound());
            sum += x;
            squares += x * x;
            fourth += x.powi(4);
            within += usize::from(x.abs() <= 0.5);
        }
        let n = f64::from(count);
        let [mean, variance, fourth] = [sum / n, squares / n, fourth / n];
        let expected = 1.0 / distribution.divisor_squared();
        let share = within as f64 / n;
        assert!(mean.abs() < 4.0 * (expected / n).sqrt(), "{distribution:?} {mean}");
        assert!((variance - expected).abs() < 4.0 * ((fourth - variance * variance) / n).sqrt());
        assert!((share - half).abs() < 4.0 * (half * (1.0 - half) / n).sqrt(), "{distribution:?} {share}");
        assert!((distribution.divisor().powi(2) - distribution.divisor_squared()).abs() < 1e-15 * 8.0);
    }
}
