//! The results for machines.

mod allowed;
mod drawn;
mod ledger;
mod together;

use abbe::analysis::{Configuration, Figures, SourceErrors};
use abbe::{Class, Distribution};
use serde::Serialize;

use super::agreement::{Agreement, of_source};
use super::{Analysis, unreachable};
use abbe_study::number::Named;
use abbe_study::study_file::{CombinedFigure, Metric, Published};

#[derive(Serialize)]
pub(super) struct Report<'a> {
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
    published: Vec<Comparison>,
    #[serde(skip_serializing_if = "Option::is_none")]
    after_compensation: Option<AfterCompensation>,
    first_order: FirstOrder,
    unreachable_reasons: Vec<unreachable::Reason>,
    not_reproducible: &'a [String],
    ledger: ledger::Ledger<'a>,
    #[serde(skip_serializing_if = "Option::is_none")]
    budget: Option<allowed::Allowed<'a>>,
    #[serde(skip_serializing_if = "Option::is_none")]
    compensation: Option<together::Compensated>,
    #[serde(skip_serializing_if = "Option::is_none")]
    monte_carlo: Option<drawn::Report>,
}

#[derive(Serialize)]
struct Source<'a> {
    name: &'a str,
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

pub(super) fn of<'a>(analysis: &'a Analysis<'a>) -> Report<'a> {
    let Analysis { description, study, budget, first_order, .. } = analysis;
    let combined = &budget.combined;
    let worst = analysis.configuration(combined.radius.configuration);
    Report {
        manipulator: &description.name,
        configurations: budget.configurations,
        unreachable: budget.unreachable.count,
        sources: budget.sources.iter().map(|errors| source(analysis, errors)).collect(),
        combined: Combined {
            repeatable_radius: combined.repeatable_radius.value,
            random_radius: combined.random_radius.value,
            radius: combined.radius.value,
            repeatable: combined.repeatable,
            random: combined.random,
            worst: variables(analysis, &worst),
            worst_parameters: parameters(analysis, &worst),
            together: together::of(analysis),
        },
        study: &study.title,
        workspace: &analysis.region,
        length: description.length.symbol(),
        tolerance: study.tolerance,
        published: comparisons(analysis),
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
        unreachable_reasons: unreachable::reasons(&budget.unreachable, description),
        not_reproducible: &study.not_reproducible,
        ledger: ledger::of(analysis),
        budget: analysis.admissible.as_ref().map(|admissible| allowed::of(analysis, admissible)),
        compensation: analysis.budget.compensation.as_ref().map(together::compensated),
        monte_carlo: analysis.drawn.as_ref().map(|found| drawn::of(analysis, found)),
    }
}

fn source<'a>(analysis: &'a Analysis<'a>, errors: &SourceErrors) -> Source<'a> {
    let worst = analysis.configuration(errors.worst);
    let (class, distribution) = class(errors.class);
    Source {
        name: &analysis.description.sources[errors.source].name,
        class,
        plain_max: axes(errors.plain_max),
        half_peak_to_peak: axes(errors.half_peak_to_peak),
        relative_to_home: axes(errors.relative_to_home),
        worst: variables(analysis, &worst),
        distribution,
        worst_parameters: parameters(analysis, &worst),
        orientation: errors.orientation,
    }
}

pub(super) fn class(class: Class) -> (&'static str, Option<&'static str>) {
    match class {
        Class::Repeatable => ("repeatable", None),
        Class::Random(Distribution::Uniform) => ("random", Some("uniform")),
        Class::Random(Distribution::Normal) => ("random", Some("normal")),
    }
}

fn axes(figures: Figures) -> Axes {
    let Figures { x, y, z, norm } = figures;
    Axes { x, y, z, norm }
}

fn variables(analysis: &Analysis, configuration: &Option<Configuration>) -> Named {
    let values = configuration.iter().flat_map(|configuration| &configuration.q);
    let named = analysis.description.variables.iter().zip(values);
    Named(named.map(|(variable, value)| (variable.name.to_string(), value + 0.0)).collect())
}

fn parameters(analysis: &Analysis, configuration: &Option<Configuration>) -> Named {
    let named = analysis.varying.iter().filter_map(|&i| {
        let name = analysis.description.parameters[i].name.to_string();
        configuration.as_ref().map(|configuration| (name, configuration.s[i] + 0.0))
    });
    Named(named.collect())
}

fn comparisons(analysis: &Analysis) -> Vec<Comparison> {
    let mut comparisons = Vec::new();
    for errors in &analysis.budget.sources {
        let name = &analysis.description.sources[errors.source].name;
        for (metric, kind) in Metric::ALL {
            let published = analysis.published_of(name, kind);
            comparisons.extend(published.map(|p| comparison(name, metric, of_source(errors, kind), p)));
        }
    }
    for (name, figure) in CombinedFigure::ALL {
        let ([x, y, z], norm) = analysis.combined(figure);
        let found = [x, y, z].map(Option::unwrap_or_default);
        let found = [found[0], found[1], found[2], norm];
        let published = analysis.published_combined(figure);
        comparisons.extend(published.map(|p| comparison("combined", name, found, p)));
    }
    comparisons
}

fn comparison(figure: &str, metric: &'static str, found: [f64; 4], published: &Published) -> Comparison {
    let [x, y, z, norm] = published.figures;
    Comparison {
        figure: figure.to_owned(),
        metric,
        x,
        y,
        z,
        norm,
        within: published.within,
        met: Agreement::of(found, published) == Agreement::Met,
        reference: published.reference.clone(),
    }
}
