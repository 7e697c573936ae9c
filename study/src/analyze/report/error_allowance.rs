//! Inverse budget: the errors that a tolerance allows.

use abbe::analysis::{Admissible, Budget, Measurand};
use abbe_spec::Spec;
use serde::Serialize;

/// Errors that a tolerance allows, as factors of the present errors.
#[derive(Clone, Debug, Serialize)]
pub struct ErrorAllowance {
    /// Factor for all sources at which the radius equals the tolerance; `None` if there is no
    /// error.
    pub together: Option<f64>,
    /// Norm of the error that each contributing source may cause if all have equal shares, in the
    /// tolerance's unit.
    pub equal_share: Option<f64>,
    /// Lower bound on the probability that the tolerance is met with equal shares.
    pub equal_share_probability: f64,
    /// Allowances of the sources, largest gain first.
    pub sources: Vec<SourceAllowance>,
}

/// Errors that a tolerance allows one source.
#[derive(Clone, Debug, Serialize)]
pub struct SourceAllowance {
    /// Name of the source.
    pub name: String,
    /// Factor if there were no other source; `None` if it causes no error.
    pub alone: Option<f64>,
    /// Factor for an equal share; `None` if it causes no error.
    pub equal: Option<f64>,
    /// Decrease of the radius if the source is reduced by one percent, in the tolerance's unit.
    pub gain_per_percent: f64,
}

impl ErrorAllowance {
    /// Inverts a budget for a tolerance of a measurand.
    pub(in crate::analyze) fn new(
        budget: &Budget,
        spec: &Spec,
        measurand: Measurand,
        tolerance: f64,
    ) -> Self {
        let admissible = Admissible::for_measurand(budget, measurand, tolerance);
        let (_, _, gains) = budget.errors(measurand);
        let names = spec.enabled_sources().map(|source| &source.name).collect::<Vec<_>>();
        let source = |i: usize| SourceAllowance {
            name: names[i].clone(),
            alone: admissible.alone[i],
            equal: admissible.equal[i],
            // Avoids −0.
            gain_per_percent: gains[i] + 0.0,
        };
        Self {
            together: admissible.together,
            equal_share: admissible.share,
            equal_share_probability: admissible.equal_probability,
            sources: budget.tighten_first_for(measurand).into_iter().map(source).collect(),
        }
    }
}
