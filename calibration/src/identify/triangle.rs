//! Tall least-squares problems, accumulated row by row as a triangle.
//!
//! Only the factor `R` of the QR decomposition of the stack `[J | r]` is stored: it determines
//! `‖J x − r‖` for every `x`, and memory does not grow with the number of rows.

use nalgebra::{DMatrix, DVector};

/// Rows that are folded in together.
const BLOCK: usize = 256;

/// Triangular factor of a stack of rows.
#[derive(Clone, Debug)]
pub(super) struct Triangle {
    /// `R`, and below it the rows that are not yet folded in.
    stack: DMatrix<f64>,
    filled: usize,
}

impl Triangle {
    /// Creates an empty triangle with `unknowns` columns and one for the right side.
    pub(super) fn new(unknowns: usize) -> Self {
        let width = unknowns + 1;
        Self { stack: DMatrix::zeros(width + BLOCK, width), filled: 0 }
    }

    /// Appends a row of derivatives and its right side, both multiplied by `weight`.
    pub(super) fn push(&mut self, row: &[f64], right: f64, weight: f64) {
        let (place, last) = (self.stack.ncols() + self.filled, self.stack.ncols() - 1);
        for (j, value) in row[..last].iter().enumerate() {
            self.stack[(place, j)] = value * weight;
        }
        self.stack[(place, last)] = right * weight;
        self.filled += 1;
        if self.filled == BLOCK {
            self.fold();
        }
    }

    /// Appends the rows of another triangle of the same width.
    pub(super) fn merge(&mut self, other: Self) {
        for row in other.finish().row_iter() {
            let row: Vec<f64> = row.iter().copied().collect();
            self.push(&row, row[row.len() - 1], 1.0);
        }
    }

    fn fold(&mut self) {
        let width = self.stack.ncols();
        let r = self.stack.rows(0, width + self.filled).into_owned().qr().unpack_r();
        self.stack.rows_mut(0, width).copy_from(&r);
        self.filled = 0;
    }

    /// Returns `R`, including the right side: a square matrix of `unknowns + 1` columns.
    pub(super) fn finish(mut self) -> DMatrix<f64> {
        self.fold();
        self.stack.rows(0, self.stack.ncols()).into_owned()
    }
}

/// A small linear least-squares problem `min ‖A x − b‖`.
#[derive(Clone, Debug)]
pub(super) struct Problem {
    pub(super) a: DMatrix<f64>,
    pub(super) b: DVector<f64>,
}

impl Problem {
    /// Returns the problem of a finished triangle, whose last column is the right side.
    pub(super) fn from_triangle(triangle: DMatrix<f64>) -> Self {
        let p = triangle.ncols() - 1;
        let r = triangle.qr().unpack_r();
        Self { a: r.columns(0, p).into_owned(), b: r.column(p).into_owned() }
    }

    /// Returns L with `(AᵀA)⁻¹ = L Lᵀ`; none if that is singular.
    pub(super) fn half(&self) -> Option<DMatrix<f64>> {
        let p = self.a.ncols();
        let root = self.a.rows(0, p.min(self.a.nrows()));
        root.solve_upper_triangular(&DMatrix::identity(root.nrows(), p))
    }

    /// Returns the decrease of `‖b‖²` at the minimum: `‖Qᵀb‖²`, with `A` its own `R`.
    pub(super) fn promise(&self) -> f64 {
        self.b.rows(0, self.a.ncols().min(self.b.len())).norm_squared()
    }

    /// Solves `min ‖A x − b‖² + λ ‖D x‖²`, with `D` the lengths of the columns; none if singular.
    pub(super) fn solve(&self, damping: f64) -> Option<DVector<f64>> {
        let (p, rows) = (self.a.ncols(), self.a.nrows());
        let mut right = DVector::zeros(rows + p);
        right.rows_mut(0, rows).copy_from(&self.b);
        let scale = self.lengths();
        let qr = self.damped(&scale, damping).qr();
        qr.q_tr_mul(&mut right);
        let solution = qr.r().solve_upper_triangular(&right.rows(0, p))?;
        unscaled(&solution, &scale)
    }

    /// Solves `(AᵀA + λ D²) x = g`; none if singular.
    pub(super) fn solve_normal(&self, g: &DVector<f64>, damping: f64) -> Option<DVector<f64>> {
        let scale = self.lengths();
        let r = self.damped(&scale, damping).qr().unpack_r();
        let right = DVector::from_fn(g.len(), |j, _| g[j] / scale[j]);
        let solution = r.solve_upper_triangular(&r.tr_solve_upper_triangular(&right)?)?;
        unscaled(&solution, &scale)
    }

    /// Stacks `A D⁻¹` on `√λ I`.
    fn damped(&self, scale: &[f64], damping: f64) -> DMatrix<f64> {
        let (p, rows) = (self.a.ncols(), self.a.nrows());
        let mut stack = DMatrix::zeros(rows + p, p);
        for j in 0..p {
            for i in 0..rows {
                stack[(i, j)] = self.a[(i, j)] / scale[j];
            }
            stack[(rows + j, j)] = damping.sqrt();
        }
        stack
    }

    /// Returns the lengths of the columns; 1 for zero columns.
    pub(super) fn lengths(&self) -> Vec<f64> {
        let length = |column: nalgebra::DVectorView<'_, f64>| column.norm();
        self.a.column_iter().map(|c| Some(length(c)).filter(|l| *l > 0.0).unwrap_or(1.0)).collect()
    }
}

/// Returns `D⁻¹ x`; none if it is not finite.
fn unscaled(solution: &DVector<f64>, scale: &[f64]) -> Option<DVector<f64>> {
    let x = DVector::from_fn(solution.len(), |j, _| solution[j] / scale[j]);
    x.iter().all(|value| value.is_finite()).then_some(x)
}

#[cfg(test)]
mod tests;
