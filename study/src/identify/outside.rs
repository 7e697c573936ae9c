//! Test rows outside the ranges that were fitted, and how well the machine is known there.

use abbe::identify::{Failure, Observation};
use abbe_codegen::spec::Fitted;
use serde::Serialize;

use super::solve::Solved;

/// Rows outside the ranges of joints and inputs that were fitted.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct Outside {
    /// How many rows.
    pub rows: usize,
    /// How well the place of the tool is known there: one standard deviation, the mean over these rows. The length unit.
    pub known_outside: f64,
    /// The same over the rows that were fitted.
    pub known_within: f64,
}

impl Outside {
    /// None if there are no such rows. From the covariance of what was found: what the model does not have grows unseen.
    pub(super) fn new(
        solved: &Solved,
        fitted: &[Fitted],
        rows: &[Observation],
        test: &[Observation],
    ) -> Result<Option<Self>, Failure> {
        let is_outside = |row: &&Observation| fitted.iter().any(|range| range.is_outside(&row.q, &row.u));
        let outside: Vec<Observation> = test.iter().filter(is_outside).cloned().collect();
        if outside.is_empty() {
            return Ok(None);
        }
        let known = |rows: &[Observation]| {
            let points = solved.model.tool_points(rows)?;
            let all = points.deviations(&solved.fit.identifiable, &solved.fit.covariance);
            Ok(all.iter().sum::<f64>() / all.len().max(1) as f64)
        };
        Ok(Some(Self { rows: outside.len(), known_outside: known(&outside)?, known_within: known(rows)? }))
    }
}
