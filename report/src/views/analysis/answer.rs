//! The first screen: figures, largest sources and worst configuration.

use abbe::analysis::Measurand;
use abbe_study::analyze::{
    Agreement, CompensationBasis, LedgerEntry, MachineVerdicts, NOT_CERTIFIED, Report, ToleranceVerdict,
    Verdict, unreachable_summary,
};
use abbe_study::bound::ErrorBound;
use abbe_study::number::{self as numbers, error_unit, fixed, percent, steady};
use abbe_study::study_file::{Criterion, JudgedMachine};

use super::conclusions::{exact, loop_condition, nearest_dead_point, singular_sentence};
use super::tables::agreement_text;
use super::verdict::{by_criterion, stated_probability};
use crate::document::{Section, Table, first};
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
    let checked = match (verdicts.machine, &verdicts.compensated, verdicts.counting().yielded) {
        (JudgedMachine::Compensated, Some(compensated), _) => compensated.checked,
        (.., Some(yielded)) => yielded.configurations,
        _ => report.configurations,
    };
    let at = if checked < report.configurations { format!("{checked} of {at}") } else { at };
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
    let met = if verdicts.verdict == Verdict::Met { "MET" } else { "NOT MET" };
    let by = match (verdicts.counting().yielded, verdicts.probability_required, least) {
        (Some(share), ..) => {
            let [from, to] = share.interval.map(|end| numbers::rounded_down(100.0 * end, 1));
            let required = numbers::at_least(verdicts.yield_required.unwrap_or_default());
            format!(": yield {from} … {to} % of machines, {required} required")
        }
        (_, Some(required), Some(least)) => {
            format!(": P {}, {} required", stated_probability(least), numbers::at_least(required))
        }
        _ => format!(" {}", by_criterion(verdicts.criterion, &report.spec)),
    };
    format!("{met}{machine}{by}, tolerance {tolerances} at {at}{other}")
}

/// Decimals that show the largest error to four digits.
fn decimals(report: &Report) -> usize {
    numbers::decimals(error_unit(report.length).0 * steady(report.judged_error(Measurand::Position).value), 4)
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
    let built = report.judged_error(Measurand::Position).value;
    let mut rows = vec![position("as built", built, position_of(as_built), certified(most))];
    let criterion = report.study.criterion;
    let is_rss = criterion == Criterion::RootSumOfSquares;
    if let Some(verdict) = compensated.and_then(|verdicts| verdicts.position.as_ref()) {
        let probability = position_of(compensated);
        rows.push(position("compensated", verdict.judged_error(criterion), probability, basis(report)));
    } else if let Some(left) = &report.compensation {
        rows.push(position("compensated", left.total, Default::default(), String::new()));
    } else if let Some(left) = &report.after_compensation {
        let note = format!("residual {} of {}", numbers::short(factor * left.residual), report.publisher());
        rows.push(position("compensated", left.total, Default::default(), note));
    }
    let is_mixed = radii.random_radius > 0.0 && radii.repeatable_radius > 0.0;
    if is_mixed {
        let most = norms.and_then(|norms| norms.random.as_ref());
        let name = if is_rss { "random only" } else { "random, rss" };
        rows.push(position(name, radii.random_radius, Default::default(), certified(most)));
    }
    if report.orientation.radii.radius > 0.0 {
        let value = steady(report.judged_error(Measurand::Orientation).value);
        let share = report.orientation.tolerance.map(|tolerance| percent(value, tolerance));
        let value = format!("{} mrad", numbers::digits(1e3 * value, 4));
        let of = |verdicts: Option<&MachineVerdicts>| {
            judged(verdicts.and_then(|verdicts| verdicts.orientation.as_ref()), 1e3, "mrad")
        };
        let [probability, u95] = of(as_built);
        let share = share.unwrap_or_default();
        rows.push(["orientation".to_owned(), value, share, probability, u95, String::new()]);
        if let Some(verdict) = compensated.and_then(|verdicts| verdicts.orientation.as_ref()) {
            let left = verdict.judged_error(criterion);
            let value = format!("{} mrad", numbers::digits(1e3 * left, 4));
            let share = percent(left, verdict.tolerance);
            let [probability, u95] = of(compensated);
            rows.push(["  compensated".to_owned(), value, share, probability, u95, String::new()]);
        }
    }
    Table::new("", ["", ">", ">", "", "", ""]).rows(rows)
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

/// Lists the sources with the largest shares of the judged error, with the factors as built that
/// keep the tolerance together, or at which each alone would use it up; the last row has one for
/// all.
fn sources(report: &Report) -> Table {
    let decimals = decimals(report);
    let mut all: Vec<&LedgerEntry> = report.ledger.sources.iter().collect();
    let share = |entry: &LedgerEntry| steady(entry.share.unwrap_or_default());
    all.sort_by(|a, b| share(b).abs().total_cmp(&share(a).abs()));
    let (scale, unit) = error_unit(report.length);
    // The factors are those of the machine as built.
    let machine = report.verdicts.as_ref().map(|verdicts| verdicts.machine);
    let is_built = machine == Some(JudgedMachine::AsBuilt) && report.position_tolerance.is_some();
    // Factors that keep the tolerance together, or those of each source alone.
    let is_allocated = is_built && all.iter().any(|entry| entry.factor.is_some());
    let factor = |entry: &LedgerEntry| {
        let alone = entry.share_of_tolerance.filter(|share| *share > 0.0).map(|share| 1.0 / share);
        let factor = if is_allocated { entry.factor } else { alone };
        factor.filter(|_| is_built).map_or_else(String::new, times)
    };
    let row = |entry: &LedgerEntry| {
        let max = fixed(scale * steady(entry.max), decimals);
        [entry.name.clone(), max, percent(share(entry), 1.0), factor(entry)]
    };
    let shown = if all.len() <= SHOWN + 1 { all.len() } else { SHOWN };
    let alone = match is_built {
        true if is_allocated => ">allocated",
        true => ">alone up to",
        false => ">",
    };
    let columns = ["source", &format!(">max {unit}"), ">share", alone];
    let mut rows: Vec<[String; 4]> = all[..shown].iter().map(|entry| row(entry)).collect();
    if shown < all.len() {
        let rest = all[shown..].iter().map(|entry| share(entry)).sum();
        let name = format!("{} others together", all.len() - shown);
        rows.push([name, String::new(), percent(rest, 1.0), String::new()]);
    }
    // The factor of a source holds for it alone.
    if let Some(together) = report.factor_for_all.filter(|_| is_built)
        && all.len() > 1
    {
        let error = report.judged_error(Measurand::Position).value;
        let error = fixed(scale * steady(error), decimals);
        rows.push(["all, as built".to_owned(), error, String::new(), times(together)]);
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
    let worst = report.configuration(report.judged_error(Measurand::Position).configuration);
    facts.extend(worst.map(|worst| ("Worst", place(&report.label(worst)))));
    let compensated = report.verdicts.as_ref().and_then(|verdicts| verdicts.compensated.as_ref());
    let worst = compensated.and_then(|compensated| compensated.verdicts.all().next());
    let worst = worst.and_then(|verdict| report.configuration(verdict.configuration));
    facts.extend(worst.map(|worst| ("", format!("compensated {}", place(&report.label(worst))))));
    if compensated.is_some_and(|compensated| compensated.basis != CompensationBasis::Published) {
        facts.push(("Left out", "after compensation: errors that the spec does not have".to_owned()));
    }
    if !report.spec.is_serial() {
        facts.push(("Certified", format!("nothing: {NOT_CERTIFIED}")));
    }
    if report.certified.as_ref().is_some_and(|certified| certified.random.is_some()) {
        let normal = report.spec.enabled_sources().any(|source| !source.class.is_bounded());
        let normal = if normal { ", normal errors at 3 σ" } else { "" };
        let others = match report.study.criterion {
            Criterion::RootSumOfSquares => "; other figures: root sum of squares",
            _ => "",
        };
        facts.push(("Certified", format!("worst case over all signs and the joint box{normal}{others}")));
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
    let named = if nearly_singular.is_some() { "" } else { "Loops" };
    facts.extend(report.loops.as_ref().map(|loops| (named, nearest_dead_point(loops, &report.spec))));
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
