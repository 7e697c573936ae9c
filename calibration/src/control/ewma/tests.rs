//! Tests of `ewma.rs`.

use rand::RngExt;
use rand_distr::StandardNormal;

use super::{NODES, ewma_limit, ewma_run_length, run_length};
use abbe_analysis::sampling::stream;

/// Lucas and Saccucci, *Exponentially weighted moving average control schemes*, 1990: run
/// length 500.
#[test]
fn limits_are_the_published_ones() {
    for (lambda, limit) in [(0.05, 2.615), (0.10, 2.814), (0.25, 2.998), (0.50, 3.071), (0.75, 3.087)] {
        let found = ewma_limit(lambda, 500.0);
        assert!((found - limit).abs() < 2e-3, "{lambda}: {found}");
    }
    // Shewhart chart: 1/(2 Φ(−3)).
    assert!((ewma_run_length(1.0, 3.0) - 370.398).abs() < 1e-2);
}

#[test]
fn long_runs_are_as_long_in_simulation() {
    let lambda = 0.1;
    let h = ewma_limit(lambda, 2000.0) * f64::sqrt(lambda / (2.0 - lambda));
    let runs = 600;
    let lengths = (0..runs).map(|run| {
        let mut random = stream(5, run);
        let (mut z, mut steps) = (0.0_f64, 0);
        while z.abs() <= h {
            z += lambda * (random.sample::<f64, _>(StandardNormal) - z);
            steps += 1;
        }
        f64::from(steps)
    });
    let mean = lengths.sum::<f64>() / runs as f64;
    // Run lengths are nearly exponential: the standard error of the mean is 2000/√600 = 82.
    assert!((mean - 2000.0).abs() < 4.0 * 82.0, "{mean}");
}

/// Checks the stated error of the quadrature.
#[test]
fn more_nodes_change_nothing() {
    for (lambda, limit) in [(0.05, 4.4), (0.1, 4.5), (0.3, 4.6)] {
        let [stated, fine] = [NODES, 2 * NODES].map(|nodes| run_length(lambda, limit, nodes));
        assert!((stated / fine - 1.0).abs() < 1e-6, "{lambda}: {stated} {fine}");
    }
}
