//! Tests of `shortest.rs`.

use super::{Departure, dot, solve};

/// Returns arbitrary columns of full rank.
fn columns<const N: usize>() -> [[f64; 6]; N] {
    core::array::from_fn(|j| core::array::from_fn(|i| (1.0 + i as f64 * 1.7 + j as f64 * 2.3).sin()))
}

fn departure<const N: usize>(columns: &[[f64; 6]; N], b: &[f64; 6]) -> [f64; N] {
    let d = Departure::shortest(columns, b);
    core::array::from_fn(|j| d.component(j, &columns[j]))
}

#[test]
fn cholesky_solves() {
    let b = [1.0, -2.0, 3.0, 0.5, 0.0, 7.0];
    let matrix: [[f64; 6]; 6] =
        core::array::from_fn(|i| core::array::from_fn(|j| 1.0 / (1.0 + i.abs_diff(j) as f64)));
    let x = solve(matrix, b);
    matrix.iter().zip(b).for_each(|(row, b)| assert!((dot(row, &x) - b).abs() < 1e-9));
}

/// Fewer joints: the residual is orthogonal to all columns.
#[test]
fn fewer_than_six_are_least_squares() {
    let (columns, b) = (columns::<4>(), [1.0, -2.0, 3.0, 0.5, 0.0, 7.0]);
    let d = departure(&columns, &b);
    let left: [f64; 6] =
        core::array::from_fn(|i| b[i] - columns.iter().zip(d).map(|(c, d)| c[i] * d).sum::<f64>());
    columns.iter().for_each(|column| assert!(dot(column, &left).abs() < 1e-6));
}

/// More joints: the shortest solution is orthogonal to the null space.
#[test]
fn lost_rank_stays_bounded() {
    let [a, b, ..] = columns::<2>();
    let d = departure(&[a, b, a, b, a, b, a, b], &a);
    d.iter().enumerate().for_each(|(j, d)| {
        let expected = if j % 2 == 0 { 0.25 } else { 0.0 };
        assert!((d - expected).abs() < 1e-3, "{d}, not {expected}");
    });
}
