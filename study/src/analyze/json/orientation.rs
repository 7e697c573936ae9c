//! What the sources do to the orientation, for machines: rows 4–6 and their norm, rad.

use serde::Serialize;

use super::super::report::Report;
use super::{Allowed, Axes, Stated, allowed, axes, covered};
use crate::number::Named;
use abbe::analysis::Measurand;

#[derive(Serialize)]
pub(super) struct Orientation<'a> {
    rows: [&'static str; 3],
    sources: Vec<Source<'a>>,
    repeatable_radius: f64,
    random_radius: f64,
    radius: f64,
    repeatable: [f64; 3],
    random: [f64; 3],
    standard_deviation: [f64; 3],
    standard_radius: f64,
    worst: Named,
    #[serde(skip_serializing_if = "Option::is_none")]
    tolerance: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    budget: Option<Allowed<'a>>,
    #[serde(skip_serializing_if = "Option::is_none")]
    uncertainty: Option<covered::Uncertainty<'a>>,
}

#[derive(Serialize)]
struct Source<'a> {
    name: &'a str,
    plain_max: Axes,
    half_peak_to_peak: Axes,
    relative_to_home: Axes,
    rms: f64,
    worst: Named,
}

pub(super) fn of(report: &Report) -> Orientation<'_> {
    let (sources, combined, _) = report.budget.errors(Measurand::Orientation);
    let stated = |stated: &&Stated| stated.statement.measurand == Measurand::Orientation;
    let place = |index| report.variables(report.configuration(index));
    let source = |errors: &abbe::analysis::SourceErrors| Source {
        name: &report.source(errors.source).name,
        plain_max: axes(errors.plain_max),
        half_peak_to_peak: axes(errors.half_peak_to_peak),
        relative_to_home: axes(errors.relative_to_home),
        rms: errors.rms,
        worst: place(errors.worst),
    };
    let admissible = report.admissible(Measurand::Orientation);
    Orientation {
        rows: super::super::unit::rows(report, Measurand::Orientation),
        sources: sources.iter().map(source).collect(),
        repeatable_radius: combined.repeatable_radius.value,
        random_radius: combined.random_radius.value,
        radius: combined.radius.value,
        repeatable: combined.repeatable,
        random: combined.random,
        standard_deviation: combined.standard_deviation,
        standard_radius: combined.standard_radius.value,
        worst: place(combined.radius.configuration),
        tolerance: report.study.orientation_tolerance,
        budget: admissible.map(|admissible| allowed::of(report, admissible, Measurand::Orientation)),
        uncertainty: report.stated.iter().find(stated).map(|stated| covered::uncertainty(report, stated)),
    }
}
