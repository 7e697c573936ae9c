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
mod tests {
    use nalgebra::{DMatrix, DVector};

    use super::{Curvature, Linearization};

    /// Holds that the estimate has the curvature of the last step: `S p = Σ r_i ∇²r_i p` for the
    /// residual `(x + y²/2 − 1, y − x²)`, by hand at the second of two close points.
    #[test]
    fn it_has_the_curvature_of_the_last_step() {
        let at = |x: f64, y: f64| Linearization {
            residual: DVector::from_vec(vec![x + y * y / 2.0 - 1.0, y - x * x]),
            derivatives: DMatrix::from_row_slice(2, 2, &[1.0, y, -2.0 * x, 1.0]),
        };
        let mut curvature = Curvature::zero(2);
        let points = [(0.9, 0.1), (0.4, 0.3), (0.401, 0.298), (0.4, 0.301)];
        for pair in points.windows(2) {
            let [(x, y), (x_after, y_after)] = [pair[0], pair[1]];
            let step = DVector::from_vec(vec![x_after - x, y_after - y]);
            let after = at(x_after, y_after);
            curvature.update(&step, &at(x, y), &after);
            let hessian =
                DMatrix::from_diagonal(&DVector::from_vec(vec![-2.0 * after.residual[1], after.residual[0]]));
            let (found, expected) = (&curvature.0 * &step, hessian * &step);
            assert!((&found - &expected).norm() < 1e-12, "{found} {expected}");
        }
        let rows = curvature.rows();
        let positive = rows.tr_mul(&rows);
        let differs = (&positive - &curvature.0).symmetric_eigen().eigenvalues;
        assert!(differs.iter().all(|value| *value > -1e-12), "{differs}");
    }
}
