//! The budget backwards: the errors that a tolerance allows.

use abbe::analysis::{Admissible, Budget, Measurand};
use abbe_spec::Spec;
use serde::Serialize;

/// Errors that a tolerance allows, as multiples of what the sources are now.
#[derive(Clone, Debug, Serialize)]
pub struct ErrorAllowance {
    /// Factor for all sources; none if they do nothing.
    pub together: Option<f64>,
    /// Error that each source may contribute if all contribute alike.
    pub equal_share: Option<f64>,
    /// Least probability that the tolerance is met with equal shares.
    pub equal_share_probability: f64,
    /// The source to tighten first comes first.
    pub sources: Vec<SourceAllowance>,
}

/// Errors that a tolerance allows one source.
#[derive(Clone, Debug, Serialize)]
pub struct SourceAllowance {
    /// Name of the source.
    pub name: String,
    /// Factor if there were no other source; none if it does nothing.
    pub alone: Option<f64>,
    /// Factor for an equal share.
    pub equal: Option<f64>,
    /// Decrease of the radius if the source is made smaller by one percent.
    pub gain_per_percent: f64,
}

impl ErrorAllowance {
    /// Inverts a budget for the tolerance of a measurand.
    pub(in crate::analyze) fn new(
        budget: &Budget,
        spec: &Spec,
        measurand: Measurand,
        tolerance: f64,
    ) -> Self {
        let admissible = Admissible::of_measurand(budget, measurand, tolerance);
        let (_, _, gains) = budget.errors(measurand);
        let names = spec.enabled_sources().map(|source| &source.name).collect::<Vec<_>>();
        let source = |i: usize| SourceAllowance {
            name: names[i].clone(),
            alone: admissible.alone[i],
            equal: admissible.equal[i],
            // Never −0.
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
