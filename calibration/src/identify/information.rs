//! Information matrices of candidate configurations and of their sums.

use core::convert::Infallible;

use nalgebra::allocator::Allocator;
use nalgebra::{Cholesky, Const, DMatrix, DVector, DefaultAllocator, Dim, Dyn, OMatrix};

use super::{EvaluatedModel, Measurement, Model, Observation, Result, by_blocks};
use abbe_analysis::{decompose::symmetric_eigen, in_order};

/// Criterion of an optimal design.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Criterion {
    /// V-optimal: mean variance of the tool point over the configurations of use.
    Variance,
    /// D-optimal: determinant of the information matrix.
    Determinant,
}

/// Stacked derivatives of all candidates, with the same number of rows each.
pub(super) struct Candidates {
    stack: DMatrix<f64>,
    /// Rows of a candidate.
    rows: usize,
    count: usize,
    /// `B^½` of the objective: `B = root · rootᵀ`.
    root: DMatrix<f64>,
}

/// A sum of information matrices, and its covariance.
pub(super) struct Information {
    cholesky: Cholesky<f64, Dyn>,
    /// `C^½` and `C B^½`.
    half: DMatrix<f64>,
    weighted: DMatrix<f64>,
    pub(super) log_det: f64,
    /// Objective `tr(C B)`.
    pub(super) variance: f64,
}

/// Candidates evaluated together.
const BLOCK: usize = 512;

impl Candidates {
    pub(super) fn new(
        model: &Model,
        list: &[Observation],
        model_error: f64,
        progress: &mut dyn FnMut(usize, usize),
    ) -> Result<Self> {
        let (p, count) = (model.unknowns.len(), list.len());
        let most = list.iter().map(Observation::count).max().unwrap_or_default();
        let rows = model.camera.map_or(most, |camera| most.min(camera.rank()));
        let arm = model.arm_length()?;
        let block = |first: usize, part: &[Observation]| {
            let mut stack = DMatrix::zeros(rows * part.len(), p);
            let mut nominal = model.at(&vec![0.0; p]);
            for (i, observation) in part.iter().enumerate() {
                let observation = nominal.nominally_seen(observation)?;
                let (mut own, mut at) = (DMatrix::zeros(most, p), 0);
                nominal.linear(&observation, |_, row| {
                    row.iter().enumerate().for_each(|(k, value)| own[(at, k)] = *value);
                    at += 1;
                })?;
                whiten(model, &observation, model_error, arm, &mut own.rows_mut(0, at));
                let own = if rows < most { compressed(own) } else { own };
                let shared = rows.min(own.nrows());
                stack.rows_mut(rows * i, shared).copy_from(&own.rows(0, shared));
            }
            Ok((first, stack))
        };
        let mut stack = DMatrix::zeros(rows * count, p);
        by_blocks(list, block, |(first, part)| {
            progress(first, count);
            stack.rows_mut(rows * first, part.nrows()).copy_from(&part);
        })?;
        Ok(Self { stack, rows, count, root: DMatrix::zeros(p, 0) })
    }

    pub(super) fn len(&self) -> usize {
        self.count
    }

    /// Scales the columns to a mean square of 1 per candidate; returns their original lengths.
    pub(super) fn normalize(&mut self) -> DVector<f64> {
        let count = self.count.max(1) as f64;
        let lengths =
            self.stack.column_iter().map(|column| (column.norm_squared() / count).sqrt().max(1e-300));
        let lengths = DVector::from_vec(lengths.collect());
        for (mut column, length) in self.stack.column_iter_mut().zip(lengths.iter()) {
            column.scale_mut(1.0 / length);
        }
        lengths
    }

    /// Sets `B` of the objective, for the scaled unknowns.
    pub(super) fn set_objective(&mut self, b: &DMatrix<f64>) {
        let Some(eigen) = symmetric_eigen(b.clone()) else {
            self.root = DMatrix::from_element(b.nrows(), 1, f64::NAN);
            return;
        };
        let largest = eigen.eigenvalues.iter().copied().fold(0.0, f64::max);
        let kept: Vec<usize> =
            (0..b.nrows()).filter(|i| eigen.eigenvalues[*i] > 1e-14 * largest && largest > 0.0).collect();
        self.root = DMatrix::from_fn(b.nrows(), kept.len(), |i, j| {
            eigen.eigenvectors[(i, kept[j])] * eigen.eigenvalues[kept[j]].sqrt()
        });
    }

    pub(super) fn objective_root(&self) -> &DMatrix<f64> {
        &self.root
    }

    /// Returns `JᵀJ` of a candidate.
    pub(super) fn information(&self, i: usize) -> DMatrix<f64> {
        let block = self.stack.rows(self.rows * i, self.rows);
        block.tr_mul(&block)
    }

    /// Returns the sum of the information of the chosen candidates.
    pub(super) fn sum(&self, chosen: &[usize]) -> DMatrix<f64> {
        let p = self.stack.ncols();
        let mut sum = DMatrix::zeros(p, p);
        for part in chosen.chunks(BLOCK) {
            let mut rows = DMatrix::zeros(part.len() * self.rows, p);
            for (place, i) in part.iter().enumerate() {
                rows.rows_mut(place * self.rows, self.rows)
                    .copy_from(&self.stack.rows(self.rows * i, self.rows));
            }
            sum += rows.tr_mul(&rows);
        }
        sum
    }

    /// Returns the gain of adding each candidate, or the loss of removing it if `inside`; positive
    /// numbers.
    pub(super) fn gains(
        &self,
        information: &Information,
        criterion: Criterion,
        inside: impl Fn(usize) -> bool + Sync,
    ) -> Vec<f64> {
        let block = |block: usize| {
            let at = BLOCK * block;
            let together = BLOCK.min(self.count - at);
            let rows = self.stack.rows(self.rows * at, self.rows * together).into_owned();
            let (scaled, weighted) = information.products(&rows, criterion);
            let sign = |i: usize| if inside(at + i) { -1.0 } else { 1.0 };
            Ok((0..together).map(|i| gain(&scaled, &weighted, self.rows, i, sign(i))).collect::<Vec<f64>>())
        };
        let mut gains = Vec::with_capacity(self.count);
        let Ok(()) = in_order::<_, Infallible>(self.count.div_ceil(BLOCK), block, |part| gains.extend(part));
        gains
    }

    /// Returns the loss of removing each of the chosen candidates.
    pub(super) fn losses(&self, sum: &Information, criterion: Criterion, chosen: &[usize]) -> Vec<f64> {
        let loss = |i: &usize| {
            let block = self.stack.rows(self.rows * i, self.rows).into_owned();
            let (scaled, weighted) = sum.products(&block, criterion);
            gain(&scaled, &weighted, self.rows, 0, -1.0)
        };
        chosen.iter().map(loss).collect()
    }
}

/// Computes the change of the objective by candidate `i` of a block.
///
/// For `ln det M`: `det(M ± JᵀJ) = det M det(1 ± J M⁻¹ Jᵀ)`. For `tr(C B)`:
/// `(M ± JᵀJ)⁻¹ = C ∓ C Jᵀ (1 ± J C Jᵀ)⁻¹ J C`. The arguments are `J C^½` and `J C B^½` of the
/// block.
fn gain(scaled: &DMatrix<f64>, weighted: &DMatrix<f64>, rows: usize, i: usize, sign: f64) -> f64 {
    // Points, poses and three targets need no allocation.
    match rows {
        3 => gain_of(scaled, weighted, Const::<3>, i, sign),
        6 => gain_of(scaled, weighted, Const::<6>, i, sign),
        9 => gain_of(scaled, weighted, Const::<9>, i, sign),
        _ => gain_of(scaled, weighted, Dyn(rows), i, sign),
    }
}

fn gain_of<R: Dim>(scaled: &DMatrix<f64>, weighted: &DMatrix<f64>, rows: R, i: usize, sign: f64) -> f64
where
    DefaultAllocator: Allocator<R, R>,
{
    let first = rows.value() * i;
    let add_square = |sum: &mut OMatrix<f64, R, R>, matrix: &DMatrix<f64>, sign: f64| {
        for column in 0..matrix.ncols() {
            let part = matrix.generic_view((first, column), (rows, Const::<1>));
            sum.ger(sign, &part, &part, 1.0);
        }
    };
    let mut changed = OMatrix::identity_generic(rows, rows);
    add_square(&mut changed, scaled, sign);
    let Some(cholesky) = changed.cholesky() else { return f64::INFINITY };
    if weighted.ncols() == 0 {
        return sign * cholesky.ln_determinant();
    }
    let mut square = OMatrix::zeros_generic(rows, rows);
    add_square(&mut square, weighted, 1.0);
    cholesky.solve(&square).trace()
}

impl Information {
    /// Inverts a sum; none if it is not positive definite.
    pub(super) fn new(sum: DMatrix<f64>, root: &DMatrix<f64>) -> Option<Self> {
        let p = sum.nrows();
        let cholesky = sum.cholesky()?;
        let log_det = cholesky.ln_determinant();
        // M = L Lᵀ, C = L⁻ᵀ L⁻¹.
        let half = cholesky.l().tr_solve_lower_triangular(&DMatrix::identity(p, p))?;
        let weighted = cholesky.solve(root);
        let variance = root.iter().zip(weighted.iter()).map(|(a, b)| a * b).sum();
        Some(Self { cholesky, half, weighted, log_det, variance })
    }

    /// Returns `J C^½`, and `J C B^½` for the variance criterion, of a block of candidates.
    fn products(&self, block: &DMatrix<f64>, criterion: Criterion) -> (DMatrix<f64>, DMatrix<f64>) {
        let weighted = match criterion {
            Criterion::Variance => block * &self.weighted,
            Criterion::Determinant => DMatrix::zeros(block.nrows(), 0),
        };
        (block * &self.half, weighted)
    }

    pub(super) fn covariance(&self) -> DMatrix<f64> {
        self.cholesky.inverse()
    }
}

impl EvaluatedModel<'_> {
    /// Replaces the measurement by that of this machine, where derivatives depend on it: the
    /// derivative of a rotation vector depends on the residual.
    pub fn nominally_seen(&mut self, observation: &Observation) -> Result<Observation> {
        let mut expected = observation.clone();
        if let Measurement::Pose(pose) = &mut expected.measured {
            **pose = self.pose(observation)?;
        }
        Ok(expected)
    }
}

/// Whitens rows for noise and model error: `W J` with `WᵀW = (1 + b 1 1ᵀ)⁻¹` for one coordinate of
/// all targets.
///
/// `b = (σ_m/σ)²`, and `W = 1 − (1 − 1/√(1 + k b)) 1 1ᵀ/k` for `k` targets.
fn whiten(
    model: &Model,
    observation: &Observation,
    model_error: f64,
    arm: f64,
    scaled: &mut nalgebra::DMatrixViewMut<'_, f64>,
) {
    let weight = observation.weight;
    let share = |of: f64| weight * (model_error / of).powi(2);
    if model_error == 0.0 {
        return;
    }
    let b = share(model.uncertainty.length);
    let rows = scaled.nrows();
    match &observation.measured {
        // All corners that a camera sees share the error of the model.
        Measurement::Readings(_) if model.camera.is_some() => without_common(scaled, 2, b),
        // For an angle, the length divided by the arm.
        Measurement::Readings(values) => {
            let shown = model.observables.iter().zip(values).filter(|(_, value)| value.is_some());
            for (i, (reading, _)) in shown.enumerate() {
                let sigma = reading.uncertainty * if reading.kind.is_angle { arm } else { 1.0 };
                scaled.row_mut(i).scale_mut(1.0 / (1.0 + share(sigma)).sqrt());
            }
        }
        Measurement::Points(_) => without_common(scaled, 3, b),
        Measurement::Pose(_) => {
            let turn = share(arm * model.uncertainty.angle);
            for i in 0..rows {
                let b = if i < 3 { b } else { turn };
                scaled.row_mut(i).scale_mut(1.0 / (1.0 + b).sqrt());
            }
        }
    }
}

/// Returns `R P` of `J P⁻¹ = Q R`, which has the same `JᵀJ`; its last rows are zero beyond the rank
/// of `J`.
fn compressed(rows: DMatrix<f64>) -> DMatrix<f64> {
    let decomposed = rows.col_piv_qr();
    let mut r = decomposed.r();
    decomposed.p().inv_permute_columns(&mut r);
    r
}

/// Whitens rows of `axes` coordinates of each target for an error that all targets share.
fn without_common(scaled: &mut nalgebra::DMatrixViewMut<'_, f64>, axes: usize, b: f64) {
    let k = scaled.nrows() / axes;
    let factor = 1.0 - 1.0 / (1.0 + k as f64 * b).sqrt();
    for mut column in scaled.column_iter_mut() {
        for axis in 0..axes {
            let mean = (0..k).map(|j| column[axes * j + axis]).sum::<f64>() / k as f64;
            (0..k).for_each(|j| column[axes * j + axis] -= factor * mean);
        }
    }
}

#[cfg(test)]
mod tests;
