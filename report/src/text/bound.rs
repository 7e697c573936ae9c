//! How large errors are at most, as text.

use std::fmt::Write;

use abbe_study::bound::{Dexterity, Errors, Largest, Least, Margin, Report};
use abbe_study::number::{self, of_symbol, unbroken};
use abbe_study::workspace::name;

use super::{Table, wrapped};

/// What `abbe bound` prints.
pub fn bound(report: &Report) -> String {
    let mut text = String::new();
    let spans = report.moved.iter().map(|span| {
        let show = |value| of_symbol(value, span.symbol, &report.spec);
        unbroken(&format!(
            "{} from {} to {}",
            name(span.symbol, &report.spec),
            show(span.range[0]),
            show(span.range[1])
        ))
    });
    let spans: Vec<String> = spans.collect();
    let within = if spans.is_empty() { "nothing moves".to_owned() } else { spans.join(", ") };
    let _ = writeln!(
        text,
        "{} ({})\n{}\n\nThe box: {}.",
        report.spec.title,
        report.manipulator,
        report.study.title,
        wrapped(&within, 9)
    );
    if let Some(dexterity) = &report.dexterity {
        let _ = writeln!(text, "\nDexterity\n{}", of_joints(dexterity));
        let _ = writeln!(text, "{}", wrapped(DEXTERITY, 0));
    }
    if let Some(stiffness) = &report.stiffness {
        // 1 N/m is a thousandth of 1 N/mm.
        let row = ("tool point, N/mm", stiffness, 1e-3);
        let _ = writeln!(text, "\nStiffness\n{}", least(&[row]));
        let _ = writeln!(text, "{}", wrapped(STIFFNESS, 0));
    }
    let kinds = report.kinds();
    if kinds.is_empty() {
        text += "\nNo source of errors is switched on: there is no error to bound.\n";
        return text;
    }
    for (title, errors) in &kinds {
        let _ = writeln!(text, "\n{title}\n{}", table(report, errors));
    }
    let unknown =
        kinds.iter().any(|(_, errors)| errors.all().iter().any(|largest| largest.certified.is_none()));
    let unknown = match unknown {
        true => {
            " Where the second is not known nothing could be proved: perhaps something divides by 0 in the box."
        }
        false => "",
    };
    let end = format!(
        "The true maximum of each error lies between both numbers: the first was found at this place, and nothing in the box exceeds \
         the second.{unknown} All to first order in the errors of the sources, ΔX = J_e ε. {} boxes were looked at.",
        report.boxes
    );
    let _ = writeln!(text, "{}", wrapped(&end, 0));
    let margins = [
        (report.margin, &report.radius.norm, report.length, 1.0),
        (report.orientation_margin, &report.radius.orientation, "mrad", 1e3),
    ];
    let margins = margins
        .into_iter()
        .filter_map(|(margin, largest, unit, factor)| Some(of_tolerance(&margin?, largest, unit, factor)));
    for sentence in [left_out(report), after_one_step(report)].into_iter().flatten().chain(margins) {
        let _ = writeln!(text, "{}", wrapped(&sentence, 0));
    }
    text
}

/// What a dexterity is.
const DEXTERITY: &str = "The joints can move the tool this far at least, in whatever direction, when they move by 1 rad or 1 m altogether (root \
                         sum of squares): the least singular value of J_q, in metres and rad, 0 in a singular place. Nothing in the box \
                         is below the first number; the second was found at this place.";

/// What a stiffness is.
const STIFFNESS: &str = "A force at the tool point, in whatever direction, over the length by which it moves the point because of the beams and compliances \
                         of the repeatable sources: the inverse of the largest singular value of the compliance at the tool point. Nothing \
                         in the box is below the first number; the second was found at this place. What the spec does not \
                         know to give way is rigid here.";

fn of_joints(dexterity: &Dexterity) -> Table {
    let pose = dexterity.pose.as_ref().map(|pose| ("tool, 1 rad as 1 m", pose, 1.0));
    let rows: Vec<_> = std::iter::once(("tool point", &dexterity.point, 1.0)).chain(pose).collect();
    least(&rows)
}

/// Least values, each with its name and its factor.
fn least(rows: &[(&str, &Least, f64)]) -> Table {
    let mut table = Table::new(&["of", "never below", "found", "found at"]);
    for (name, least, factor) in rows {
        let found = least.found.map(|found| factor * found);
        let decimals = number::decimals(found.unwrap_or(factor * least.certified).max(1e-3), 5);
        let place = match least.found {
            None => "nowhere",
            Some(_) if least.place.is_empty() => "home",
            Some(_) => &least.place,
        };
        let certified = number::rounded_down(factor * least.certified, decimals);
        let mark = if least.complete { "" } else { " (gap not reached)" };
        let found = found.map_or("not known".to_owned(), |found| number::rounded_up(found, decimals));
        table.row([(*name).to_owned(), certified, found, unbroken(place) + mark]);
    }
    table.right(&[1, 2])
}

/// What first order leaves out, in a sentence; none if there is nothing to say.
fn left_out(report: &Report) -> Option<String> {
    let Some(certified) = report.remainder.as_ref()?.certified else {
        return Some("How far the exact chain differs from first order could not be proved.".to_owned());
    };
    // Two digits: it is no closer than that.
    let decimals = number::decimals(certified, 2);
    Some(format!(
        "Nowhere in the box does the exact chain A_1 E_1 … A_n E_n T of the repeatable sources have the tool point more than {} {} \
         from where first order has it.",
        number::rounded_up(certified, decimals),
        report.length
    ))
}

/// What one step of compensation leaves, in a sentence; none if there is nothing to say.
fn after_one_step(report: &Report) -> Option<String> {
    let left = report.after_one_step.as_ref()?;
    let is_known = left.orientation.is_some() || !left.corrects_orientation;
    let Some(position) = left.position.filter(|_| is_known) else {
        let why = match &left.hardly {
            Some(place) => format!(
                ": near {} it may leave more than there is, because the joints can hardly move the tool in every direction there, or because an error \
                 jumps",
                unbroken(if place.is_empty() { "home" } else { place })
            ),
            None => ": of too much of the box nothing is known".to_owned(),
        };
        return Some(format!("What one step of compensation leaves could not be proved{why}."));
    };
    let shown = |value: f64| number::rounded_up(value, number::decimals(value, 2));
    let turned = left
        .orientation
        .map(|angle| format!(", and its orientation is off by no more than {} mrad", shown(1e3 * angle)));
    Some(format!(
        "Compensation of the repeatable sources by one step of the joints, q − J_q⁻¹ J_e ε, leaves no more than {} {} of the tool point's \
         error{} in the exact chain, if the inputs are known and the limits of the joints allow the step.",
        shown(position),
        report.length,
        turned.unwrap_or_default()
    ))
}

/// Whether a tolerance is kept, in a sentence.
fn of_tolerance(margin: &Margin, largest: &Largest, unit: &str, factor: f64) -> String {
    let show = |value: f64| number::digits(factor * value, 3);
    let left = |value: f64| number::rounded_down(factor * value, number::decimals(factor * value, 3));
    let tolerance = show(margin.tolerance);
    let plain = match margin.certified {
        Some(certified) if certified >= 0.0 => {
            format!("is kept everywhere in the box: at least {} {unit} of it are left.", left(certified))
        }
        _ if margin.found < 0.0 => {
            format!("is not kept everywhere in the box: {} {unit} were found.", show(largest.found))
        }
        _ => "may be kept or not: the largest error is not known closely enough.".to_owned(),
    };
    let compensated = match margin.after_one_step {
        Some(certified) if certified >= 0.0 => format!(
            " With such a step, and with the random sources to first order, at least {} {unit} of it are left wherever the limits of the \
             joints allow the step.",
            left(certified)
        ),
        _ => String::new(),
    };
    format!("The tolerance of {tolerance} {unit} {plain}{compensated}")
}

fn table(report: &Report, errors: &Errors) -> Table {
    let unit = report.length;
    let mut table = Table::new(&["error", "at least", "at most", "unit", "found at"]);
    let names = ["norm", "x", "y", "z", "orientation"];
    for (name, largest) in names.into_iter().zip(errors.all()) {
        let (factor, unit) = if name == "orientation" { (1e3, "mrad") } else { (1.0, unit) };
        let decimals = number::decimals(factor * largest.found, 5);
        let certified = match largest.certified {
            None => "not known".to_owned(),
            Some(certified) => number::rounded_up(factor * certified, decimals),
        };
        let mark = if largest.complete { "" } else { " (gap not reached)" };
        let place = if largest.place.is_empty() { "home" } else { &largest.place };
        let found = number::rounded_down(factor * largest.found, decimals);
        table.row([name.to_owned(), found, certified, unit.to_owned(), unbroken(place) + mark]);
    }
    table.right(&[1, 2])
}
