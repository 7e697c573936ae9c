//! What figures cover: verdict and uncertainty, for machines.

use abbe::analysis::{COVERAGE, Compliance, Measurand, Statement};
use serde::Serialize;

use super::super::judged::{Judged, Verdict};
use super::super::report::Report;
use super::super::source_value::{Kind, SourceValue};
use super::super::stated::Stated;
use crate::number::Named;

/// The verdict on the study's tolerances.
#[derive(Serialize)]
pub(super) struct Judgement {
    verdict: Verdict,
    probability_asked: f64,
    #[serde(skip_serializing_if = "Option::is_none")]
    position: Option<One>,
    #[serde(skip_serializing_if = "Option::is_none")]
    orientation: Option<One>,
}

#[derive(Serialize)]
struct One {
    verdict: Verdict,
    tolerance: f64,
    #[serde(flatten)]
    compliance: Share,
    /// None if a random source is not bounded.
    largest: Option<f64>,
    at: Named,
    /// At how many configurations the probability was evaluated; this is the least.
    configurations: usize,
}

#[derive(Serialize)]
struct Share {
    probability: f64,
    error: f64,
    draws: Option<usize>,
}

impl From<Compliance> for Share {
    fn from(Compliance { probability, error, draws }: Compliance) -> Self {
        Self { probability, error, draws }
    }
}

pub(super) fn verdict(report: &Report) -> Option<Judgement> {
    let one = |measurand: Measurand| {
        let judged: &Judged = report.judged.iter().find(|judged| judged.measurand == measurand)?;
        Some(One {
            verdict: judged.verdict,
            tolerance: judged.tolerance,
            compliance: judged.compliance.into(),
            largest: judged.largest,
            at: report.variables(report.configuration(judged.configuration)),
            configurations: judged.configurations,
        })
    };
    Some(Judgement {
        verdict: report.verdict()?,
        probability_asked: report.study.probability,
        position: one(Measurand::Position),
        orientation: one(Measurand::Orientation),
    })
}

/// The budget of the GUM: three rows and the norm, lengths in the spec's unit, angles in rad.
#[derive(Serialize)]
pub(super) struct Uncertainty<'a> {
    at: Named,
    at_parameters: Named,
    sources: Vec<Contribution<'a>>,
    bias: [f64; 4],
    standard_uncertainty: [f64; 4],
    /// None where they are infinite.
    effective_degrees_of_freedom: [Option<f64>; 4],
    coverage_probability: f64,
    coverage_factor: [f64; 4],
    expanded_uncertainty: [f64; 4],
    /// The share of the errors within the expanded uncertainty of the norm.
    coverage: Share,
}

#[derive(Serialize)]
struct Contribution<'a> {
    source: &'a str,
    distribution: &'static str,
    /// None if it has several effects; then it is 1.
    value: Option<f64>,
    divisor: f64,
    sensitivity: [f64; 4],
    standard_uncertainty: [f64; 4],
    /// None if they are infinite.
    degrees_of_freedom: Option<f64>,
    share: f64,
}

pub(super) fn uncertainty<'a>(report: &'a Report, stated: &'a Stated) -> Uncertainty<'a> {
    let Statement { contributions, bias, standard, degrees_of_freedom, coverage_factors, coverage, .. } =
        &stated.statement;
    let configuration = report.configuration(stated.configuration);
    let sources = contributions.iter().map(|one| {
        let source = SourceValue::new(report, one);
        Contribution {
            source: &report.source(one.source).name,
            distribution: one.distribution.name(),
            value: (source.kind != Kind::Multiple).then_some(source.value),
            divisor: one.distribution.divisor(),
            sensitivity: source.sensitivity(one),
            standard_uncertainty: one.standard,
            degrees_of_freedom: finite(one.degrees_of_freedom),
            share: one.share,
        }
    });
    Uncertainty {
        at: report.variables(configuration),
        at_parameters: report.parameters(configuration),
        sources: sources.collect(),
        bias: bias.map(|value| value + 0.0),
        standard_uncertainty: *standard,
        effective_degrees_of_freedom: degrees_of_freedom.map(finite),
        coverage_probability: COVERAGE,
        coverage_factor: *coverage_factors,
        expanded_uncertainty: stated.statement.expanded(),
        coverage: (*coverage).into(),
    }
}

fn finite(degrees_of_freedom: f64) -> Option<f64> {
    degrees_of_freedom.is_finite().then_some(degrees_of_freedom)
}
