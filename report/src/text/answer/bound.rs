//! The answer of a bound: whether the tolerance is kept, and what no error exceeds.

use abbe_study::bound::{ErrorBound, ErrorBounds, Margin, Report};
use abbe_study::number;

use super::full::bound::{after_one_step, first_order_remainder};
use super::{Answer, aligned, error_unit};

pub(in crate::text) fn bound(report: &Report) -> String {
    let kinds = report.kinds();
    let mut answer = Answer::new(&headline(report));
    if kinds.is_empty() {
        answer.block("No error source is enabled: there is no error to bound.");
        return answer.0;
    }
    let named = [("repeatable", &report.repeatable), ("random", &report.random), ("total", &report.radius)];
    let is_there = |errors: &ErrorBounds| kinds.iter().any(|(_, there)| std::ptr::eq(*there, errors));
    let rows: Vec<_> = std::iter::once(["", "found", "no more than", ""].map(str::to_owned))
        .chain(
            named
                .into_iter()
                .filter(|(_, errors)| is_there(errors))
                .flat_map(|(name, errors)| rows(report, name, errors)),
        )
        .collect();
    answer.block(&aligned(&rows, [false, true, true, false]));
    answer.facts(facts(report));
    answer.0
}

fn facts(report: &Report) -> Vec<(&'static str, String)> {
    let place = if report.radius.norm.label.is_empty() { "home" } else { &report.radius.norm.label };
    let mut facts = vec![("Worst", super::place(place)), ("Box", domain(report))];
    let sentences = [("Exact", first_order_remainder(report)), ("Step", after_one_step(report))];
    facts.extend(sentences.into_iter().filter_map(|(name, sentence)| Some((name, sentence?))));
    let lower = |value: f64| number::rounded_down(value, number::decimals(value, 3));
    if let Some(dexterity) = &report.dexterity {
        let least = lower(dexterity.point.certified);
        facts.push(("Dexterity", format!("least singular value of J_q, rows 1–3: at least {least}")));
    }
    if let Some(stiffness) = &report.stiffness {
        // 1 N/m is a thousandth of 1 N/mm.
        facts.push((
            "Stiffness",
            format!("at the tool point at least {} N/mm", lower(1e-3 * stiffness.certified)),
        ));
    }
    facts
}

fn headline(report: &Report) -> String {
    let title = &report.spec.title;
    let (factor, unit) = error_unit(report.length);
    let verdicts = [
        (report.margin, &report.radius.norm, unit, factor),
        (report.orientation_margin, &report.radius.orientation, "mrad", 1e3),
    ];
    let verdicts: Vec<String> = verdicts
        .into_iter()
        .filter_map(|(margin, largest, unit, factor)| Some(verdict(report, &margin?, largest, unit, factor)))
        .collect();
    match verdicts.as_slice() {
        [] => format!("{title}: largest errors, found and certified"),
        verdicts => format!("{title}: {}", verdicts.join("; ")),
    }
}

fn verdict(report: &Report, margin: &Margin, largest: &ErrorBound, unit: &str, factor: f64) -> String {
    let tolerance = format!("tolerance {} {unit}", number::digits(factor * margin.tolerance, 3));
    match margin.certified {
        Some(left) if left >= 0.0 => format!("{tolerance} MET everywhere in the box, to first order"),
        _ if margin.found < 0.0 && report.contains_more => {
            format!("{tolerance} UNDECIDED: it is exceeded in the joint box, which is larger than the study")
        }
        _ if margin.found < 0.0 => {
            format!("{tolerance} EXCEEDED: {} {unit} found", number::digits(factor * largest.found, 3))
        }
        _ => format!("{tolerance} UNDECIDED: no larger error was found, but none can be excluded"),
    }
}

/// The norm of the position and of the orientation errors of one kind.
fn rows(report: &Report, name: &str, errors: &ErrorBounds) -> Vec<[String; 4]> {
    let row = |what: &str, largest: &ErrorBound, unit: &str, factor: f64| {
        let decimals = number::decimals(factor * largest.found, 4);
        let certified = largest.certified.map(|most| number::rounded_up(factor * most, decimals));
        let found = number::rounded_down(factor * largest.found, decimals);
        let certified = certified.filter(|_| largest.is_close());
        let certified = certified.unwrap_or_else(|| "not bounded closely".to_owned());
        [format!("{name}{what}"), found, certified, unit.to_owned()]
    };
    let (factor, unit) = error_unit(report.length);
    let mut rows = vec![row("", &errors.norm, unit, factor)];
    if errors.orientation.certified != Some(0.0) {
        rows.push(row(", orientation", &errors.orientation, "mrad", 1e3));
    }
    rows
}

fn domain(report: &Report) -> String {
    let names: Vec<&String> = report.spans.keys().collect();
    let joints = match names.as_slice() {
        [] => "nothing moves".to_owned(),
        names if report.contains_more => {
            format!("{} over their ranges in the study", super::first(names, 8))
        }
        names => format!("{} over their ranges", super::first(names, 8)),
    };
    let complete = match report.complete {
        true => String::new(),
        false => format!("; the gap of {} was not reached everywhere", number::percent(report.gap, 1.0)),
    };
    format!("{joints}; {} boxes examined{complete}", report.boxes)
}
