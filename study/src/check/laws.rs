//! Whether the closed form agrees with the exact chain: the laws of the runtime, with their figures.

use abbe::lanes::Batches;
use abbe::laws::{self, Discrepancy, Failure};
use abbe_codegen::spec::Spec;
use serde::Serialize;

/// One law and how well it holds.
#[derive(Clone, Debug, Serialize)]
pub struct Law {
    /// What should hold.
    pub law: &'static str,
    /// A relative discrepancy, or a slope; none if it is not finite.
    pub value: Option<f64>,
    /// What it should be.
    pub expected: f64,
    /// By how much it may differ.
    pub tolerance: f64,
    /// Whether it is within its tolerance.
    pub holds: bool,
    /// Why it could not be looked at, or by how much it fails, and where.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub failure: Option<String>,
}

/// How many configurations are looked at; fewer of a very long chain, whose laws take the square of its length.
pub(super) fn configurations(spec: &Spec) -> usize {
    (20 * laws::SAMPLES / spec.frames.len().max(20)).max(10)
}

/// Every law of a manipulator, at that many configurations.
pub fn laws(manipulator: &dyn Batches, configurations: usize) -> Vec<Law> {
    type Compare = fn(&dyn Batches, usize) -> Result<Discrepancy, Failure>;
    let compared: [(&'static str, Compare, f64); 6] = [
        (
            "error Jacobian = differences of the exact chain",
            |m, n| laws::error_jacobian(m, n),
            laws::DERIVATIVE_TOLERANCE,
        ),
        (
            "joint Jacobian = differences of the pose",
            |m, n| laws::joint_jacobian(m, n),
            laws::DERIVATIVE_TOLERANCE,
        ),
        (
            "parameter Jacobian = differences of the pose",
            |m, n| laws::parameter_jacobian(m, n),
            laws::DERIVATIVE_TOLERANCE,
        ),
        ("pose = product of the transforms", |m, n| laws::pose(m, n), laws::ROUNDING_TOLERANCE),
        ("batches = single evaluations", laws::batches, laws::ROUNDING_TOLERANCE),
        (
            "ε = sum of effects, bad arguments are refused",
            |m, n| laws::contract(m, n),
            laws::ROUNDING_TOLERANCE,
        ),
    ];
    let mut checked = Vec::new();
    for (law, compare, tolerance) in compared {
        let found = compare(manipulator, configurations);
        let value = found.as_ref().ok().map(|found| found.relative);
        let verdict = found.and_then(|found| found.within(law, tolerance));
        checked.push(Law::new(law, value, 0.0, tolerance, verdict));
    }
    let found = laws::remainder_slope(manipulator, configurations);
    let value = found.as_ref().ok().map(|found| found.slope);
    let verdict = found.and_then(|found| found.within(laws::SLOPE_TOLERANCE));
    checked.push(Law::new("slope of what first order neglects", value, 2.0, laws::SLOPE_TOLERANCE, verdict));
    checked
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
