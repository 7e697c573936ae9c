//! Normal equations of the unknowns and the functions of the profiles, fold by fold.

use core::ops::Range;

use nalgebra::{Cholesky, DMatrix, DVector, Dyn};

use super::basis::ProfileJoint;
use crate::identify::fit::REJECTED;
use crate::identify::{Failure, Fit, Folds, Model, Observation};
use abbe_analysis::decompose::symmetric_eigen;
use abbe_analysis::in_order;

/// Share of the information about a direction of a profile that is left beside the unknowns, below
/// which the direction is excluded.
const LEFT: f64 = 1e-3;

/// Rows that are added to the sums together, and columns that are eliminated together.
const TOGETHER: usize = 64;

/// Share of a diagonal entry of the equations that is left for its pivot, at which they are
/// singular.
const SINGULAR: f64 = 1e-14;

/// Penalty of an excluded direction, as a multiple of the largest information about a function.
const EXCLUDED: f64 = 1e6;

/// Normal equations `N x = g` of all rows and of each fold. The kept unknowns come first, then the
/// functions of each joint.
pub(super) struct Normal {
    /// Indices of the kept unknowns of the fit.
    pub(super) kept: Vec<usize>,
    /// Number of measured numbers.
    pub(super) numbers: usize,
    /// First column of each joint, and the end of the last one.
    starts: Vec<usize>,
    all: Part,
    folds: Vec<Part>,
    /// Penalties of the unknowns by their prior.
    prior: DMatrix<f64>,
    /// Right side of the priors.
    prior_right: DVector<f64>,
    /// Penalties of excluded directions, and their number for each joint.
    excluded: Vec<(DMatrix<f64>, usize)>,
}

/// Sums over some rows.
struct Part {
    matrix: DMatrix<f64>,
    right: DVector<f64>,
    squares: f64,
    numbers: usize,
}

/// Solution for given ridges.
pub(super) struct Solution {
    pub(super) x: Vec<f64>,
    inverse: DMatrix<f64>,
    /// Number of coefficients of each joint that the data determine.
    pub(super) effective: Vec<f64>,
}

impl Solution {
    /// Returns the covariance of a range of the columns, for a standard deviation of 1.
    pub(super) fn covariance(&self, range: Range<usize>) -> DMatrix<f64> {
        self.inverse.view((range.start, range.start), (range.len(), range.len())).into_owned()
    }
}

/// Returns the model with the kept unknowns of a fit, and then the constant error of each joint.
pub(super) fn extended<'m>(model: &Model<'m>, fit: &Fit, joints: &[ProfileJoint]) -> Model<'m> {
    let kept = fit.identifiable.kept.iter().map(|k| model.unknowns[*k]);
    model.with(kept.chain(joints.iter().map(|joint| joint.error)).collect())
}

impl Normal {
    pub(super) fn new(
        model: &Model,
        data: &[Observation],
        fit: &Fit,
        joints: &[ProfileJoint],
        folds: &Folds,
    ) -> Result<Self, Failure> {
        let kept = fit.identifiable.kept.clone();
        let mut starts = vec![kept.len()];
        for joint in joints {
            starts.push(starts[starts.len() - 1] + joint.basis.count());
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
                for (joint, start) in joints.iter().zip(&starts) {
                    joint.fill(row.q[joint.variable], &mut functions[*start..]);
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
                    part.numbers += 1;
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
            all.add(&part);
            parts.push(part);
        })?;
        let prior = fit.prior.tr_mul(&fit.prior);
        let mut prior_right = DVector::zeros(size);
        prior_right
            .rows_mut(0, kept.len())
            .copy_from(&(&prior * DVector::from_column_slice(&x[..kept.len()]) * -1.0));
        let numbers = all.numbers;
        let mut normal =
            Self { kept, numbers, starts, all, folds: parts, prior, prior_right, excluded: Vec::new() };
        normal.excluded = (0..joints.len()).map(|j| normal.excluded(j)).collect();
        Ok(normal)
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

    /// Returns the mean information about a function of joint j.
    pub(super) fn mean_information(&self, j: usize) -> f64 {
        let columns = self.columns(j);
        columns.clone().map(|k| self.all.matrix[(k, k)]).sum::<f64>() / columns.len() as f64
    }

    /// Returns the information about the kept unknowns without profiles, priors included.
    pub(super) fn information(&self) -> DMatrix<f64> {
        let count = self.kept.len();
        self.all.matrix.view((0, 0), (count, count)) + &self.prior
    }

    /// Returns the penalty `μ Σ u uᵀ`, `u = M d/‖M d‖`, of the directions d of joint j that act as
    /// the unknowns do, and their number.
    ///
    /// With `M = L Lᵀ` they are `d = L⁻ᵀ v` for eigenvectors v of `L⁻¹ S L⁻ᵀ`, and `M d = L v`.
    fn excluded(&self, j: usize) -> (DMatrix<f64>, usize) {
        let (columns, count) = (self.columns(j), self.columns(j).len());
        let none = (DMatrix::zeros(count, count), 0);
        let all = &self.all.matrix;
        let mut m = all.view((columns.start, columns.start), (count, count)).into_owned();
        let largest = m.diagonal().max();
        // A direction without information is not excluded: its ridge suffices.
        (0..count).for_each(|k| m[(k, k)] += 1e-9 * largest);
        let cross = all.view((0, columns.start), (self.kept.len(), count)).into_owned();
        let Some(known) = self.information().cholesky() else { return none };
        let s = &m - cross.tr_mul(&known.solve(&cross));
        let Some(l) = m.cholesky().map(|cholesky| cholesky.l()) else { return none };
        let Some(half) = l.solve_lower_triangular(&s) else { return none };
        let Some(ratio) = l.solve_lower_triangular(&half.transpose()) else { return none };
        let Some(eigen) = symmetric_eigen((&ratio + ratio.transpose()) * 0.5) else { return none };
        let (mut penalty, mut number) = none;
        for (value, vector) in eigen.eigenvalues.iter().zip(eigen.eigenvectors.column_iter()) {
            if *value < LEFT {
                let u = (&l * vector).normalize();
                penalty.ger(EXCLUDED * largest, &u, &u, 1.0);
                number += 1;
            }
        }
        (penalty, number)
    }

    /// Adds ridges and priors, and factorizes; none if the equations are singular. A joint without
    /// a ridge has no profile.
    fn penalized(&self, mut matrix: DMatrix<f64>, ridges: &[Option<f64>]) -> Option<Cholesky<f64, Dyn>> {
        let mut of_unknowns = matrix.view_mut((0, 0), self.prior.shape());
        of_unknowns += &self.prior;
        for (j, ridge) in ridges.iter().enumerate() {
            let columns = self.columns(j);
            let ridge = ridge.unwrap_or(EXCLUDED * EXCLUDED * self.mean_information(j).max(1e-300));
            let (start, count) = (columns.start, columns.len());
            let mut own = matrix.view_mut((start, start), (count, count));
            own += &self.excluded[j].0;
            (0..count).for_each(|k| own[(k, k)] += ridge);
        }
        let least = matrix.diagonal() * SINGULAR;
        let factor = cholesky(matrix)?;
        let pivots = factor.l_dirty().diagonal();
        pivots.iter().zip(&least).all(|(pivot, least)| pivot * pivot > *least).then_some(factor)
    }

    fn solve(&self, factor: &Cholesky<f64, Dyn>, right: &DVector<f64>, ridges: &[Option<f64>]) -> Vec<f64> {
        let mut x: Vec<f64> = factor.solve(&(right + &self.prior_right)).data.into();
        for j in (0..ridges.len()).filter(|j| ridges[*j].is_none()) {
            x[self.columns(j)].fill(0.0);
        }
        x
    }

    /// Solves for all rows; none if the equations are singular.
    pub(super) fn solved(&self, ridges: &[Option<f64>]) -> Option<Solution> {
        let factor = self.penalized(self.all.matrix.clone(), ridges)?;
        let x = self.solve(&factor, &self.all.right, ridges);
        let inverse = factor.inverse();
        let effective = |(j, ridge): (usize, &Option<f64>)| {
            let Some(ridge) = ridge else { return 0.0 };
            let trace: f64 = self.columns(j).map(|k| inverse[(k, k)]).sum();
            let free = self.columns(j).len() - self.excluded[j].1;
            (free as f64 - ridge * trace).max(0.0)
        };
        let effective = ridges.iter().enumerate().map(effective).collect();
        Some(Solution { x, inverse, effective })
    }

    /// Returns the sum of squared residuals of all rows.
    pub(super) fn squares_at(&self, x: &[f64]) -> f64 {
        self.all.squares_at(x)
    }

    /// Solves without the rows of a fold.
    pub(super) fn without(&self, fold: usize, ridges: &[Option<f64>]) -> Option<Vec<f64>> {
        let own = &self.folds[fold];
        let factor = self.penalized(&self.all.matrix - &own.matrix, ridges)?;
        Some(self.solve(&factor, &(&self.all.right - &own.right), ridges))
    }

    /// Returns the sum of squared residuals of all folds under the solutions of the others; none if
    /// the equations are singular.
    pub(super) fn cross_validated(&self, ridges: &[Option<f64>]) -> Option<f64> {
        let mut sum = 0.0;
        let fold = |fold: usize| {
            let x = self.without(fold, ridges).ok_or(())?;
            Ok(self.folds[fold].squares_at(&x))
        };
        in_order::<_, ()>(self.folds.len(), fold, |squares| sum += squares).ok()?;
        Some(sum)
    }
}

impl Part {
    fn new(size: usize) -> Self {
        let (matrix, right) = (DMatrix::zeros(size, size), DVector::zeros(size));
        Self { matrix, right, squares: 0.0, numbers: 0 }
    }

    fn add(&mut self, other: &Self) {
        self.matrix += &other.matrix;
        self.right += &other.right;
        self.squares += other.squares;
        self.numbers += other.numbers;
    }

    /// Returns `‖r − A x‖² = rᵀr − 2 gᵀx + xᵀN x`.
    fn squares_at(&self, x: &[f64]) -> f64 {
        let x = DVector::from_column_slice(x);
        self.squares + x.dot(&(&self.matrix * &x - &self.right * 2.0))
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
