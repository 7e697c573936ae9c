//! Tests of `distributions.rs`.

use super::normal_quantile;

#[test]
fn quantiles_are_those_of_the_tables() {
    for (p, x) in [(0.5, 0.0), (0.975, 1.959_963_985), (1e-6, -4.753_424_309), (0.999, 3.090_232_306)] {
        assert!((normal_quantile(p) - x).abs() < 1e-8, "{p}: {}", normal_quantile(p));
    }
}
