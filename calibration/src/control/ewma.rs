//! Average run length of exponentially weighted moving average charts.

use core::f64::consts::{PI, TAU};

use nalgebra::{DMatrix, DVector};

/// Quadrature nodes: run lengths up to 1e6 have a relative error of 1e-6 for λ ≥ 0.05.
const NODES: usize = 80;

/// Returns the average run length of `z_k = (1 − λ) z_{k−1} + λ x_k` with standard normal `x_k`,
/// from `z_0 = 0` until it exceeds ±`limit`, in standard deviations `√(λ/(2 − λ))` of `z`.
///
/// Crowder, *A simple method for studying run-length distributions of exponentially weighted moving
/// average charts*, 1987: `L(u) = 1 + 1/λ ∫ L(y) φ((y − (1 − λ) u)/λ) dy` from −h to h, by
/// Gauss-Legendre quadrature.
pub fn ewma_run_length(lambda: f64, limit: f64) -> f64 {
    run_length(lambda, limit, NODES)
}

fn run_length(lambda: f64, limit: f64, count: usize) -> f64 {
    let h = limit * (lambda / (2.0 - lambda)).sqrt();
    let nodes = gauss_legendre(count);
    let kernel = |u: f64, (node, weight): (f64, f64)| {
        let x = (h * node - (1.0 - lambda) * u) / lambda;
        h * weight / lambda * (-0.5 * x * x).exp() / TAU.sqrt()
    };
    let entry = |i: usize, j: usize| f64::from(u8::from(i == j)) - kernel(h * nodes[i].0, nodes[j]);
    let matrix = DMatrix::from_fn(count, count, entry);
    let at_nodes = matrix.lu().solve(&DVector::repeat(count, 1.0));
    at_nodes.map_or(f64::INFINITY, |lengths| {
        1.0 + nodes.iter().zip(lengths.iter()).map(|(node, length)| kernel(0.0, *node) * length).sum::<f64>()
    })
}

/// Returns the limit, in standard deviations of the average, for a [run length](ewma_run_length).
pub fn ewma_limit(lambda: f64, run_length: f64) -> f64 {
    let (mut low, mut high) = (0.1, 8.0);
    for _ in 0..50 {
        let middle = f64::midpoint(low, high);
        if ewma_run_length(lambda, middle) < run_length { low = middle } else { high = middle }
    }
    f64::midpoint(low, high)
}

/// Returns Gauss-Legendre nodes and weights on −1 … 1, by Newton's iterations.
fn gauss_legendre(count: usize) -> Vec<(f64, f64)> {
    let n = count as f64;
    let node = |i: usize| {
        let mut x = (PI * (i as f64 + 0.75) / (n + 0.5)).cos();
        let mut slope = 1.0;
        for _ in 0..20 {
            let (mut before, mut p) = (1.0, x);
            for k in 2..=count {
                let k = k as f64;
                (before, p) = (p, ((2.0 * k - 1.0) * x * p - (k - 1.0) * before) / k);
            }
            slope = n * (x * p - before) / (x * x - 1.0);
            x -= p / slope;
        }
        (x, 2.0 / ((1.0 - x * x) * slope * slope))
    };
    (0..count).map(node).collect()
}

#[cfg(test)]
mod tests {
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
}
