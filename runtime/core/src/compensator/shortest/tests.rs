//! Tests of `shortest.rs`.

use super::{DAMPING, dot, pull, solve};

/// Returns arbitrary columns of full rank.
fn columns<const N: usize>() -> [[f64; 6]; N] {
    core::array::from_fn(|j| core::array::from_fn(|i| (1.0 + i as f64 * 1.7 + j as f64 * 2.3).sin()))
}

/// Returns `y`, and checks that `z = (b − J y) / λ`.
fn shortest<const N: usize>(columns: &[[f64; 6]; N], b: &[f64; 6]) -> [f64; N] {
    let z = pull(columns, &[0.0; N], b);
    let step: [f64; N] = columns.map(|column| dot(&column, &z));
    for (i, z) in z.iter().enumerate() {
        let left = b[i] - columns.iter().zip(step).map(|(column, d)| column[i] * d).sum::<f64>();
        assert!((z * DAMPING - left).abs() < 1e-8, "{z} {left}");
    }
    step
}

#[test]
fn cholesky_solves() {
    let b = [1.0, -2.0, 3.0, 0.5, 0.0, 7.0];
    let matrix: [[f64; 6]; 6] =
        core::array::from_fn(|i| core::array::from_fn(|j| 1.0 / (1.0 + i.abs_diff(j) as f64)));
    let x = solve(matrix, b);
    for ((row, b), x_i) in matrix.iter().zip(b).zip(x) {
        assert!((dot(row, &x) + DAMPING * x_i - b).abs() < 1e-12);
    }
}

/// Fewer joints: the residual is orthogonal to all columns.
#[test]
fn fewer_than_six_are_least_squares() {
    // In metres, as much as errors of a machine.
    let (columns, b) = (columns::<4>(), [1e-3, -2e-3, 3e-3, 0.5e-3, 0.0, 7e-3]);
    let d = shortest(&columns, &b);
    let left: [f64; 6] =
        core::array::from_fn(|i| b[i] - columns.iter().zip(d).map(|(c, d)| c[i] * d).sum::<f64>());
    columns.iter().for_each(|column| assert!(dot(column, &left).abs() < 1e-8));
}

/// More joints: the shortest solution is orthogonal to the null space.
#[test]
fn lost_rank_stays_bounded() {
    let [a, b, ..] = columns::<2>();
    let d = shortest(&[a, b, a, b, a, b, a, b], &a);
    d.iter().enumerate().for_each(|(j, d)| {
        let expected = if j % 2 == 0 { 0.25 } else { 0.0 };
        assert!((d - expected).abs() < 1e-3, "{d}, not {expected}");
    });
}
