//! What the configurations of a list tell, and what a sum of them leaves unknown.

use core::convert::Infallible;

use nalgebra::{Cholesky, DMatrix, DVector, Dyn, SMatrix};

use super::linearize::by_blocks;
use super::{Failure, Measurement, Model, Observation};
use abbe_analysis::decompose::symmetric_eigen;
use abbe_analysis::{in_order, sampling};

/// What a choice of configurations is to make small or large.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Criterion {
    /// The mean variance of the tool point where the machine is used: V-optimal.
    Variance,
    /// The determinant of the information: D-optimal.
    Determinant,
}

/// The derivatives of all candidates, one below the other, each with as many rows.
pub(super) struct Candidates {
    stack: DMatrix<f64>,
    /// Rows of a candidate.
    rows: usize,
    count: usize,
    /// `B^½` of what is aimed at: `B = root · rootᵀ`.
    root: DMatrix<f64>,
}

/// A sum of information, and what it leaves.
pub(super) struct Information {
    cholesky: Cholesky<f64, Dyn>,
    /// `C^½` and `C B^½`.
    half: DMatrix<f64>,
    aimed: DMatrix<f64>,
    pub(super) log_det: f64,
    /// `tr(C B)`.
    pub(super) variance: f64,
}

/// Candidates that are looked at together.
const BLOCK: usize = 512;

impl Candidates {
    pub(super) fn new(
        model: &Model,
        list: &[Observation],
        model_error: f64,
        progress: &mut dyn FnMut(usize, usize),
    ) -> Result<Self, Failure> {
        let (p, count) = (model.unknowns.len(), list.len());
        let rows = list.iter().map(Observation::count).max().unwrap_or_default();
        let arm = sampling::arm_length(model.manipulator, &model.s).map_err(Failure::Machine)?;
        let x = vec![0.0; p];
        let block = |first: usize, part: &[Observation]| {
            let mut stack = DMatrix::zeros(rows * part.len(), p);
            let mut room = model.room();
            for (i, observation) in part.iter().enumerate() {
                let observation = model.nominally_seen(&mut room, observation)?;
                let mut at = rows * i;
                model.linear(&mut room, &observation, &x, |_, row| {
                    row.iter().enumerate().for_each(|(k, value)| stack[(at, k)] = *value);
                    at += 1;
                })?;
                let mut seen = stack.rows_mut(rows * i, at - rows * i);
                whiten(model, &observation, model_error, arm, &mut seen);
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

    /// Scales the columns, so that they have a mean square of 1 per candidate; the lengths that they had.
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

    /// What is aimed at: `B`, of the scaled unknowns.
    pub(super) fn aim(&mut self, b: &DMatrix<f64>) {
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

    pub(super) fn aim_root(&self) -> &DMatrix<f64> {
        &self.root
    }

    /// `JᵀJ` of a candidate.
    pub(super) fn information(&self, i: usize) -> DMatrix<f64> {
        let block = self.stack.rows(self.rows * i, self.rows);
        block.tr_mul(&block)
    }

    /// The sum of these.
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

    /// What each gains when it is added, or loses when it is taken away, where `inside` says that it is in the sum: positive numbers.
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
            let (seen, aimed) = information.of(&rows, criterion);
            let sign = |i: usize| if inside(at + i) { -1.0 } else { 1.0 };
            Ok((0..together).map(|i| gain(&seen, &aimed, self.rows, i, sign(i))).collect::<Vec<f64>>())
        };
        let mut gains = Vec::with_capacity(self.count);
        let Ok(()) = in_order::<_, Infallible>(self.count.div_ceil(BLOCK), block, |part| gains.extend(part));
        gains
    }

    /// What these lose when one of them is taken away.
    pub(super) fn losses(
        &self,
        information: &Information,
        criterion: Criterion,
        chosen: &[usize],
    ) -> Vec<f64> {
        let mut losses = Vec::with_capacity(chosen.len());
        for i in chosen {
            let block = self.stack.rows(self.rows * i, self.rows).into_owned();
            let (seen, aimed) = information.of(&block, criterion);
            losses.push(gain(&seen, &aimed, self.rows, 0, -1.0));
        }
        losses
    }
}

/// By how much `ln det M` changes, `det(M ± JᵀJ) = det M det(1 ± J M⁻¹ Jᵀ)`; or, where something is aimed at, `tr(C B)`:
/// `(M ± JᵀJ)⁻¹ = C ∓ C Jᵀ (1 ± J C Jᵀ)⁻¹ J C`. Of candidate `i` in a block, with `J C^½` and `J C B^½`.
fn gain(seen: &DMatrix<f64>, aimed: &DMatrix<f64>, rows: usize, i: usize, sign: f64) -> f64 {
    match rows {
        3 => gain_of::<3>(seen, aimed, i, sign),
        6 => gain_of::<6>(seen, aimed, i, sign),
        9 => gain_of::<9>(seen, aimed, i, sign),
        _ => {
            let square = |matrix: &DMatrix<f64>| {
                let rows = matrix.rows(rows * i, rows);
                rows * rows.transpose()
            };
            let Some(cholesky) = (DMatrix::identity(rows, rows) + square(seen) * sign).cholesky() else {
                return f64::INFINITY;
            };
            match aimed.ncols() {
                0 => 2.0 * sign * cholesky.l_dirty().diagonal().iter().map(|d| d.ln()).sum::<f64>(),
                _ => cholesky.solve(&square(aimed)).trace(),
            }
        }
    }
}

/// The same without a heap, for points, poses and three targets.
fn gain_of<const N: usize>(seen: &DMatrix<f64>, aimed: &DMatrix<f64>, i: usize, sign: f64) -> f64 {
    let square = |matrix: &DMatrix<f64>| {
        let mut square = SMatrix::<f64, N, N>::zeros();
        for column in matrix.column_iter() {
            let rows = column.fixed_rows::<N>(N * i);
            square += rows * rows.transpose();
        }
        square
    };
    let Some(cholesky) = (SMatrix::<f64, N, N>::identity() + square(seen) * sign).cholesky() else {
        return f64::INFINITY;
    };
    match aimed.ncols() {
        0 => 2.0 * sign * cholesky.l_dirty().diagonal().iter().map(|d| d.ln()).sum::<f64>(),
        _ => cholesky.solve(&square(aimed)).trace(),
    }
}

impl Information {
    /// None if the sum is not positive definite.
    pub(super) fn new(sum: DMatrix<f64>, root: &DMatrix<f64>) -> Option<Self> {
        let p = sum.nrows();
        let cholesky = sum.cholesky()?;
        let log_det = 2.0 * cholesky.l_dirty().diagonal().iter().map(|d| d.ln()).sum::<f64>();
        // M = L Lᵀ, C = L⁻ᵀ L⁻¹.
        let half = cholesky.l().tr_solve_lower_triangular(&DMatrix::identity(p, p))?;
        let aimed = cholesky.solve(root);
        let variance = root.iter().zip(aimed.iter()).map(|(a, b)| a * b).sum();
        Some(Self { cholesky, half, aimed, log_det, variance })
    }

    /// `J C^½`, and `J C B^½` if that is asked for, of many at once.
    fn of(&self, block: &DMatrix<f64>, criterion: Criterion) -> (DMatrix<f64>, DMatrix<f64>) {
        let aimed = match criterion {
            Criterion::Variance => block * &self.aimed,
            Criterion::Determinant => DMatrix::zeros(block.nrows(), 0),
        };
        (block * &self.half, aimed)
    }

    pub(super) fn covariance(&self) -> DMatrix<f64> {
        self.cholesky.inverse()
    }
}

impl Model<'_> {
    /// The observation as the nominal machine would give it, where that matters: the derivative of a turn depends on how far it is
    /// from what was measured.
    pub fn nominally_seen(
        &self,
        room: &mut super::Room,
        observation: &Observation,
    ) -> Result<Observation, Failure> {
        let mut expected = observation.clone();
        if let Measurement::Pose(pose) = &mut expected.measured {
            **pose = self.pose(room, observation, &vec![0.0; self.unknowns.len()])?;
        }
        Ok(expected)
    }
}

/// Rows in units of the instrument's noise become such of noise and model error: `W J` with `WᵀW = (1 + b 1 1ᵀ)⁻¹` for the same
/// coordinate of all targets, `b = (σ_m/σ)²`: `W = 1 − (1 − 1/√(1 + k b)) 1 1ᵀ/k`.
fn whiten(
    model: &Model,
    observation: &Observation,
    model_error: f64,
    arm: f64,
    seen: &mut nalgebra::DMatrixViewMut<'_, f64>,
) {
    let weight = observation.weight;
    let share = |of: f64| weight * (model_error / of).powi(2);
    if model_error == 0.0 {
        return;
    }
    let b = share(model.uncertainty.length);
    let rows = seen.nrows();
    match &observation.measured {
        // Of an angle as much as the length is over the arm.
        Measurement::Readings(values) => {
            let shown = model.readings.iter().zip(values).filter(|(_, value)| value.is_some());
            for (i, (reading, _)) in shown.enumerate() {
                let sigma = reading.uncertainty * if reading.gauge.is_angle() { arm } else { 1.0 };
                seen.row_mut(i).scale_mut(1.0 / (1.0 + share(sigma)).sqrt());
            }
        }
        Measurement::Points(_) => {
            let k = rows / 3;
            let factor = 1.0 - 1.0 / (1.0 + k as f64 * b).sqrt();
            for mut column in seen.column_iter_mut() {
                for axis in 0..3 {
                    let mean = (0..k).map(|j| column[3 * j + axis]).sum::<f64>() / k as f64;
                    (0..k).for_each(|j| column[3 * j + axis] -= factor * mean);
                }
            }
        }
        Measurement::Pose(_) => {
            let turn = share(arm * model.uncertainty.angle);
            for i in 0..rows {
                let b = if i < 3 { b } else { turn };
                seen.row_mut(i).scale_mut(1.0 / (1.0 + b).sqrt());
            }
        }
    }
}
