//! Test rows outside the fitted ranges, and the uncertainty of the machine there.

use abbe::identify::{Failure, Observation};
use abbe_spec::Fitted;
use serde::Serialize;

use super::solve::Solved;

/// Test rows outside the fitted ranges of joints and inputs.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct TestExtrapolation {
    /// Number of such rows.
    pub rows: usize,
    /// Standard deviation of the tool position there, mean over these rows, in the length unit.
    pub known_outside: f64,
    /// Standard deviation of the tool position at the fitted rows, mean over them, in the length
    /// unit.
    pub known_within: f64,
}

impl TestExtrapolation {
    /// Returns none if there are no such rows.
    ///
    /// The deviations follow from the covariance of the fit. Errors that the model lacks are not
    /// included.
    pub(super) fn new(
        solved: &Solved,
        fitted: &[Fitted],
        rows: &[Observation],
        test: &[Observation],
    ) -> Result<Option<Self>, Failure> {
        let is_outside = |row: &&Observation| fitted.iter().any(|range| range.is_outside(&row.q, &row.u));
        let extrapolated = || test.iter().filter(is_outside);
        let count = extrapolated().count();
        if count == 0 {
            return Ok(None);
        }
        let (identifiable, covariance) = (&solved.fit.identifiable, &solved.fit.covariance);
        let mut sum = |sum: f64, row: &Observation| {
            let points = solved.model.tool_points(std::slice::from_ref(row))?;
            Ok(sum + points.deviations(identifiable, covariance)[0])
        };
        let beyond = extrapolated().try_fold(-0.0, &mut sum)?;
        let within = rows.iter().try_fold(-0.0, &mut sum)?;
        let [known_outside, known_within] = [beyond / count as f64, within / rows.len().max(1) as f64];
        Ok(Some(Self { rows: count, known_outside, known_within }))
    }
}
