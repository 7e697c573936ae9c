//! Test rows outside the ranges that were fitted, and the uncertainty of the machine there.

use abbe::identify::{Failure, Observation};
use abbe_spec::Fitted;
use serde::Serialize;

use super::solve::Solved;

/// Rows outside the ranges of joints and inputs that were fitted.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct Extrapolation {
    /// How many rows.
    pub rows: usize,
    /// How well the place of the tool is known there: one standard deviation, the mean over these rows. The length unit.
    pub known_outside: f64,
    /// The same over the rows that were fitted.
    pub known_within: f64,
}

impl Extrapolation {
    /// None if there are no such rows. From the covariance of what was found: what the model does not have grows unseen.
    pub(super) fn new(
        solved: &Solved,
        fitted: &[Fitted],
        rows: &[Observation],
        test: &[Observation],
    ) -> Result<Option<Self>, Failure> {
        let is_outside = |row: &&Observation| fitted.iter().any(|range| range.is_outside(&row.q, &row.u));
        let outside = || test.iter().filter(is_outside);
        let count = outside().count();
        if count == 0 {
            return Ok(None);
        }
        let (identifiable, covariance) = (&solved.fit.identifiable, &solved.fit.covariance);
        let mut sum = |sum: f64, row: &Observation| {
            let points = solved.model.tool_points(std::slice::from_ref(row))?;
            Ok(sum + points.deviations(identifiable, covariance)[0])
        };
        let beyond = outside().try_fold(-0.0, &mut sum)?;
        let within = rows.iter().try_fold(-0.0, &mut sum)?;
        let [known_outside, known_within] = [beyond / count as f64, within / rows.len().max(1) as f64];
        Ok(Some(Self { rows: count, known_outside, known_within }))
    }
}
