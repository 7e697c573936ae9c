//! The uncertainty budget as the GUM states it, in tables and sentences.

use abbe::Distribution;
use abbe::analysis::{COVERAGE, Contribution, Measurand, Statement};

use super::report::Report;
use super::source_value::{Kind, SourceValue};
use super::stated::Stated;
use super::unit;
use crate::listing::Listing;
use crate::number;

/// Every random source, the largest share first.
pub fn contributions(report: &Report, stated: &Stated) -> Listing {
    let measurand = stated.statement.measurand;
    let row = |one: &Contribution| {
        let source = SourceValue::new(report, one);
        vec![
            report.source(one.source).name.clone(),
            value(report, source),
            one.distribution.name().to_owned(),
            divisor(one.distribution).to_owned(),
            sensitivity(report, measurand, source, one),
            unit::fixed(report, measurand, one.standard[3]),
            format!("{:.1} %", 100.0 * one.share),
        ]
    };
    Listing {
        header: vec!["source", "value", "distribution", "divisor", "sensitivity", "u", "share of u²"],
        rows: stated.statement.contributions.iter().map(row).collect(),
        numbers: 3..7,
    }
}

/// Bias, u, k and U along the rows and of the norm.
pub fn totals(report: &Report, stated: &Stated) -> Listing {
    let Statement { measurand, bias, standard, coverage_factors, .. } = &stated.statement;
    let expanded = stated.statement.expanded();
    let names = unit::rows(report, *measurand).into_iter().chain(["norm"]);
    let row = |(i, name): (usize, &str)| {
        let show = |value: f64| unit::fixed(report, *measurand, value);
        let sum = bias[i].abs() + expanded[i];
        vec![
            name.to_owned(),
            show(standard[i]),
            format!("{:.3}", coverage_factors[i]),
            show(expanded[i]),
            show(bias[i]),
            show(sum),
        ]
    };
    Listing {
        header: vec!["", "u", "k", "U = k u", "bias", "|bias| + U"],
        rows: names.enumerate().map(row).collect(),
        numbers: 1..6,
    }
}

/// What the budget covers.
pub fn sentences(report: &Report, stated: &Stated) -> Vec<String> {
    let Statement { measurand, coverage, coverage_factors, .. } = &stated.statement;
    let (_, combined, _) = report.budget.errors(*measurand);
    let show = |value| unit::shown(report, *measurand, value);
    let at = report
        .configuration(stated.configuration)
        .map(|worst| number::unbroken(&report.label(worst)))
        .unwrap_or_default();
    let holds = match coverage.draws {
        None => "U covers 95 % of the errors: all random sources are normal.".to_owned(),
        Some(draws) => format!(
            "U would cover 95 % of a normal error; drawn as the sources are distributed, {} % of {} errors have a norm within it.",
            number::trimmed(100.0 * coverage.probability, 1),
            number::short(draws as f64),
        ),
    };
    // Whatever the shape of a covariance, the quantile of its norm is no more than that of a line.
    let largest = LINE_95 * combined.standard_radius.value;
    let mut sentences = vec![
        format!(
            "After the GUM (JCGM 100), where u is largest ({at}): u = value × sensitivity / divisor, added as root sum of squares. k is that \
             of {} % of a normal error: {:.3} of the norm of a vector with this covariance. Degrees of freedom are taken as infinite.",
            number::short(100.0 * COVERAGE),
            coverage_factors[3],
        ),
        holds,
        format!(
            "At none of the {} configurations is the U of the norm more than {} (1.960 × {}).",
            report.budget.configurations,
            show(largest),
            show(combined.standard_radius.value)
        ),
    ];
    if combined.repeatable_radius.value > 0.0 {
        sentences.push(format!(
            "The budget covers the random sources. The repeatable ones are known errors: the GUM takes for granted that they are \
             corrected (3.2.4). As long as they are not they are a bias, of up to {} at these configurations, and stand beside U (6.3.1, note).",
            show(combined.repeatable_radius.value)
        ));
    }
    sentences
}

const LINE_95: f64 = 1.959_963_984_540_054;

fn value(report: &Report, SourceValue { value, kind }: SourceValue) -> String {
    match kind {
        Kind::Multiple => "1".to_owned(),
        Kind::Length => format!("{} {}", number::digits(value, 3), report.spec.length.symbol()),
        Kind::Angle => format!("{} mrad", number::digits(1e3 * value, 3)),
        Kind::Of(unit) => format!("{} {unit}", number::digits(value, 3)).trim_end().to_owned(),
    }
}

fn sensitivity(report: &Report, measurand: Measurand, source: SourceValue, one: &Contribution) -> String {
    let (factor, result) = unit::of(report, measurand);
    let (per, unit) = match source.kind {
        Kind::Multiple | Kind::Of("") => (1.0, None),
        Kind::Length => (1.0, Some(report.spec.length.symbol())),
        Kind::Angle => (1e-3, Some("mrad")),
        Kind::Of(unit) => (1.0, Some(unit)),
    };
    let number = number::digits(source.sensitivity(one)[3] * factor * per, 4);
    match unit {
        Some(unit) if unit == result => number,
        Some(unit) => format!("{number} {result}/{unit}"),
        None => format!("{number} {result}"),
    }
}

fn divisor(distribution: Distribution) -> &'static str {
    match distribution {
        Distribution::Uniform => "√3",
        Distribution::Normal => "1",
        Distribution::Triangular => "√6",
        Distribution::Arcsine => "√2",
    }
}
