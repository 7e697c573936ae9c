//! Bound: whether the tolerance is kept, and what no error exceeds.

use abbe_study::bound::{Dexterity, ErrorBound, ErrorBounds, LowerBound, Margin, Report};
use abbe_study::number::{self, error_unit, of_symbol, unbroken};

use super::shared::{changed, place};
use crate::document::{Document, Section, Table, first, joined};

/// Describes certified bounds of errors.
pub fn bound(report: &Report) -> Document {
    let kinds = report.kinds();
    let none = kinds.is_empty().then(|| "No error source is enabled: there is no error to bound.".to_owned());
    let facts = if kinds.is_empty() { changed(&report.changes) } else { facts(report) };
    let mut sections = vec![
        Section::answer().state("no_source", none).table(largest(report)).facts(facts),
        Section::full("Domain").state("box", within(report)),
        dexterity(report),
        stiffness(report),
    ];
    if !kinds.is_empty() {
        sections.push(errors(report, &kinds));
    }
    Document {
        kind: "Bounds of errors",
        machine: report.spec.title.clone(),
        title: report.study.title.clone(),
        headline: headline(report),
        sections,
        ..Document::default()
    }
}

/// Tabulates the norm of the position and of the orientation errors of each kind.
fn largest(report: &Report) -> Table {
    let kinds = report.kinds();
    let named = [("repeatable", &report.repeatable), ("random", &report.random), ("total", &report.total)];
    let is_there = |errors: &ErrorBounds| kinds.iter().any(|(_, there)| std::ptr::eq(*there, errors));
    let named = named.into_iter().filter(|(_, errors)| is_there(errors));
    let columns = ["", ">found", ">no more than", ""];
    Table::new("", columns).rows(named.flat_map(|(name, errors)| rows(report, name, errors)))
}

fn facts(report: &Report) -> Vec<(&'static str, String)> {
    let worst = if report.total.norm.label.is_empty() { "home" } else { &report.total.norm.label };
    let mut facts = vec![("Study", report.study.title.clone())];
    facts.extend(changed(&report.changes));
    facts.extend([("Worst", place(worst)), ("Box", domain(report))]);
    if report.kinds().iter().any(|(_, errors)| std::ptr::eq(*errors, &report.random)) {
        facts.push(("Covers", any_values(report).to_owned()));
    }
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
    let (factor, unit) = error_unit(report.length);
    let verdicts = [
        (report.margin, &report.total.norm, unit, factor),
        (report.orientation_margin, &report.total.orientation, "mrad", 1e3),
    ];
    let verdicts: Vec<String> = verdicts
        .into_iter()
        .filter_map(|(margin, largest, unit, factor)| Some(verdict(report, &margin?, largest, unit, factor)))
        .collect();
    match verdicts.as_slice() {
        [] => "largest errors, found and certified".to_owned(),
        verdicts => verdicts.join("; "),
    }
}

fn verdict(report: &Report, margin: &Margin, largest: &ErrorBound, unit: &str, factor: f64) -> String {
    let tolerance = format!("tolerance {} {unit}", number::digits(factor * margin.tolerance, 3));
    // A normal error has no bound.
    let at = if is_bounded(report) { "" } else { " at 3 σ" };
    match margin.certified {
        Some(left) if left >= 0.0 => format!("{tolerance} MET everywhere in the box{at}, to first order"),
        _ if margin.in_study.is_some_and(|left| left < 0.0) && report.contains_more => {
            let error = margin.tolerance - margin.in_study.unwrap_or_default();
            format!("{tolerance} EXCEEDED: {} {unit} in the study", number::digits(factor * error, 3))
        }
        _ if margin.found < 0.0 && report.contains_more => {
            format!("{tolerance} UNDECIDED: it is exceeded in the joint box, which is larger than the study")
        }
        _ if margin.found < 0.0 => {
            format!("{tolerance} EXCEEDED: {} {unit} found", number::digits(factor * largest.found, 3))
        }
        _ => format!("{tolerance} UNDECIDED: no larger error was found, but none can be excluded"),
    }
}

/// Says which values of random sources a worst case covers.
fn any_values(report: &Report) -> &'static str {
    match is_bounded(report) {
        true => "random errors of any sign at their bounds",
        false => "random errors of any sign at their bounds, normal ones at 3 σ",
    }
}

/// Returns whether all errors are bounded.
fn is_bounded(report: &Report) -> bool {
    report.spec.enabled_sources().all(|source| source.class.is_bounded())
}

/// Formats the norms of the position and of the orientation errors of one kind.
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
            format!("{} over their ranges in the study", first(names, 8))
        }
        names => format!("{} over their ranges", first(names, 8)),
    };
    let complete = match report.complete {
        true => String::new(),
        false => format!("; the gap of {} was not reached everywhere", number::percent(report.gap, 1.0)),
    };
    format!("{joints}; {} boxes examined{complete}", report.boxes)
}

/// Lists the ranges of all that moves.
fn within(report: &Report) -> String {
    let spans = report.moving_spans.iter().map(|span| {
        let [from, to] = span.range.map(|value| of_symbol(value, span.symbol, &report.spec));
        unbroken(&format!("{} from {from} to {to}", report.spec.name_of(span.symbol)))
    });
    let spans = joined(spans);
    format!("Box: {}.", if spans.is_empty() { "nothing moves" } else { &spans })
}

fn errors(report: &Report, kinds: &[(&str, &ErrorBounds)]) -> Section {
    let tables = kinds.iter().map(|(title, errors)| table(report, title, errors));
    let section = tables.fold(Section::full("Bounds"), Section::table);
    let unknown =
        kinds.iter().any(|(_, errors)| errors.all().iter().any(|largest| largest.certified.is_none()));
    let unknown = if unknown {
        " Where no bound is given, none could be proved: an expression may divide by zero in the box."
    } else {
        ""
    };
    let normal = if is_bounded(report) { "" } else { ", with normal errors within 3 σ" };
    let meaning = format!(
        "The true maximum of each error lies between both numbers: the first was found at this \
         configuration, and no error in the box exceeds the second{normal}.{unknown} All to first order, \
         ΔX = J_e ε. {} boxes were examined.",
        report.boxes
    );
    let margins = [
        ("margin", report.margin, report.length, 1.0),
        ("margin_of_orientation", report.orientation_margin, "mrad", 1e3),
    ];
    let margins = margins
        .into_iter()
        .filter_map(|(name, margin, unit, factor)| Some((name, of_margin(&margin?, (unit, factor))?)));
    margins.fold(section.state("bounds", meaning), |section, (name, margin)| section.state(name, margin))
}

fn dexterity(report: &Report) -> Section {
    let section = Section::full("Dexterity");
    let Some(Dexterity { point, pose, .. }) = &report.dexterity else { return section };
    let pose = pose.as_ref().map(|pose| ("tool, 1 rad as 1 m", pose, 1.0));
    let rows: Vec<_> = std::iter::once(("tool point", point, 1.0)).chain(pose).collect();
    section.table(least(&rows)).state("dexterity", DEXTERITY.to_owned())
}

fn stiffness(report: &Report) -> Section {
    let section = Section::full("Stiffness");
    let Some(stiffness) = &report.stiffness else { return section };
    // 1 N/m is a thousandth of 1 N/mm.
    section.table(least(&[("tool point, N/mm", stiffness, 1e-3)])).state("stiffness", STIFFNESS.to_owned())
}

/// Definition of the dexterity.
const DEXTERITY: &str = "Least singular value of J_q in metres and radians: the smallest motion of the tool, over all \
 directions, for a joint motion of 1 rad or 1 m (root sum of squares). It is 0 at a singular \
 configuration. No value in the box is below the first number; the second was found at this \
 configuration.";

/// Definition of the stiffness.
const STIFFNESS: &str = "Inverse of the largest singular value of the compliance at the tool point: force over deflection \
 in the softest direction, from the beams and compliances of the repeatable sources. No value in \
 the box is below the first number; the second was found at this configuration. Everything else \
 counts as rigid.";

/// Tabulates least values, each with its name and its factor.
fn least(rows: &[(&str, &LowerBound, f64)]) -> Table {
    let columns = ["of", ">never below", ">found", "found at"];
    Table::new("", columns).rows(rows.iter().map(|(name, least, factor)| {
        let found = least.found.map(|found| factor * found);
        let decimals = number::decimals(found.unwrap_or(factor * least.certified).max(1e-3), 5);
        let place = match least.found {
            None => "nowhere",
            Some(_) if least.label.is_empty() => "home",
            Some(_) => &least.label,
        };
        let certified = number::rounded_down(factor * least.certified, decimals);
        let mark = if least.complete { "" } else { " (gap not reached)" };
        let found = found.map_or("not known".to_owned(), |found| number::rounded_up(found, decimals));
        [(*name).to_owned(), certified, found, unbroken(place) + mark]
    }))
}

/// States the bound of the first-order remainder; none without repeatable sources.
fn first_order_remainder(report: &Report) -> Option<String> {
    let is_chain = report.spec.is_serial();
    let Some(certified) = report.remainder.as_ref()?.certified else {
        let exact = if is_chain { "chain" } else { "machine" };
        return Some(format!(
            "The difference between the exact {exact} and first order could not be bounded."
        ));
    };
    // Two digits: it is no closer than that.
    let decimals = number::decimals(certified, 2);
    let exact = if is_chain { "chain A_1 E_1 … A_n E_n T" } else { "machine" };
    Some(format!(
        "Within the box, the tool point of the exact {exact} differs from first order by no more than {} {} \
         (repeatable sources).",
        number::rounded_up(certified, decimals),
        report.length
    ))
}

/// States the bound of the error after one step of compensation; none without repeatable sources.
fn after_one_step(report: &Report) -> Option<String> {
    let left = report.after_one_step.as_ref()?;
    let is_known = left.orientation.is_some() || !left.corrects_orientation;
    let Some(position) = left.position.filter(|_| is_known) else {
        let why = match &left.near_singularity {
            Some(place) => format!(
                ": near {} compensation can increase the error, because of a singularity or a \
                 discontinuous error",
                unbroken(if place.is_empty() { "home" } else { place })
            ),
            None => ": too much of the box remains unbounded".to_owned(),
        };
        return Some(format!("The error after one step of compensation could not be bounded{why}."));
    };
    let shown = |value: f64| number::rounded_up(value, number::decimals(value, 2));
    let turned =
        left.orientation.map(|angle| format!(", and its orientation error {} mrad", shown(1e3 * angle)));
    let ends = if left.holds_tables {
        ". Tables keep their last value where the step goes beyond their ends."
    } else {
        "."
    };
    Some(format!(
        "After one step of compensation, q − J_q⁻¹ J_e ε, the repeatable error of the tool point \
         is at most {} {}{} in the exact chain, if the inputs are known and the joint limits \
         allow the step{ends}",
        shown(position),
        report.length,
        turned.unwrap_or_default()
    ))
}

/// States the margin to a tolerance that is kept, and after one step of compensation.
fn of_margin(margin: &Margin, (unit, factor): (&str, f64)) -> Option<String> {
    let left = |value: f64| number::rounded_down(factor * value, number::decimals(factor * value, 3));
    let kept = |margin: Option<f64>| margin.filter(|margin| *margin >= 0.0).map(left);
    let tolerance = format!("the tolerance of {} {unit}", number::digits(factor * margin.tolerance, 3));
    let step = "wherever the joint limits allow the step";
    match (kept(margin.certified), kept(margin.after_one_step)) {
        (None, None) => None,
        (Some(now), None) => Some(format!("The margin to {tolerance} is at least {now} {unit}.")),
        (None, Some(step_margin)) => Some(format!(
            "After one step of compensation, and with the random sources to first order, the margin to \
             {tolerance} is at least {step_margin} {unit} {step}."
        )),
        (Some(now), Some(step_margin)) => Some(format!(
            "The margin to {tolerance} is at least {now} {unit}; after one step of compensation, and with \
             the random sources to first order, at least {step_margin} {unit} {step}."
        )),
    }
}

fn table(report: &Report, title: &str, errors: &ErrorBounds) -> Table {
    let unit = report.length;
    let columns = ["error", ">at least", ">at most", "unit", "found at"];
    let names = ["norm", "x", "y", "z", "orientation"];
    Table::new(title, columns).rows(names.into_iter().zip(errors.all()).map(|(name, largest)| {
        let (factor, unit) = if name == "orientation" { (1e3, "mrad") } else { (1.0, unit) };
        let decimals = number::decimals(factor * largest.found, 5);
        let certified = match largest.certified {
            None => "not known".to_owned(),
            Some(certified) => number::rounded_up(factor * certified, decimals),
        };
        let mark = if largest.complete { "" } else { " (gap not reached)" };
        let place = if largest.label.is_empty() { "home" } else { &largest.label };
        let found = number::rounded_down(factor * largest.found, decimals);
        [name.to_owned(), found, certified, unit.to_owned(), unbroken(place) + mark]
    }))
}
