//! Self-checks of the closed form against the exact chain: the laws of the runtime, with their
//! figures.

use std::{convert::Infallible, ops::ControlFlow};

use abbe::analysis::in_order_until;
use abbe::lanes::Batches;
use abbe::laws::{self, Discrepancy, Failure};
use abbe_spec::Spec;
use serde::Serialize;

use crate::{Notes, Result};

/// Result of checking one law.
#[derive(Clone, Debug, Serialize)]
pub struct Law {
    /// Statement of the law.
    pub law: &'static str,
    /// Relative discrepancy, or slope, without a unit; `None` if it is not finite.
    pub value: Option<f64>,
    /// Expected value, without a unit.
    pub expected: f64,
    /// Permitted difference from the expected value, without a unit.
    pub tolerance: f64,
    /// Indicates that the law holds within its tolerance.
    pub holds: bool,
    /// Reason of a failure: the discrepancy and its configuration, or why the law could not be
    /// evaluated.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub failure: Option<String>,
}

/// Returns the number of configurations to check. It decreases for long chains, for many parameters
/// and for many passive joints, whose evaluation takes longer.
pub(super) fn configurations(spec: &Spec) -> usize {
    let size = spec.frames.len().max(spec.parameters.len() / 5) + spec.passive.len();
    (20 * laws::SAMPLES / size.max(20)).max(10)
}

/// Checks all laws of a manipulator at this many configurations, side by side. Fails only if
/// interrupted.
pub fn laws(manipulator: &dyn Batches, configurations: usize, notes: &mut dyn Notes) -> Result<Vec<Law>> {
    type Compare = fn(&dyn Batches, usize) -> Result<Discrepancy, Failure>;
    let compared: [(&'static str, Compare, f64); 6] = [
        (
            "error Jacobian = finite differences of the exact chain",
            |m, n| laws::error_jacobian(m, n),
            laws::DERIVATIVE_TOLERANCE,
        ),
        (
            "joint Jacobian = finite differences of the pose",
            |m, n| laws::joint_jacobian(m, n),
            laws::DERIVATIVE_TOLERANCE,
        ),
        (
            "parameter Jacobian = finite differences of the pose",
            |m, n| laws::parameter_jacobian(m, n),
            laws::DERIVATIVE_TOLERANCE,
        ),
        ("pose = product of the transforms", |m, n| laws::pose(m, n), laws::ROUNDING_TOLERANCE),
        ("batches = single evaluations", laws::batches, laws::ROUNDING_TOLERANCE),
        (
            "ε = sum of effects, invalid arguments are rejected",
            |m, n| laws::contract(m, n),
            laws::ROUNDING_TOLERANCE,
        ),
    ];
    let count = compared.len() + 1;
    let check = |i: usize| match compared.get(i) {
        Some(&(law, compare, tolerance)) => {
            let found = compare(manipulator, configurations);
            let value = found.as_ref().ok().map(|found| found.relative);
            let verdict = found.and_then(|found| found.within(law, tolerance));
            Law::new(law, value, 0.0, tolerance, verdict)
        }
        None => {
            let found = laws::remainder_slope(manipulator, configurations);
            let value = found.as_ref().ok().map(|found| found.slope);
            let verdict = found.and_then(|found| found.within(laws::SLOPE_TOLERANCE));
            Law::new("slope of the first-order remainder", value, 2.0, laws::SLOPE_TOLERANCE, verdict)
        }
    };
    notes.progress(0, count * configurations);
    let mut checked = Vec::new();
    in_order_until(
        count,
        |i| Ok::<_, Infallible>(check(i)),
        |law| {
            checked.push(law);
            notes.progress(checked.len() * configurations, count * configurations);
            if notes.stop() { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
        },
    )
    .unwrap_or_else(|never| match never {});
    notes.go_on()?;
    Ok(checked)
}

impl Law {
    fn new(
        law: &'static str,
        value: Option<f64>,
        expected: f64,
        tolerance: f64,
        verdict: Result<(), Failure>,
    ) -> Self {
        let value = value.filter(|value| value.is_finite());
        let failure = verdict.err().map(|failure| failure.to_string());
        Self { law, value, expected, tolerance, holds: failure.is_none(), failure }
    }
}
