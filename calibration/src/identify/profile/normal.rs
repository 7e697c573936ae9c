//! Normal equations of the unknowns and the functions of the profiles, fold by fold.

use core::ops::Range;

use nalgebra::{Cholesky, DMatrix, DVector, Dyn};

use super::{super::Result, basis::Centered};
use crate::identify::{Failure, Fit, Folds, Model, Observation, REJECTED};
use abbe_analysis::in_order;

/// Rows that are added to the sums together, and columns that are eliminated together.
const TOGETHER: usize = 64;

/// Share of a diagonal entry of the equations that is left for its pivot, at which they are
/// singular.
const SINGULAR: f64 = 1e-14;

/// Normal equations `N x = g` of all rows and of each fold. The kept unknowns come first, then the
/// functions of each joint. Rows of the prior of the unknowns and of known distances belong to no
/// fold.
pub(super) struct Normal {
    /// Indices of the kept unknowns of the fit.
    pub(super) kept: Vec<usize>,
    /// Number of measured numbers.
    pub(super) numbers: f64,
    /// Mean information about a function of each joint.
    pub(super) mean_information: Vec<f64>,
    /// First column of each joint, and the end of the last one.
    starts: Vec<usize>,
    /// Number of functions of each number of cycles of each joint.
    phases: Vec<usize>,
    all: Part,
    pub(super) folds: Vec<Part>,
}

/// Ridge of each function, by its column; infinite without a profile, and 0 for the unknowns.
pub(super) type Ridges = Vec<f64>;

/// Sums over some rows.
#[derive(Clone)]
pub(super) struct Part {
    matrix: DMatrix<f64>,
    right: DVector<f64>,
    squares: f64,
    rows: f64,
}

/// Solution for given ridges.
pub(super) struct Solution {
    pub(super) x: DVector<f64>,
    /// Sum of squared residuals.
    pub(super) squares: f64,
    /// Number of rows.
    pub(super) rows: f64,
    /// Columns that are solved for.
    used: Vec<usize>,
    factor: Cholesky<f64, Dyn>,
}

impl Solution {
    /// Returns a root R of the covariance `RᵀR` of all columns, for a standard deviation of 1; 0
    /// for those left out.
    pub(super) fn root(&self) -> DMatrix<f64> {
        let inverse = inverse_of_lower(self.factor.l_dirty());
        let mut root = DMatrix::zeros(inverse.nrows(), self.x.len());
        self.used.iter().zip(inverse.column_iter()).for_each(|(k, column)| root.set_column(*k, &column));
        root
    }
}

/// Returns the model with the kept unknowns of a fit, and then the constant error of each joint.
pub(super) fn extended<'m>(model: &Model<'m>, fit: &Fit, joints: &[Centered]) -> Model<'m> {
    let kept = fit.identifiable.kept.iter().map(|k| model.unknowns[*k]);
    model.with(kept.chain(joints.iter().map(|one| one.joint.error)).collect())
}

impl Normal {
    pub(super) fn new(
        model: &Model,
        data: &[Observation],
        fit: &Fit,
        joints: &[Centered],
        folds: &Folds,
    ) -> Result<Self> {
        let kept = fit.identifiable.kept.clone();
        let mut starts = vec![kept.len()];
        for joint in joints {
            starts.push(starts[starts.len() - 1] + joint.joint.count());
        }
        let size = starts[joints.len()];
        let extended = extended(model, fit, joints);
        let x: Vec<f64> = kept.iter().map(|k| fit.x[*k]).chain(joints.iter().map(|_| 0.0)).collect();
        let fold = |fold: usize| {
            let mut part = Part::new(size);
            let (mut rows, mut filled) = (DMatrix::zeros(TOGETHER, size), 0);
            let mut functions = vec![0.0; size];
            let mut extended = extended.at(&x);
            for (i, row) in data.iter().enumerate() {
                if folds.fold[i] as usize != fold || fit.weights[i] < REJECTED {
                    continue;
                }
                let weight = fit.weights[i].sqrt();
                for (joint, ends) in joints.iter().zip(starts.windows(2)) {
                    let values = joint.values(row.q[joint.joint.variable]);
                    functions[ends[0]..ends[1]].iter_mut().zip(values).for_each(|(to, value)| *to = value);
                }
                extended.linear(row, |residual, derivatives| {
                    let mut columns = rows.row_mut(filled);
                    for (column, derivative) in columns.iter_mut().zip(&derivatives[..kept.len()]) {
                        *column = weight * derivative;
                    }
                    for (j, derivative) in derivatives[kept.len()..].iter().enumerate() {
                        for k in starts[j]..starts[j + 1] {
                            columns[k] = weight * derivative * functions[k];
                        }
                    }
                    let right = -weight * residual;
                    part.right.axpy(right, &columns.transpose(), 1.0);
                    part.squares += right * right;
                    part.rows += 1.0;
                    filled = (filled + 1) % TOGETHER;
                    if filled == 0 {
                        part.matrix.gemm(1.0, &rows.transpose(), &rows, 1.0);
                    }
                })?;
            }
            let rows = rows.rows(0, filled);
            part.matrix.gemm(1.0, &rows.transpose(), &rows, 1.0);
            Ok(part)
        };
        let (mut parts, mut all) = (Vec::new(), Part::new(size));
        in_order::<_, Failure>(folds.count, fold, |part| {
            all.add(&part, 1.0);
            parts.push(part);
        })?;
        let numbers = all.rows;
        let mut always = |row: &[f64], residual: f64| {
            let row = DVector::from_column_slice(row).resize_vertically(size, 0.0);
            all.matrix.ger(1.0, &row, &row, 1.0);
            all.right.axpy(-residual, &row, 1.0);
            all.squares += residual * residual;
            all.rows += 1.0;
        };
        extended.distance_rows(&x, |residual, derivatives| always(&derivatives[..kept.len()], residual));
        for row in fit.prior.row_iter() {
            let row: Vec<f64> = row.iter().copied().collect();
            always(&row, row.iter().zip(&x).map(|(w, x)| w * x).sum());
        }
        let phases = joints.iter().map(|one| one.joint.basis.phases()).collect();
        let information = all.matrix.diagonal();
        let mean = |ends: &[usize]| information.rows_range(ends[0]..ends[1]).mean();
        let mean_information = starts.windows(2).map(mean).collect();
        Ok(Self { kept, numbers, mean_information, starts, phases, all, folds: parts })
    }

    /// Returns the number of columns.
    pub(super) fn size(&self) -> usize {
        self.all.right.len()
    }

    /// Returns the number of joints.
    pub(super) fn joints(&self) -> usize {
        self.starts.len() - 1
    }

    /// Returns the columns of the functions of joint j.
    pub(super) fn columns(&self, j: usize) -> Range<usize> {
        self.starts[j]..self.starts[j + 1]
    }

    /// Returns the columns of each number of cycles of joint j.
    pub(super) fn cycles(&self, j: usize) -> impl Iterator<Item = Range<usize>> {
        let phases = self.phases[j];
        self.columns(j).step_by(phases).map(move |start| start..start + phases)
    }

    /// Returns the information about the kept unknowns without profiles, priors included.
    pub(super) fn information(&self) -> DMatrix<f64> {
        let count = self.kept.len();
        self.all.matrix.view((0, 0), (count, count)).into_owned()
    }

    /// Solves for all rows, or without those of a fold; none if the equations are singular.
    pub(super) fn solved(&self, left_out: Option<usize>, ridges: &[f64]) -> Option<Solution> {
        let mut part = self.all.clone();
        if let Some(fold) = left_out.map(|fold| &self.folds[fold]) {
            part.add(fold, -1.0);
        }
        let used: Vec<usize> = (0..self.size()).filter(|k| ridges[*k].is_finite()).collect();
        let mut matrix = part.matrix.select_columns(&used).select_rows(&used);
        used.iter().enumerate().for_each(|(i, k)| matrix[(i, i)] += ridges[*k]);
        let least = matrix.diagonal() * SINGULAR;
        let factor = cholesky(matrix)?;
        let pivots = factor.l_dirty().diagonal();
        if !pivots.iter().zip(&least).all(|(pivot, least)| pivot * pivot > *least) {
            return None;
        }
        let own = factor.solve(&part.right.select_rows(&used));
        let mut x = DVector::zeros(self.size());
        used.iter().zip(&own).for_each(|(k, value)| x[*k] = *value);
        Some(Solution { squares: part.squares_at(&x), rows: part.rows, x, used, factor })
    }

    /// Returns the ridges without the profiles of some joints.
    pub(super) fn without(&self, joints: Range<usize>, ridges: &[f64]) -> Ridges {
        let mut ridges = ridges.to_vec();
        ridges[self.starts[joints.start]..self.starts[joints.end]].fill(f64::INFINITY);
        ridges
    }

    /// Returns the number of coefficients of joint j that the data determine, `Σ (1 − λ C_kk)`.
    pub(super) fn effective(&self, j: usize, variances: &[f64], ridges: &[f64]) -> f64 {
        self.columns(j).filter(|k| ridges[*k].is_finite()).map(|k| 1.0 - ridges[k] * variances[k]).sum()
    }

    /// Returns the sum of squared residuals of all folds under the solutions of the others, each
    /// with its ridges; none if the equations are singular.
    pub(super) fn cross_validated(&self, ridges: &[Ridges]) -> Option<f64> {
        let mut sum = 0.0;
        let fold = |fold: usize| {
            let solution = self.solved(Some(fold), &ridges[fold]).ok_or(())?;
            Ok(self.folds[fold].squares_at(&solution.x))
        };
        in_order::<_, ()>(self.folds.len(), fold, |squares| sum += squares).ok()?;
        Some(sum)
    }
}

impl Part {
    fn new(size: usize) -> Self {
        let (matrix, right) = (DMatrix::zeros(size, size), DVector::zeros(size));
        Self { matrix, right, squares: 0.0, rows: 0.0 }
    }

    /// Adds other sums, or subtracts them.
    fn add(&mut self, other: &Self, sign: f64) {
        self.matrix.zip_apply(&other.matrix, |own, other| *own += sign * other);
        self.right.axpy(sign, &other.right, 1.0);
        self.squares += sign * other.squares;
        self.rows += sign * other.rows;
    }

    /// Returns `‖r − A x‖² = rᵀr − 2 gᵀx + xᵀN x`.
    fn squares_at(&self, x: &DVector<f64>) -> f64 {
        (self.squares + x.dot(&(&self.matrix * x - &self.right * 2.0))).max(0.0)
    }
}

/// Factorizes `A = LLᵀ` by blocks, whose products take most of the time; none if A is not positive
/// definite.
///
/// ```text
/// A₁₁ = L₁₁L₁₁ᵀ        L₂₁ᵀ = L₁₁⁻¹A₂₁ᵀ        A₂₂ − L₂₁L₂₁ᵀ is next
/// ```
pub(super) fn cholesky(mut matrix: DMatrix<f64>) -> Option<Cholesky<f64, Dyn>> {
    let size = matrix.nrows();
    for start in (0..size).step_by(TOGETHER) {
        let own = TOGETHER.min(size - start);
        let (end, left) = (start + own, size - start - own);
        let l = matrix.view((start, start), (own, own)).into_owned().cholesky()?.unpack();
        let mut below = matrix.view((end, start), (left, own)).transpose();
        l.solve_lower_triangular_unchecked_mut(&mut below);
        let rows = below.transpose();
        matrix.view_mut((end, end), (left, left)).gemm(-1.0, &rows, &below, 1.0);
        matrix.view_mut((start, start), (own, own)).copy_from(&l);
        matrix.view_mut((end, start), (left, own)).copy_from(&rows);
    }
    Some(Cholesky::pack_dirty(matrix))
}

/// Returns the inverse X of a lower triangular matrix, by blocks of rows:
/// `X_i = L_ii⁻¹ (I_i − L_i X)`, with the rows of X above.
fn inverse_of_lower(l: &DMatrix<f64>) -> DMatrix<f64> {
    let size = l.nrows();
    let mut inverse = DMatrix::identity(size, size);
    for start in (0..size).step_by(TOGETHER) {
        let own = TOGETHER.min(size - start);
        let (above, mut rows) = inverse.rows_range_pair_mut(..start, start..start + own);
        // The columns behind these rows stay zero.
        let end = start + own;
        let mut rows = rows.columns_mut(0, end);
        rows.gemm(-1.0, &l.view((start, 0), (own, start)), &above.columns(0, end), 1.0);
        l.view((start, start), (own, own)).solve_lower_triangular_unchecked_mut(&mut rows);
    }
    inverse
}
