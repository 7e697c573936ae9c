//! The budget backwards, for machines.

use abbe::analysis::{Admissible, Measurand};
use serde::Serialize;

use super::super::report::Report;

#[derive(Serialize)]
pub(super) struct Allowed<'a> {
    /// The factor for all sources.
    together: Option<f64>,
    /// What each may contribute if all contribute alike.
    equal_share: Option<f64>,
    /// How likely the tolerance is met with equal shares, at least.
    equal_share_probability: f64,
    /// The one to tighten first comes first.
    sources: Vec<Source<'a>>,
}

#[derive(Serialize)]
struct Source<'a> {
    name: &'a str,
    alone: Option<f64>,
    equal: Option<f64>,
    gain_per_percent: f64,
}

pub(super) fn of<'a>(report: &'a Report, admissible: &Admissible, measurand: Measurand) -> Allowed<'a> {
    let (_, _, gains) = report.budget.errors(measurand);
    let source = |i: usize| Source {
        name: &report.source(i).name,
        alone: admissible.alone[i],
        equal: admissible.equal[i],
        gain_per_percent: gains[i] + 0.0,
    };
    Allowed {
        together: admissible.together,
        equal_share: admissible.share,
        equal_share_probability: admissible.equal_probability,
        sources: report.budget.tighten_first_for(measurand).into_iter().map(source).collect(),
    }
}
