//! The results for machines.

mod allowed;
mod covered;
mod drawn;
mod ledger;
mod orientation;
mod together;

use abbe::analysis::{Figures, Measurand, SourceErrors};
use serde::{Serialize, Serializer};

use super::agreement::Agreement;
use super::report::Report;
use super::stated::Stated;
use super::unreachable;
use allowed::Allowed;

use crate::bound::Norms;
use crate::number::{self, Named};
use crate::study_file::{CombinedFigure, Metric, Subject};

#[derive(Serialize)]
struct Shape<'a> {
    manipulator: &'a str,
    configurations: usize,
    unreachable: usize,
    sources: Vec<Source<'a>>,
    combined: Combined,
    study: &'a str,
    workspace: &'a str,
    length: &'static str,
    #[serde(skip_serializing_if = "Option::is_none")]
    tolerance: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    verdict: Option<covered::Judgement>,
    #[serde(skip_serializing_if = "Option::is_none")]
    uncertainty: Option<covered::Uncertainty<'a>>,
    orientation: orientation::Orientation<'a>,
    published: Vec<Comparison>,
    #[serde(skip_serializing_if = "Option::is_none")]
    after_compensation: Option<AfterCompensation>,
    first_order: FirstOrder,
    #[serde(skip_serializing_if = "Option::is_none")]
    certified: Option<&'a Norms>,
    unreachable_reasons: Vec<unreachable::Reason>,
    not_reproducible: &'a [String],
    ledger: ledger::Ledger<'a>,
    #[serde(skip_serializing_if = "Option::is_none")]
    budget: Option<allowed::Allowed<'a>>,
    #[serde(skip_serializing_if = "Option::is_none")]
    compensation: Option<together::Compensated>,
    #[serde(skip_serializing_if = "Option::is_none")]
    monte_carlo: Option<drawn::Shape>,
}

#[derive(Serialize)]
struct Source<'a> {
    name: &'a str,
    at: String,
    class: &'static str,
    plain_max: Axes,
    half_peak_to_peak: Axes,
    relative_to_home: Axes,
    worst: Named,
    #[serde(skip_serializing_if = "Option::is_none")]
    distribution: Option<&'static str>,
    worst_parameters: Named,
    /// The largest of rows 4–6, rad.
    orientation: [f64; 3],
}

#[derive(Serialize)]
struct Axes {
    x: f64,
    y: f64,
    z: f64,
    norm: f64,
}

#[derive(Serialize)]
struct Combined {
    repeatable_radius: f64,
    random_radius: f64,
    radius: f64,
    repeatable: [f64; 3],
    random: [f64; 3],
    worst: Named,
    worst_parameters: Named,
    #[serde(flatten)]
    together: together::Together,
}

/// A published figure: of a source in a metric, or of all together.
#[derive(Serialize)]
struct Comparison {
    figure: String,
    metric: &'static str,
    x: Option<f64>,
    y: Option<f64>,
    z: Option<f64>,
    norm: Option<f64>,
    within: f64,
    met: bool,
    reference: String,
}

#[derive(Serialize)]
struct AfterCompensation {
    residual: f64,
    random: f64,
    total: f64,
    published: Parts,
}

#[derive(Serialize)]
struct Parts {
    residual: f64,
    random: f64,
    total: f64,
}

#[derive(Serialize)]
struct FirstOrder {
    configurations: usize,
    largest_difference: f64,
}

impl Serialize for Report {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        shape(self).serialize(serializer)
    }
}

fn shape(report: &Report) -> Shape<'_> {
    let Report { spec, study, budget, first_order, .. } = report;
    let combined = &budget.combined;
    let worst = report.configuration(combined.radius.configuration);
    Shape {
        manipulator: &spec.name,
        configurations: budget.configurations,
        unreachable: budget.unreachable.count,
        sources: budget.sources.iter().map(|errors| source(report, errors)).collect(),
        combined: Combined {
            repeatable_radius: combined.repeatable_radius.value,
            random_radius: combined.random_radius.value,
            radius: combined.radius.value,
            repeatable: combined.repeatable,
            random: combined.random,
            worst: report.variables(worst),
            worst_parameters: report.parameters(worst),
            together: together::of(report),
        },
        study: &study.title,
        workspace: &report.workspace,
        length: spec.length.symbol(),
        tolerance: study.tolerance,
        verdict: covered::verdict(report),
        uncertainty: report
            .stated
            .iter()
            .find(|stated| stated.statement.measurand == Measurand::Position)
            .map(|stated| covered::uncertainty(report, stated)),
        orientation: orientation::of(report),
        published: comparisons(report),
        after_compensation: study.compensated.as_ref().map(|published| AfterCompensation {
            residual: published.residual,
            random: combined.random_radius.value,
            total: published.residual + combined.random_radius.value,
            published: Parts {
                residual: published.residual,
                random: published.random,
                total: published.total,
            },
        }),
        first_order: FirstOrder {
            configurations: first_order.checked,
            largest_difference: first_order.largest,
        },
        certified: report.certified.as_ref(),
        unreachable_reasons: unreachable::reasons(&budget.unreachable, spec),
        not_reproducible: &study.not_reproducible,
        ledger: ledger::of(report),
        budget: report
            .admissible
            .as_ref()
            .map(|admissible| allowed::of(report, admissible, Measurand::Position)),
        compensation: report.budget.compensation.as_ref().map(together::compensated),
        monte_carlo: report.monte_carlo.as_ref().map(|found| drawn::of(report, found)),
    }
}

fn source<'a>(report: &'a Report, errors: &SourceErrors) -> Source<'a> {
    let worst = report.configuration(errors.worst);
    let (class, distribution) = number::class(errors.class);
    Source {
        name: &report.source(errors.source).name,
        at: report.spec.place(report.source(errors.source)),
        class,
        plain_max: axes(errors.plain_max),
        half_peak_to_peak: axes(errors.half_peak_to_peak),
        relative_to_home: axes(errors.relative_to_home),
        worst: report.variables(worst),
        distribution,
        worst_parameters: report.parameters(worst),
        orientation: {
            let Figures { x, y, z, .. } = report.budget.orientation.sources[errors.source].plain_max;
            [x, y, z]
        },
    }
}

fn axes(figures: Figures) -> Axes {
    let Figures { x, y, z, norm } = figures;
    Axes { x, y, z, norm }
}

fn comparisons(report: &Report) -> Vec<Comparison> {
    let alone = report.budget.sources.iter().flat_map(|errors| {
        let name = report.name(errors);
        Metric::ALL.map(|(metric, kind)| (name, metric, Subject::Source(name.to_owned(), kind)))
    });
    let combined = CombinedFigure::ALL.map(|(name, figure)| ("combined", name, Subject::Combined(figure)));
    let all = alone.chain(combined);
    all.filter_map(|(figure, metric, subject)| {
        let (published, agreement) = report.published(&subject)?;
        let [x, y, z, norm] = published.figures;
        Some(Comparison {
            figure: figure.to_owned(),
            metric,
            x,
            y,
            z,
            norm,
            within: published.within,
            met: agreement == Agreement::Met,
            reference: published.reference.clone(),
        })
    })
    .collect()
}
