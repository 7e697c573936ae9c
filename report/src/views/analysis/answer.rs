//! The first screen: figures, largest sources and worst configuration.

use abbe::analysis::Measurand;
use abbe_study::analyze::{
    Agreement, CompensationBasis, MachineVerdicts, NOT_CERTIFIED, Report, ToleranceVerdict, Verdict,
    unreachable_summary,
};
use abbe_study::bound::ErrorBound;
use abbe_study::number::{self as numbers, error_unit, fixed, percent, steady};
use abbe_study::study_file::JudgedMachine;

use super::agreement::agreement_text;
use super::conclusions::{exact, loop_condition, singular_sentence};
use super::verdict::stated_probability;
use crate::document::{Section, Table, first, number, words};
use crate::unit;
use crate::views::shared::{changed, place};

/// Number of sources shown one by one.
const SHOWN: usize = 5;

/// Describes the first screen.
pub(super) fn answer(report: &Report) -> Section {
    Section::answer().table(figures(report)).table(sources(report)).facts(facts(report))
}

pub(super) fn headline(report: &Report) -> String {
    let at = numbers::counted(report.configurations, "configuration", "configurations");
    let Some(verdicts) = &report.verdicts else {
        return format!("no tolerance stated; {at}");
    };
    let tolerances = [Measurand::Position, Measurand::Orientation]
        .into_iter()
        .filter_map(|measurand| Some(unit::with_symbol(report, measurand, report.tolerance(measurand)?)));
    let tolerances = tolerances.collect::<Vec<_>>().join(" and ");
    let machine = match (verdicts.machine, &verdicts.compensated) {
        (JudgedMachine::Compensated, _) => " after compensation",
        (JudgedMachine::AsBuilt, Some(_)) => " as built",
        _ => "",
    };
    let other = match verdicts.machine {
        JudgedMachine::Compensated if verdicts.as_built.all().any(|one| one.verdict == Verdict::NotMet) => {
            "; as built NOT MET"
        }
        _ => "",
    };
    if let Some(unreachable) = verdicts.unreachable {
        let all = report.configurations + report.unreachable;
        return format!(
            "NOT MET: {unreachable} of {all} configurations cannot be reached, tolerance {tolerances}"
        );
    }
    let least = verdicts.all().min_by(|a, b| a.compliance.probability.total_cmp(&b.compliance.probability));
    let (verdict, probability) = match (verdicts.verdict, least) {
        (Verdict::MetWithProbability, Some(least)) => {
            let required = numbers::at_least(verdicts.probability_required);
            ("MET", format!(": P {}, {required} required", stated_probability(least)))
        }
        (Verdict::NotMet, _) => ("NOT MET", String::new()),
        _ => ("MET", String::new()),
    };
    format!("{verdict}{machine}{probability}, tolerance {tolerances} at {at}{other}")
}

/// Decimals that show the largest error to four digits.
fn decimals(report: &Report) -> usize {
    numbers::decimals(error_unit(report.length).0 * steady(report.combined.radii.radius), 4)
}

/// The error as built, after compensation, and of the random sources alone.
fn figures(report: &Report) -> Table {
    let (factor, unit) = error_unit(report.length);
    let decimals = decimals(report);
    let certified = |largest: Option<&ErrorBound>| match largest.map(|largest| (largest.certified, largest)) {
        None | Some((None, _)) => String::new(),
        Some((Some(most), largest)) if largest.is_close() => {
            format!("worst case at most {}", numbers::rounded_up(factor * most, decimals))
        }
        Some(_) => "not bounded closely".to_owned(),
    };
    let norms = report.certified.as_ref();
    let position = |name: &str, value: f64, [probability, u95]: [String; 2], note: String| {
        let value = steady(value);
        let share = report.position_tolerance.map(|tolerance| percent(value, tolerance));
        let value = format!("{} {unit}", fixed(factor * value, decimals));
        [name.to_owned(), value, share.unwrap_or_default(), probability, u95, note]
    };
    let judged = |verdict: Option<&ToleranceVerdict>, factor: f64, unit: &str| {
        verdict.map_or([const { String::new() }; 2], |verdict| {
            let u95 = numbers::digits(factor * verdict.u95, 3);
            [format!("P(within) {}", stated_probability(verdict)), format!("U95 {u95} {unit}")]
        })
    };
    let as_built = report.verdicts.as_ref().map(|verdicts| &verdicts.as_built);
    let compensated = report.verdicts.as_ref().and_then(|verdicts| verdicts.compensated.as_ref());
    let compensated = compensated.map(|compensated| &compensated.verdicts);
    let position_of = |verdicts: Option<&MachineVerdicts>| {
        judged(verdicts.and_then(|verdicts| verdicts.position.as_ref()), factor, unit)
    };
    let radii = &report.combined.radii;
    let most = norms.and_then(|norms| norms.all_sources());
    let mut rows = vec![position("as built", radii.radius, position_of(as_built), certified(most))];
    if let Some(verdict) = compensated.and_then(|verdicts| verdicts.position.as_ref()) {
        let probability = position_of(compensated);
        rows.push(position("compensated", verdict.radius, probability, basis(report)));
    } else if let Some(left) = &report.compensation {
        rows.push(position("compensated", left.total, Default::default(), String::new()));
    } else if let Some(left) = &report.after_compensation {
        let note = format!("residual {} of {}", numbers::short(factor * left.residual), report.publisher());
        rows.push(position("compensated", left.total, Default::default(), note));
    }
    let is_mixed = radii.random_radius > 0.0 && radii.repeatable_radius > 0.0;
    if is_mixed {
        let most = norms.and_then(|norms| norms.random.as_ref());
        rows.push(position("random only", radii.random_radius, Default::default(), certified(most)));
    }
    if report.orientation.radii.radius > 0.0 {
        let value = steady(report.orientation.radii.radius);
        let share = report.orientation.tolerance.map(|tolerance| percent(value, tolerance));
        let value = format!("{} mrad", numbers::digits(1e3 * value, 4));
        let of = |verdicts: Option<&MachineVerdicts>| {
            judged(verdicts.and_then(|verdicts| verdicts.orientation.as_ref()), 1e3, "mrad")
        };
        let [probability, u95] = of(as_built);
        let share = share.unwrap_or_default();
        rows.push(["orientation".to_owned(), value, share, probability, u95, String::new()]);
        if let Some(verdict) = compensated.and_then(|verdicts| verdicts.orientation.as_ref()) {
            let value = format!("{} mrad", numbers::digits(1e3 * verdict.radius, 4));
            let share = percent(verdict.radius, verdict.tolerance);
            let [probability, u95] = of(compensated);
            rows.push(["  compensated".to_owned(), value, share, probability, u95, String::new()]);
        }
    }
    let columns = [words(""), number(""), number(""), words(""), words(""), words("")];
    Table::new("", columns).rows(rows)
}

/// Names the basis of the compensated figures.
fn basis(report: &Report) -> String {
    let verdicts = report.verdicts.as_ref().and_then(|verdicts| verdicts.compensated.as_ref());
    match verdicts.map(|verdicts| verdicts.basis) {
        Some(CompensationBasis::Identified) => "covariance of the spec".to_owned(),
        Some(CompensationBasis::Published) => "published residual".to_owned(),
        _ => String::new(),
    }
}

/// Lists the largest sources with their shares of the sum of all norms, and the factor at which
/// each alone would use up the tolerance; the last row has the factor for all of them together.
fn sources(report: &Report) -> Table {
    let decimals = decimals(report);
    let all: Vec<(&str, f64)> =
        report.ledger.sources.iter().map(|entry| (entry.name.as_str(), steady(entry.max))).collect();
    let (scale, unit) = error_unit(report.length);
    let sum: f64 = all.iter().map(|(_, max)| max).sum();
    let factor = |name: &str| {
        let sources = &report.allowance.as_ref()?.sources;
        let alone = sources.iter().find(|source| source.name == name)?.alone?;
        Some(times(alone))
    };
    let row = |name: String, max: f64, factor: Option<String>| {
        [name, fixed(scale * max, decimals), percent(max, sum), factor.unwrap_or_default()]
    };
    let shown = if all.len() <= SHOWN + 1 { all.len() } else { SHOWN };
    let tighten = if report.allowance.is_some() { "alone up to" } else { "" };
    let columns = [words("source"), number(format!("max {unit}")), number("share"), number(tighten)];
    let mut rows = Vec::new();
    rows.extend(all[..shown].iter().map(|(name, max)| row((*name).to_owned(), *max, factor(name))));
    if shown < all.len() {
        let rest = all[shown..].iter().map(|(_, max)| max).sum();
        rows.push(row(format!("{} others together", all.len() - shown), rest, None));
    }
    // The factor of a source holds for it alone.
    if let Some(together) = report.allowance.as_ref().and_then(|allowance| allowance.together)
        && all.len() > 1
    {
        let radius = fixed(scale * steady(report.combined.radii.radius), decimals);
        rows.push(["all, as built".to_owned(), radius, String::new(), times(together)]);
    }
    Table::new("", columns).rows(rows)
}

/// Formats a factor, rounded down.
fn times(factor: f64) -> String {
    let factor = steady(factor);
    format!("× {}", numbers::rounded_down(factor, numbers::decimals(factor, 2)))
}

fn facts(report: &Report) -> Vec<(&'static str, String)> {
    let mut facts = vec![("Study", report.title.clone())];
    facts.extend(changed(&report.changes));
    if let Some(worst) = report.configuration(report.budget.combined.radius.configuration) {
        facts.push(("Worst", place(&report.label(worst))));
    }
    let compensated = report.verdicts.as_ref().and_then(|verdicts| verdicts.compensated.as_ref());
    let worst = compensated.and_then(|compensated| compensated.verdicts.all().next());
    if let Some(worst) = worst.and_then(|verdict| report.configuration(verdict.configuration)) {
        facts.push(("", format!("compensated {}", place(&report.label(worst)))));
    }
    if compensated.is_some_and(|compensated| compensated.basis != CompensationBasis::Published) {
        facts.push(("Left out", "after compensation: errors that the spec does not have".to_owned()));
    }
    if !report.spec.is_serial() {
        facts.push(("Certified", format!("nothing: {NOT_CERTIFIED}")));
    }
    if report.certified.as_ref().is_some_and(|certified| certified.random.is_some()) {
        let normal = report.spec.enabled_sources().any(|source| !source.class.is_bounded());
        let normal = if normal { ", normal errors at 3 σ" } else { "" };
        facts.push((
            "Certified",
            format!(
                "worst case over all signs and the joint box{normal}; other figures: root sum of squares"
            ),
        ));
    }
    let (factor, unit) = error_unit(report.length);
    let published = &report.comparisons;
    let missed: Vec<String> = published
        .iter()
        .filter(|one| one.agreement != Agreement::Met)
        .map(|one| format!("{} ({}) {}", one.figure, one.metric, agreement_text(one.agreement, report)))
        .collect();
    if !published.is_empty() {
        let met = published.len() - missed.len();
        let missed = if missed.is_empty() { String::new() } else { format!("; {}", first(&missed, 2)) };
        let publisher = report.publisher();
        facts.push((
            "Published",
            format!("{met} of {} figures of {publisher} reproduced{missed}", published.len()),
        ));
    }
    let unreachable = &report.budget.unreachable;
    if unreachable.count > 0 {
        let reasons = unreachable_summary(unreachable, &report.spec);
        facts.push(("Reach", format!("{} configurations unreachable: {reasons}", unreachable.count)));
    }
    let nearly_singular = report.loops.as_ref().filter(|loops| loops.is_nearly_singular());
    facts.extend(nearly_singular.map(|loops| ("Loops", loop_condition(loops))));
    if report.singular() > 0 {
        facts.push(("Euler", singular_sentence(report)));
    }
    let largest = factor * report.first_order.largest;
    facts.push((
        "Exact",
        format!(
            "figures to first order; {} differs by up to {} {unit} at {}",
            exact(report),
            numbers::rounded_up(largest, numbers::decimals(largest, 2)),
            numbers::counted(report.first_order.checked, "configuration", "configurations")
        ),
    ));
    facts
}
