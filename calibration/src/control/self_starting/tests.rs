//! Tests of `self_starting.rs`.

use rand::RngExt;
use rand_distr::StandardNormal;

use super::{SelfStarting, normal_quantile};
use abbe_analysis::sampling::stream;

/// Scores have mean 0, variance 1, no autocorrelation and normal tails, for any mean and scale
/// of the series.
#[test]
fn they_are_independent_standard_normal_numbers() {
    let (mut sum, mut squares, mut lagged, mut beyond, mut count) = (0.0, 0.0, 0.0, 0, 0.0);
    for series in 0..4000 {
        let mut random = stream(11, series);
        let mut chart = SelfStarting::default();
        let mut before = 0.0;
        for k in 0..25 {
            let q = chart.next(1e3 + 0.02 * random.sample::<f64, _>(StandardNormal));
            if k < 2 {
                assert_eq!(q, 0.0);
                continue;
            }
            (sum, squares, lagged, count) = (sum + q, squares + q * q, lagged + q * before, count + 1.0);
            beyond += usize::from(q.abs() > 2.575_829);
            before = q;
        }
    }
    let four_sigma = 4.0 / f64::sqrt(count);
    assert!((sum / count).abs() < four_sigma && (lagged / count).abs() < four_sigma, "{sum} {lagged}");
    assert!((squares / count - 1.0).abs() < four_sigma * 2f64.sqrt(), "{}", squares / count);
    assert!((beyond as f64 / count - 0.01).abs() < four_sigma * 0.0995, "{beyond} of {count}");
}

#[test]
fn the_sign_is_that_of_the_difference() {
    let mut chart = SelfStarting::default();
    for x in [1.0, 1.1, 0.9, 1.0] {
        chart.next(x);
    }
    let mut other = chart;
    assert!(other.next(1.5) > 1.0 && chart.next(0.5) < -1.0);
}

#[test]
fn quantiles_are_those_of_the_tables() {
    for (p, x) in [(0.5, 0.0), (0.975, 1.959_963_985), (1e-6, -4.753_424_309), (0.999, 3.090_232_306)] {
        assert!((normal_quantile(p) - x).abs() < 1e-8, "{p}: {}", normal_quantile(p));
    }
}
