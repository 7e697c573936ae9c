//! Normal equations of the unknowns and the functions of the profiles, fold by fold.

use core::ops::Range;

use nalgebra::DMatrix;

use super::basis::ProfileJoint;
use super::symmetric::{Block, Cholesky, InverseRoot, Symmetric};
use crate::identify::fit::REJECTED;
use crate::identify::{Failure, Fit, Folds, Model, Observation};
use abbe_analysis::decompose::symmetric_eigen;
use abbe_analysis::in_order;

/// Share of the information about a direction of a profile that is left beside the unknowns, below
/// which the direction is excluded.
const LEFT: f64 = 1e-3;

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
    /// Penalty of each unknown by its prior.
    priors: Vec<f64>,
    /// Right side of the priors.
    prior_right: Vec<f64>,
    /// Penalties of excluded directions, and their number for each joint.
    excluded: Vec<(DMatrix<f64>, usize)>,
}

/// Sums over some rows.
struct Part {
    matrix: Symmetric,
    right: Vec<f64>,
    squares: f64,
    numbers: usize,
}

/// Solution for given ridges.
pub(super) struct Solution {
    pub(super) x: Vec<f64>,
    root: InverseRoot,
    /// Number of coefficients of each joint that the data determine.
    pub(super) effective: Vec<f64>,
}

impl Solution {
    /// Returns the covariance of a range of the columns, for a standard deviation of 1.
    pub(super) fn covariance(&self, range: Range<usize>) -> DMatrix<f64> {
        let count = range.len();
        DMatrix::from_fn(count, count, |i, j| self.root.inverse_at(range.start + i, range.start + j))
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
            let (mut block, mut columns) = (Block::new(size), vec![0.0; size]);
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
                    for (column, derivative) in columns.iter_mut().zip(&derivatives[..kept.len()]) {
                        *column = weight * derivative;
                    }
                    for (j, derivative) in derivatives[kept.len()..].iter().enumerate() {
                        let range = starts[j]..starts[j + 1];
                        for (column, function) in columns[range.clone()].iter_mut().zip(&functions[range]) {
                            *column = weight * derivative * function;
                        }
                    }
                    part.push(&mut block, &columns, -weight * residual);
                })?;
            }
            part.matrix.add(&mut block);
            Ok(part)
        };
        let (mut parts, mut all) = (Vec::new(), Part::new(size));
        in_order::<_, Failure>(folds.count, fold, |part| {
            all.add(&part);
            parts.push(part);
        })?;
        let prior = |k: &usize| fit.priors.get(*k).copied().flatten().map_or(0.0, |sigma| sigma.powi(-2));
        let priors: Vec<f64> = kept.iter().map(prior).collect();
        let prior_right = priors.iter().zip(&kept).map(|(prior, k)| -prior * fit.x[*k]).collect();
        let numbers = all.numbers;
        let mut normal =
            Self { kept, numbers, starts, all, folds: parts, priors, prior_right, excluded: Vec::new() };
        normal.excluded = (0..joints.len()).map(|j| normal.excluded(j)).collect();
        Ok(normal)
    }

    /// Returns the number of columns.
    pub(super) fn size(&self) -> usize {
        self.all.matrix.size
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
        columns.clone().map(|k| self.all.matrix.at(k, k)).sum::<f64>() / columns.len() as f64
    }

    /// Returns the information about the kept unknowns without profiles, priors included.
    pub(super) fn information(&self) -> DMatrix<f64> {
        let count = self.kept.len();
        let mut information = DMatrix::from_fn(count, count, |i, j| self.all.matrix.at(i, j));
        (0..count).for_each(|k| information[(k, k)] += self.priors[k]);
        information
    }

    /// Returns the penalty `μ Σ u uᵀ`, `u = M d/‖M d‖`, of the directions d of joint j that act as
    /// the unknowns do, and their number.
    ///
    /// With `M = L Lᵀ` they are `d = L⁻ᵀ v` for eigenvectors v of `L⁻¹ S L⁻ᵀ`, and `M d = L v`.
    fn excluded(&self, j: usize) -> (DMatrix<f64>, usize) {
        let (columns, count) = (self.columns(j), self.columns(j).len());
        let none = (DMatrix::zeros(count, count), 0);
        let at = |i: usize, k: usize| self.all.matrix.at(i, k);
        let mut m = DMatrix::from_fn(count, count, |i, k| at(columns.start + i, columns.start + k));
        let largest = m.diagonal().max();
        // A direction without information is not excluded: its ridge suffices.
        (0..count).for_each(|k| m[(k, k)] += 1e-9 * largest);
        let cross = DMatrix::from_fn(self.kept.len(), count, |i, k| at(i, columns.start + k));
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

    /// Adds ridges and priors. A joint without a ridge has no profile.
    fn penalized(&self, mut matrix: Symmetric, ridges: &[Option<f64>]) -> Symmetric {
        for (k, prior) in self.priors.iter().enumerate() {
            matrix.add_at(k, k, *prior);
        }
        for (j, ridge) in ridges.iter().enumerate() {
            let columns = self.columns(j);
            let ridge = ridge.unwrap_or(EXCLUDED * EXCLUDED * self.mean_information(j).max(1e-300));
            let (excluded, number) = &self.excluded[j];
            for (i, row) in columns.clone().enumerate() {
                matrix.add_at(row, row, ridge);
                for (k, column) in columns.clone().enumerate().skip(i).filter(|_| *number > 0) {
                    matrix.add_at(row, column, excluded[(i, k)]);
                }
            }
        }
        matrix
    }

    fn right(&self, mut right: Vec<f64>) -> Vec<f64> {
        right.iter_mut().zip(&self.prior_right).for_each(|(right, prior)| *right += prior);
        right
    }

    fn solve(&self, cholesky: &Cholesky, right: Vec<f64>, ridges: &[Option<f64>]) -> Vec<f64> {
        let mut x = cholesky.solve(&self.right(right));
        for j in (0..ridges.len()).filter(|j| ridges[*j].is_none()) {
            x[self.columns(j)].fill(0.0);
        }
        x
    }

    /// Solves for all rows; none if the equations are singular.
    pub(super) fn solved(&self, ridges: &[Option<f64>]) -> Option<Solution> {
        let cholesky = self.penalized(self.all.matrix.clone(), ridges).cholesky()?;
        let x = self.solve(&cholesky, self.all.right.clone(), ridges);
        let root = cholesky.inverse_root();
        let effective = |(j, ridge): (usize, &Option<f64>)| {
            let Some(ridge) = ridge else { return 0.0 };
            let trace: f64 = self.columns(j).map(|k| root.inverse_at(k, k)).sum();
            let free = self.columns(j).len() - self.excluded[j].1;
            (free as f64 - ridge * trace).max(0.0)
        };
        let effective = ridges.iter().enumerate().map(effective).collect();
        Some(Solution { x, root, effective })
    }

    /// Returns the sum of squared residuals of all rows.
    pub(super) fn squares_at(&self, x: &[f64]) -> f64 {
        self.all.squares_at(x)
    }

    /// Solves without the rows of a fold.
    pub(super) fn without(&self, fold: usize, ridges: &[Option<f64>]) -> Option<Vec<f64>> {
        let mut matrix = self.all.matrix.clone();
        matrix.add_times(&self.folds[fold].matrix, -1.0);
        let cholesky = self.penalized(matrix, ridges).cholesky()?;
        let own = &self.folds[fold].right;
        let right = self.all.right.iter().zip(own).map(|(all, own)| all - own).collect();
        Some(self.solve(&cholesky, right, ridges))
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
        Self { matrix: Symmetric::zeros(size), right: vec![0.0; size], squares: 0.0, numbers: 0 }
    }

    fn push(&mut self, block: &mut Block, row: &[f64], right: f64) {
        if block.push(row) {
            self.matrix.add(block);
        }
        self.right.iter_mut().zip(row).for_each(|(sum, value)| *sum += value * right);
        self.squares += right * right;
        self.numbers += 1;
    }

    fn add(&mut self, other: &Self) {
        self.matrix.add_times(&other.matrix, 1.0);
        self.right.iter_mut().zip(&other.right).for_each(|(own, other)| *own += other);
        self.squares += other.squares;
        self.numbers += other.numbers;
    }

    /// Returns `‖r − A x‖² = rᵀr − 2 gᵀx + xᵀN x`.
    fn squares_at(&self, x: &[f64]) -> f64 {
        let product = self.matrix.times(x);
        let terms = x.iter().zip(&self.right).zip(&product);
        self.squares + terms.map(|((x, right), product)| x * (product - 2.0 * right)).sum::<f64>()
    }
}
