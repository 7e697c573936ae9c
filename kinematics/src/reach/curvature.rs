//! Curvature that Gauss–Newton steps neglect: `S ≈ Σ r_i ∇²r_i`, estimated from the steps.
//!
//! Dennis, Gay and Welsch, *An adaptive nonlinear least-squares algorithm*, 1981: with the step
//! `p`, `y = A₊ᵀ r₊ − Aᵀ r` and `y# = (A₊ − A)ᵀ r₊`,
//!
//! ```text
//! S ← min(|pᵀ y#| / |pᵀ S p|, 1) S,   v = y# − S p
//! S ← S + (v yᵀ + y vᵀ) / (yᵀ p) − (pᵀ v) y yᵀ / (yᵀ p)²
//! ```
//!
//! Without `S`, steps zigzag where an error remains and a singular pose bends the way of the tool.

use nalgebra::{DMatrix, DVector, SymmetricEigen};

/// Estimate of `S`.
pub(super) struct Curvature(DMatrix<f64>);

/// Residual of a least-squares problem, and its derivatives.
pub(super) struct Linearization {
    pub(super) residual: DVector<f64>,
    pub(super) derivatives: DMatrix<f64>,
}

impl Curvature {
    /// Returns the curvature of a linear problem of `n` variables, 0.
    pub(super) fn zero(n: usize) -> Self {
        Self(DMatrix::zeros(n, n))
    }

    /// Returns rows `R` with `Rᵀ R` equal to the positive part of `S`.
    pub(super) fn rows(&self) -> DMatrix<f64> {
        let SymmetricEigen { eigenvalues, eigenvectors } = SymmetricEigen::new(self.0.clone());
        let roots = eigenvalues.map(|value| value.max(0.0).sqrt());
        DMatrix::from_diagonal(&roots) * eigenvectors.transpose()
    }

    /// Updates the estimate by a step.
    pub(super) fn update(&mut self, step: &DVector<f64>, before: &Linearization, after: &Linearization) {
        let Self(s) = self;
        let y = after.derivatives.tr_mul(&after.residual) - before.derivatives.tr_mul(&before.residual);
        let own = (&after.derivatives - &before.derivatives).tr_mul(&after.residual);
        let (along, estimated) = (y.dot(step), (&*s * step).dot(step));
        if estimated != 0.0 {
            *s *= (own.dot(step) / estimated).abs().min(1.0);
        }
        if along > 0.0 {
            let v = own - &*s * step;
            *s += (&v * y.transpose() + &y * v.transpose()) / along
                - &y * y.transpose() * (v.dot(step) / (along * along));
        }
    }
}

#[cfg(test)]
mod tests;
