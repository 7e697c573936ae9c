//! Residuals of every point, for plots.

use std::collections::HashSet;

use abbe::identify::{EvaluatedModel, Failure, Observation};

use super::solve::Solved;
use crate::data::Data;
use abbe_study::{About, Result};

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

/// Returns the residuals of a row: `after` is the identified model, `before` the one with only base
/// and tool fitted.
fn residuals(
    [before, after]: [&mut EvaluatedModel; 2],
    row: &Observation,
    is_test: bool,
    is_rejected: bool,
) -> Result<Vec<PointResidual>, Failure> {
    let point = after.pose(row)?.position();
    let both = before.deviations(row)?.into_iter().zip(after.deviations(row)?);
    let one = |(before, after): ([f64; 3], [f64; 3])| PointResidual {
        line: row.line,
        q: row.q.to_vec(),
        u: row.u.to_vec(),
        station: row.station as usize,
        point,
        before: before.map(|v| -v),
        after: after.map(|v| -v),
        is_test,
        is_rejected,
    };
    Ok(both.map(one).collect())
}

/// Returns the residuals of every point, for plots.
pub(super) fn points(solved: &Solved, data: &Data, test: Option<&Data>) -> Result<Vec<PointResidual>> {
    let Solved { simple, simple_x, model, fit, .. } = solved;
    let (mut before, mut after) = (simple.at(simple_x), model.at(&fit.x));
    let rejected: HashSet<u64> = fit.rejected(&data.observations).map(|row| row.line).collect();
    let mut points = Vec::new();
    for (data, is_test) in [(data, false)].into_iter().chain(test.map(|test| (test, true))) {
        for row in &data.observations {
            let is_rejected = !is_test && rejected.contains(&row.line);
            points.extend(residuals([&mut before, &mut after], row, is_test, is_rejected).about(&data.file)?);
        }
    }
    Ok(points)
}
