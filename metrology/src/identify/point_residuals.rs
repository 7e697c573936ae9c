//! Residuals of every point, for plots.

use std::collections::HashSet;

use abbe::identify::{Failure, Model, Observation, Scratch};
use abbe_spec::diagnostic::Diagnostics;

use super::solve::Solved;
use crate::data::Data;
use abbe_study::mistake;

/// Residuals of a measured point, in the frame of the instrument and the length unit.
#[derive(Clone, Debug)]
pub struct PointResidual {
    /// Line of its row.
    pub line: u64,
    /// Joint values of its row, in the length unit and rad.
    pub q: Vec<f64>,
    /// Inputs of its row.
    pub u: Vec<f64>,
    /// Index of its station.
    pub station: usize,
    /// Tool point predicted by the identified model.
    pub point: [f64; 3],
    /// Measurement minus model with only base and tool fitted.
    pub before: [f64; 3],
    /// Measurement minus identified model.
    pub after: [f64; 3],
    /// Is true for a test row.
    pub is_test: bool,
    /// Is true for a row rejected as an outlier.
    pub is_rejected: bool,
}

/// Model with values of its unknowns.
struct EvaluatedModel<'m> {
    model: &'m Model<'m>,
    x: &'m [f64],
    scratch: Scratch,
}

impl<'m> EvaluatedModel<'m> {
    fn new(model: &'m Model<'m>, x: &'m [f64]) -> Self {
        Self { model, x, scratch: model.scratch() }
    }

    fn deviations(&mut self, row: &Observation) -> Result<Vec<[f64; 3]>, Failure> {
        let points = self.model.deviations(&mut self.scratch, row, self.x)?;
        Ok(points.into_iter().map(|point| point.map(|v| -v)).collect())
    }

    /// Returns the residuals of a row. `self` is the identified model, `before` the one with only
    /// base and tool fitted.
    fn residuals(
        &mut self,
        before: &mut EvaluatedModel,
        row: &Observation,
        is_test: bool,
        is_rejected: bool,
    ) -> Result<Vec<PointResidual>, Failure> {
        let point = self.model.pose(&mut self.scratch, row, self.x)?.position();
        let both = before.deviations(row)?.into_iter().zip(self.deviations(row)?);
        let one = |(before, after)| PointResidual {
            line: row.line,
            q: row.q.to_vec(),
            u: row.u.to_vec(),
            station: row.station as usize,
            point,
            before,
            after,
            is_test,
            is_rejected,
        };
        Ok(both.map(one).collect())
    }
}

/// Returns the residuals of every point, for plots.
pub(super) fn points(
    solved: &Solved,
    data: &Data,
    test: Option<&Data>,
) -> Result<Vec<PointResidual>, Diagnostics> {
    let Solved { simple, simple_x, model, fit, .. } = solved;
    let (mut before, mut after) = (EvaluatedModel::new(simple, simple_x), EvaluatedModel::new(model, &fit.x));
    let rejected: HashSet<u64> = fit.rejected(&data.observations).map(|row| row.line).collect();
    let mut points = Vec::new();
    for (data, is_test) in [(data, false)].into_iter().chain(test.map(|test| (test, true))) {
        for row in &data.observations {
            let is_rejected = !is_test && rejected.contains(&row.line);
            let here = after.residuals(&mut before, row, is_test, is_rejected);
            points.extend(here.map_err(|failure| mistake::whole(&data.file, &failure))?);
        }
    }
    Ok(points)
}
