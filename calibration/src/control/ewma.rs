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
    let at_nodes = DMatrix::from_fn(count, count, entry).lu().solve(&DVector::repeat(count, 1.0));
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
mod tests;
