//! Shortest step of the free joints towards a target: one pass of Tikhonov regularization.
//!
//! `y = Jᵀ z` with `z = (J Jᵀ + λ)⁻¹ b = (b − J y) / λ`.

use crate::Scalar;

/// λ, in rad² and m², where one rad of rotation weighs [`LEVER`](super::LEVER).
pub const DAMPING: f64 = 1e-9;

/// Returns `z`; the columns of held joints count as zeros.
///
/// `Jᵀ z` has no rounding errors in the null space of `J`, where damping alone would bound them.
pub(super) fn pull(columns: &[[f64; 6]], held: &[f64], b: &[f64; 6]) -> [f64; 6] {
    let mut matrix = [[0.0; 6]; 6];
    for (column, _) in columns.iter().zip(held).filter(|(_, held)| **held <= 0.0) {
        for (row, entry) in matrix.iter_mut().zip(column) {
            add(row, column, *entry);
        }
    }
    solve(matrix, *b)
}

/// Returns `x` with `(M + λ) x = b` for M positive semidefinite, by the Cholesky decomposition
/// `L Lᵀ = M + λ`. Reads only the lower triangle of M.
fn solve(mut m: [[f64; 6]; 6], mut b: [f64; 6]) -> [f64; 6] {
    for i in 0..6 {
        for j in 0..=i {
            let rest = m[i][j] - dot(&m[i][..j], &m[j][..j]);
            // Rounding must not make a pivot smaller than λ.
            m[i][j] = if i == j { Scalar::sqrt(rest.max(0.0) + DAMPING) } else { rest / m[j][j] };
        }
    }
    for i in 0..6 {
        b[i] = (b[i] - dot(&m[i][..i], &b[..i])) / m[i][i];
    }
    for i in (0..6).rev() {
        let known: f64 = (i + 1..6).map(|j| m[j][i] * b[j]).sum();
        b[i] = (b[i] - known) / m[i][i];
    }
    b
}

pub(super) fn add(sum: &mut [f64; 6], column: &[f64; 6], factor: f64) {
    for (sum, entry) in sum.iter_mut().zip(column) {
        *sum += entry * factor;
    }
}

pub(super) fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

#[cfg(test)]
mod tests;
