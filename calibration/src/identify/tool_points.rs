//! Sensitivity and predicted uncertainty of the tool point at the configurations of use.

use nalgebra::{DMatrix, Matrix3xX, Vector3};

use super::{Identifiable, Model, Observation, Result, Unknown};

/// Derivatives of the tool point with respect to each unknown, at each configuration of a list;
/// length unit per unit of the unknown.
#[derive(Clone, Debug, PartialEq)]
pub struct ToolPoints {
    moves: Vec<Matrix3xX<f64>>,
}

impl Model<'_> {
    /// Computes the derivatives of the tool point at the configurations of use.
    ///
    /// A single target at zero is the tool point, so its position is among the unknowns. With other
    /// targets, the tool point is a point of its own without unknowns.
    pub fn tool_points(&self, used: &[Observation]) -> Result<ToolPoints> {
        let single = self.targets_of(0).len() == 1
            && !self.unknowns.iter().any(|unknown| matches!(unknown, Unknown::Tool(..)));
        let mut at = self.at(&vec![0.0; self.unknowns.len()]);
        let one = |row: &Observation| {
            at.chain(row)?;
            let (target, point) = match single {
                true => (at.first_target, at.targets[at.first_target]),
                false => (usize::MAX, [0.0; 3]),
            };
            let point = at.tool_pose().apply(point);
            let moves = (0..self.unknowns.len()).map(|k| at.point(k, target, point).into());
            Ok(Matrix3xX::from_columns(&moves.collect::<Vec<Vector3<f64>>>()))
        };
        Ok(ToolPoints { moves: used.iter().map(one).collect::<Result<_, _>>()? })
    }
}

impl ToolPoints {
    /// Returns the derivatives at each configuration: a column for each unknown.
    pub fn derivatives(&self) -> &[Matrix3xX<f64>] {
        &self.moves
    }

    /// Returns `B`, the mean of `TᵀT`, for the kept unknowns.
    pub(super) fn mean_square(&self, kept: &[usize]) -> DMatrix<f64> {
        let mut sum = DMatrix::zeros(kept.len(), kept.len());
        for moves in &self.moves {
            let moves = moves.select_columns(kept);
            sum += moves.tr_mul(&moves);
        }
        sum / self.moves.len().max(1) as f64
    }

    /// Returns the standard deviation `√tr(T C Tᵀ)` of the tool point at each configuration, from
    /// the covariance of the kept unknowns; the length unit.
    pub fn deviations(&self, identifiable: &Identifiable, covariance: &DMatrix<f64>) -> Vec<f64> {
        let deviation = |moves: &Matrix3xX<f64>| {
            let moves = moves.select_columns(&identifiable.kept);
            (&moves * covariance * moves.transpose()).trace().max(0.0).sqrt()
        };
        self.moves.iter().map(deviation).collect()
    }

    /// Returns the unknowns fixed at zero that move the tool point here although the data cannot
    /// distinguish them from their equivalents.
    ///
    /// Each has the root mean square of the difference, per unit of the unknown. The order is by
    /// falling effect of `size`.
    pub fn unseen(&self, identifiable: &Identifiable, size: impl Fn(usize) -> f64) -> Vec<(usize, f64)> {
        let n = self.moves.len().max(1) as f64;
        let beside = |(k, act_as): &(usize, Vec<(usize, f64)>)| {
            let (mut rest, mut all) = (0.0, 0.0);
            for moves in &self.moves {
                let mut column = moves.column(*k).into_owned();
                all += column.norm_squared();
                act_as.iter().for_each(|(j, factor)| column -= moves.column(*j) * *factor);
                rest += column.norm_squared();
            }
            (rest > 1e-6 * all && all > 0.0).then_some((*k, (rest / n).sqrt()))
        };
        let mut unseen: Vec<(usize, f64)> = identifiable.redundant.iter().filter_map(beside).collect();
        unseen.sort_by(|a, b| (b.1 * size(b.0)).total_cmp(&(a.1 * size(a.0))));
        unseen
    }
}
