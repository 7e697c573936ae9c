//! Tolerances held against a budget.

use abbe::analysis::{Budget, Compliance, Measurand};
use serde::Serialize;

/// Whether a tolerance is met.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Verdict {
    /// For certain: all random sources are bounded, and no draw of any of them exceeds it at any
    /// configuration of the workspace, to first order.
    Met,
    /// With the probability that the study asks for, or more, where the radius is largest.
    MetWithProbability,
    /// With less than that.
    NotMet,
}

/// The verdict on position or orientation. Lengths in the spec's unit, angles in rad.
///
/// The probability is that where the radius (the norm of the repeatable errors and that of the random bounds, added) is
/// largest: repeatable sources as they are, random ones drawn, to first order. Elsewhere it may be a little lower, where
/// the random errors are larger and the repeatable ones smaller.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Judged {
    /// What it is about.
    pub measurand: Measurand,
    /// How large the norm of the error may be.
    pub tolerance: f64,
    /// Whether it is.
    pub verdict: Verdict,
    /// The largest error that any draw can make, if all random sources are bounded.
    pub largest: Option<f64>,
    /// How likely the tolerance is met: 1 if for certain.
    pub compliance: Compliance,
}

impl Judged {
    /// Judges the errors of a budget; `compliance` evaluates the probability at a configuration.
    pub(super) fn new<E>(
        budget: &Budget,
        measurand: Measurand,
        (tolerance, asked): (f64, f64),
        compliance: impl FnOnce(Option<usize>) -> Result<Compliance, E>,
    ) -> Result<Self, E> {
        let (sources, combined, _) = budget.errors(measurand);
        let bounded = sources.iter().all(|errors| errors.class.is_bounded() || errors.plain_max.norm == 0.0);
        let largest = bounded.then_some(combined.bounded_radius.value);
        if largest.is_some_and(|largest| largest <= tolerance) {
            let compliance = Compliance { probability: 1.0, error: 0.0, draws: None };
            return Ok(Self { measurand, tolerance, verdict: Verdict::Met, largest, compliance });
        }
        let compliance = compliance(combined.radius.configuration)?;
        let met = compliance.probability >= asked;
        let verdict = if met { Verdict::MetWithProbability } else { Verdict::NotMet };
        Ok(Self { measurand, tolerance, verdict, largest, compliance })
    }
}
