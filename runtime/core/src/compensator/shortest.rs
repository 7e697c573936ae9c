//! Shortest step towards a target, by iterated Tikhonov regularization.
//!
//! `d₁ = (JᵀJ + λ)⁻¹ Jᵀ b`, `dₘ₊₁ = dₘ + (JᵀJ + λ)⁻¹ Jᵀ (b − J dₘ)`. Along a singular vector with the
//! singular value σ, the share `(λ / (σ² + λ))^m` of `b` is left. With more passes the step is
//! exact closer to a singular pose, and at the pose it is as short as one pass makes it with a
//! smaller λ (Engl, Hanke, Neubauer: Regularization of Inverse Problems, 1996, chapter 5).

use crate::Scalar;

/// λ, in rad² and m², where one rad of rotation weighs [`LEVER`](super::LEVER).
pub const DAMPING: f64 = 1e-9;

/// Number of passes m.
pub const PASSES: usize = 4;

/// Shortest step, from the smaller of the matrices `JᵀJ` and `J Jᵀ`.
pub(super) enum Departure {
    /// `d` itself, for fewer than six joints.
    Primal([f64; 6]),
    /// `z` with `d = Jᵀ z`, for six joints or more: `d` has no rounding errors in the null space of
    /// `J`, where damping alone would bound them.
    Dual([f64; 6]),
}

impl Departure {
    pub(super) fn shortest(columns: &[[f64; 6]], b: &[f64; 6]) -> Self {
        let mut matrix = [[0.0; 6]; 6];
        if columns.len() >= 6 {
            for column in columns {
                for (row, entry) in matrix.iter_mut().zip(column) {
                    add(row, column, *entry);
                }
            }
            return Self::Dual(solve(matrix, *b));
        }
        let mut projected = [0.0; 6];
        for (i, column) in columns.iter().enumerate() {
            projected[i] = dot(column, b);
            for (j, other) in columns[..=i].iter().enumerate() {
                matrix[i][j] = dot(column, other);
            }
        }
        Self::Primal(solve(matrix, projected))
    }

    pub(super) fn component(&self, j: usize, column: &[f64; 6]) -> f64 {
        match self {
            Self::Primal(d) => d[j],
            Self::Dual(z) => dot(column, z),
        }
    }
}

/// Returns `x` after [`PASSES`] passes for M positive semidefinite, by the Cholesky decomposition
/// `L Lᵀ = M + λ`. Reads only the lower triangle of M.
///
/// `b − M x₁ = λ x₁`, so that the pass m adds `λ (M + λ)⁻¹` times what the pass before it added.
fn solve(mut m: [[f64; 6]; 6], mut b: [f64; 6]) -> [f64; 6] {
    for i in 0..6 {
        for j in 0..=i {
            let rest = m[i][j] - dot(&m[i][..j], &m[j][..j]);
            // Rounding must not make a pivot smaller than λ.
            m[i][j] = if i == j { Scalar::sqrt(rest.max(0.0) + DAMPING) } else { rest / m[j][j] };
        }
    }
    let mut x = [0.0; 6];
    for _ in 0..PASSES {
        for i in 0..6 {
            b[i] = (b[i] - dot(&m[i][..i], &b[..i])) / m[i][i];
        }
        for i in (0..6).rev() {
            let known: f64 = (i + 1..6).map(|j| m[j][i] * b[j]).sum();
            b[i] = (b[i] - known) / m[i][i];
        }
        add(&mut x, &b, 1.0);
        b = b.map(|entry| DAMPING * entry);
    }
    x
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
