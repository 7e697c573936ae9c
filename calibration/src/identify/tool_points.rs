//! The tool point where the machine is used: how it moves with what is unknown, and how well it will be known.

use nalgebra::{DMatrix, Matrix3xX};

use super::{Failure, Identifiable, Measurement, Model, Observation, Unknown};

/// How the tool point moves with every unknown, at the configurations of a list. The length unit, per unit of the unknown.
#[derive(Clone, Debug, PartialEq)]
pub struct ToolPoints {
    moves: Vec<Matrix3xX<f64>>,
}

impl Model<'_> {
    /// How the tool point moves with every unknown where the machine is used; nothing is measured there.
    ///
    /// A single target at zero is the tool point: where it is on the tool is among what was measured. Any other tool point is a
    /// target of its own, which nothing is unknown of.
    pub fn tool_points(&self, used: &[Observation]) -> Result<ToolPoints, Failure> {
        let mut model = self.clone();
        let single = self.targets.len() == 1
            && !self.unknowns.iter().any(|unknown| matches!(unknown, Unknown::Tool(_)));
        let place = if single { 0 } else { self.targets.len() };
        if !single {
            model.targets.push([0.0; 3]);
        }
        let mut points = vec![None; model.targets.len()];
        points[place] = Some([0.0; 3]);
        let p = self.unknowns.len();
        let (mut room, x) = (model.room(), vec![0.0; p]);
        let length = self.uncertainty.length;
        let one = |row: &Observation| {
            let seen = Observation {
                measured: Measurement::Points(points.clone().into()),
                weight: 1.0,
                ..row.clone()
            };
            let mut moves = Matrix3xX::zeros(p);
            let mut axis = 0;
            model.linear(&mut room, &seen, &x, |_, row| {
                (0..p).for_each(|k| moves[(axis, k)] = row[k] * length);
                axis += 1;
            })?;
            Ok(moves)
        };
        Ok(ToolPoints { moves: used.iter().map(one).collect::<Result<_, _>>()? })
    }
}

impl ToolPoints {
    /// `B`, the mean of `TᵀT`, of these unknowns.
    pub(super) fn of(&self, kept: &[usize]) -> DMatrix<f64> {
        let mut sum = DMatrix::zeros(kept.len(), kept.len());
        for moves in &self.moves {
            let moves = moves.select_columns(kept);
            sum += moves.tr_mul(&moves);
        }
        sum / self.moves.len().max(1) as f64
    }

    /// The standard deviation of the tool point at every configuration, from the covariance of the kept unknowns:
    /// `√tr(T C Tᵀ)`. The length unit.
    pub fn deviations(&self, identifiable: &Identifiable, covariance: &DMatrix<f64>) -> Vec<f64> {
        let deviation = |moves: &Matrix3xX<f64>| {
            let moves = moves.select_columns(&identifiable.kept);
            (&moves * covariance * moves.transpose()).trace().max(0.0).sqrt()
        };
        self.moves.iter().map(deviation).collect()
    }

    /// What is held at zero, as it cannot be told from what is kept, and yet moves the tool point here: each with the root mean
    /// square of what it moves beside what stands for it, per unit. The largest first, by what `size` counts as one unit.
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
        let mut unseen: Vec<(usize, f64)> = identifiable.held.iter().filter_map(beside).collect();
        unseen.sort_by(|a, b| (b.1 * size(b.0)).total_cmp(&(a.1 * size(a.0))));
        unseen
    }
}
