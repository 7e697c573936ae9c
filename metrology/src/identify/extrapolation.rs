//! Test rows outside the fitted ranges, and the uncertainty of the machine there.

use std::borrow::Cow;

use abbe_interpreter::Interpreter;
use abbe_spec::Spec;
use serde::Serialize;

use super::found_model::FoundModel;
use crate::data::Data;
use abbe_study::extrapolation::ToolPointDeviation;

/// Test rows outside the fitted ranges of joints and inputs.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct TestExtrapolation {
    /// Number of such rows.
    pub count: usize,
    /// Standard deviation of the tool point; `null` if the spec cannot be written.
    pub standard_deviation: Option<ToolPointDeviation>,
}

impl TestExtrapolation {
    /// Returns none if there are no such rows. `written` is the machine of the written spec,
    /// `points` are the measured ones in the frame of the tool.
    ///
    /// The deviations follow from the covariance and the random sources of the written spec, as in
    /// `measure`.
    pub(super) fn new(
        found: &FoundModel,
        spec: &Spec,
        test: &Data,
        written: Option<&Interpreter>,
        points: &[[f64; 3]],
    ) -> Option<Self> {
        let test = written.map_or(Cow::Borrowed(test), |_| found.as_written(spec, test));
        let places = test.observations.iter().map(|row| (&row.q[..], &row.u[..]));
        let fitted = written.map_or(&found.fitted, |written| &written.spec().fitted);
        let outside = places.filter(|(q, u)| fitted.iter().any(|range| range.is_outside(q, u)));
        let outside = outside.collect::<Vec<_>>();
        if outside.is_empty() {
            return None;
        }
        let standard_deviation =
            written.and_then(|written| ToolPointDeviation::new(written.spec(), written, points, &outside));
        Some(Self { count: outside.len(), standard_deviation })
    }
}
