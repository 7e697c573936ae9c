//! The uncertainty budget as the GUM states it, in tables and sentences.

use abbe::Distribution;
use abbe::analysis::{COVERAGE, Measurand, student_95};

use crate::{document::Table, unit};
use abbe_study::analyze::{Quantity, Report, SourceUncertainty, UncertaintyBudget};
use abbe_study::number;

/// Returns the table of random sources, largest share first. Has a column of degrees of freedom if
/// any are finite.
pub(super) fn uncertainty_contributions(report: &Report, budget: &UncertaintyBudget) -> Table {
    let measurand = budget.measurand;
    let estimated = budget.is_estimated();
    let row = |one: &SourceUncertainty| {
        let mut row = vec![
            one.source.clone(),
            value(report, one),
            one.distribution.name().to_owned(),
            divisor(one.distribution).to_owned(),
            sensitivity(report, measurand, one),
            unit::fixed(report, measurand, one.standard_uncertainty[3]),
            format!("{:.1} %", 100.0 * one.share),
        ];
        if estimated {
            row.insert(6, degrees_of_freedom(one.degrees_of_freedom));
        }
        row
    };
    let mut header =
        vec!["source", "value", "distribution", ">divisor", ">sensitivity", ">u", ">share of u²"];
    if estimated {
        header.insert(6, ">ν");
    }
    let (_, unit) = unit::display_unit(report, measurand);
    let caption = format!("Standard uncertainty of each source ({unit})");
    Table::listing(caption, &header, budget.sources.iter().map(row).collect())
}

/// Returns the table of bias, u, k and U for each row and the norm. Has a column of effective
/// degrees of freedom if any are finite.
pub(super) fn uncertainty_totals(report: &Report, budget: &UncertaintyBudget) -> Table {
    let UncertaintyBudget { measurand, bias, expanded_uncertainty: expanded, .. } = budget;
    let estimated = budget.is_estimated();
    let names = unit::row_names(report, *measurand).into_iter().chain(["norm"]);
    let row = |(i, name): (usize, &str)| {
        let show = |value: f64| unit::fixed(report, *measurand, value);
        let sum = bias[i].abs() + expanded[i];
        let mut row = vec![
            name.to_owned(),
            show(budget.standard_uncertainty[i]),
            format!("{:.3}", budget.coverage_factor[i]),
            show(expanded[i]),
            show(bias[i]),
            show(sum),
        ];
        if estimated {
            row.insert(2, degrees_of_freedom(budget.effective_degrees_of_freedom[i]));
        }
        row
    };
    let mut header = vec!["", ">u", ">k", ">U = k u", ">bias", ">|bias| + U"];
    if estimated {
        header.insert(2, ">ν");
    }
    let (_, unit) = unit::display_unit(report, *measurand);
    let caption = format!("Expanded uncertainty and bias ({unit})");
    Table::listing(caption, &header, names.enumerate().map(row).collect())
}

/// Returns sentences on what the budget covers.
pub(super) fn uncertainty_sentences(report: &Report, budget: &UncertaintyBudget) -> Vec<String> {
    let UncertaintyBudget { measurand, coverage, .. } = budget;
    let (_, combined) = report.budget.errors(*measurand);
    let estimated = budget.is_estimated();
    let show = |value| unit::with_symbol(report, *measurand, value);
    let at = report.label_at(budget.configuration);
    let holds = match coverage.draws {
        None => "U covers 95 % of the errors: all random sources are normal.".to_owned(),
        Some(draws) => format!(
            "{} U covers {} % of {} drawn errors.",
            if estimated {
                "For the norm, with all sources drawn from their distributions, those with \
                 few degrees of freedom from Student's t (JCGM 101, 6.4.9),"
            } else {
                "U assumes a normal distribution; with the actual distributions"
            },
            number::trimmed(100.0 * coverage.probability, 1),
            number::short(draws as f64),
        ),
    };
    let percent = number::short(100.0 * COVERAGE);
    let factors = match estimated {
        false => {
            format!(
                "k is the coverage factor for {percent} % of a normal error, with infinite degrees of \
             freedom."
            )
        }
        true => format!(
            "k is the coverage factor for {percent} % of Student's t with ν effective degrees of \
             freedom, for each axis by the Welch-Satterthwaite formula (G.4.1); ν of the norm is \
             the harmonic mean over the sources, weighted by their shares."
        ),
    };
    let mut sentences = vec![format!("Configuration with the largest u: {at}."), holds];
    sentences.extend(workspace_bound(report, *measurand, combined.standard_radius.value));
    let biased = combined.repeatable_radius.value > 0.0;
    if biased {
        sentences.push(format!(
            "Repeatable errors that are not corrected are a bias of up to {} at these \
             configurations.",
            show(combined.repeatable_radius.value)
        ));
    }
    sentences.push(format!(
        "According to the GUM (JCGM 100): u = value × sensitivity / divisor, combined as root sum \
         of squares. {factors}"
    ));
    if biased {
        let corrected = "The budget covers the random sources. Repeatable errors are known: the GUM assumes that \
         they are corrected (3.2.4); until then they are stated beside U (6.3.1, note).";
        sentences.push(corrected.to_owned());
    }
    sentences
}

/// States an upper bound of the norm's U over the workspace; `None` below three degrees of freedom.
/// With at least three degrees of freedom the quantile of the norm does not exceed that of a scalar
/// error with the same variance, whatever the covariance. The effective degrees of freedom are no
/// fewer than the smallest of any source.
fn workspace_bound(report: &Report, measurand: Measurand, largest: f64) -> Option<String> {
    let fewest =
        report.spec.enabled_sources().map(|source| source.degrees_of_freedom).fold(f64::INFINITY, f64::min);
    let factor = (fewest >= 3.0).then(|| student_95(fewest))?;
    let show = |value| unit::with_symbol(report, measurand, value);
    Some(format!(
        "Over the {} configurations, U of the norm is at most {} ({factor:.3} × {}).",
        report.configurations_of(measurand),
        show(factor * largest),
        show(largest)
    ))
}

fn degrees_of_freedom(number: f64) -> String {
    if number.is_finite() { number::digits(number, 3) } else { "∞".to_owned() }
}

fn value(report: &Report, one: &SourceUncertainty) -> String {
    let value = one.value.unwrap_or(1.0);
    match &one.quantity {
        Quantity::Multiple => "1".to_owned(),
        Quantity::Length => format!("{} mm", number::digits(1e3 * report.spec.length.in_metres() * value, 3)),
        Quantity::Angle => format!("{} mrad", number::digits(1e3 * value, 3)),
        Quantity::Parameter(unit) => format!("{} {unit}", number::digits(value, 3)).trim_end().to_owned(),
    }
}

fn sensitivity(report: &Report, measurand: Measurand, one: &SourceUncertainty) -> String {
    let (factor, result) = unit::display_unit(report, measurand);
    let (per, unit) = match &one.quantity {
        Quantity::Multiple => (1.0, None),
        Quantity::Length => (1e-3 / report.spec.length.in_metres(), Some("mm")),
        Quantity::Angle => (1e-3, Some("mrad")),
        Quantity::Parameter(unit) => (1.0, Some(unit.as_str()).filter(|unit| !unit.is_empty())),
    };
    let number = number::digits(one.sensitivity[3] * factor * per, 4);
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
        Distribution::Ball { parts: 2, .. } => "2",
        Distribution::Ball { .. } => "√5",
    }
}
