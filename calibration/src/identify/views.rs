//! Tests whether the noise of single pixels explains the residuals of the views of a camera.
//!
//! All pixels of a view share the error that the model has there: a displacement of the board, and
//! errors of unknown intrinsic parameters. With `Q_c` an orthonormal basis of the columns of `J_c`,
//! which such an error changes, `between = Σ |Q_cᵀ r_c|²` contains it, and `within = Σ |r_c|² −
//! between` is noise alone. With n numbers, m columns of all `Q_c` and p unknowns,
//! `F = (between/(m − p)) / (within/(n − m))` has an F-distribution if the pixels are independent.

use nalgebra::{DMatrix, DVector};

use super::blocks::by_blocks;
use super::solver::Solver;
use super::{Failure, Measurement, f_test};

/// Significance level at which views have errors in common beyond the noise of their pixels.
const LEVEL: f64 = 0.01;

impl Solver<'_> {
    /// Returns whether these rows are views of a camera whose pixels have independent errors.
    pub(super) fn has_independent_pixels(&self, rows: &[usize]) -> Result<bool, Failure> {
        let Some(camera) = &self.model.camera else { return Ok(false) };
        let is_view = |i: &usize| matches!(self.data[*i].measured, Measurement::Readings(_));
        if !rows.iter().all(is_view) {
            return Ok(false);
        }
        let p = self.x.len();
        let block = |_: usize, rows: &[usize]| {
            let mut at = self.at();
            let (mut between, mut all, mut m, mut n) = (0.0, 0.0, 0, 0);
            for i in rows {
                let (mut columns, mut residuals) = (Vec::new(), Vec::new());
                let weight = self.weights[*i].sqrt();
                at.linear(&self.data[*i], |residual, row| {
                    columns.extend(row.iter().map(|value| weight * value));
                    residuals.push(weight * residual);
                })?;
                let r = DVector::from_vec(residuals);
                let j = DMatrix::from_row_slice(r.len(), p, &columns);
                let rank = camera.rank().min(r.len()).min(p);
                let q = j.col_piv_qr().q();
                between += q.columns(0, rank).tr_mul(&r).norm_squared();
                (all, m, n) = (all + r.norm_squared(), m + rank, n + r.len());
            }
            Ok((between, all, m, n))
        };
        let (mut between, mut all, mut m, mut n) = (0.0, 0.0, 0, 0);
        by_blocks(rows, block, |part| {
            (between, all, m, n) = (between + part.0, all + part.1, m + part.2, n + part.3);
        })?;
        Ok(m > p && n > m && f_test(all, all - between, m - p, n - m).p > LEVEL)
    }
}
