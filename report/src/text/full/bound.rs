//! Full text of certified bounds.

use std::fmt::Write;

use abbe_study::bound::{Dexterity, ErrorBound, ErrorBounds, LowerBound, Margin, Report};
use abbe_study::number::{self, of_symbol, unbroken};

use super::{Table, wrapped};

/// Prints every bound with the configuration of its largest found error.
pub(in crate::text) fn bound(report: &Report) -> String {
    let mut text = String::new();
    let spans = report.moving_spans.iter().map(|span| {
        let show = |value| of_symbol(value, span.symbol, &report.spec);
        unbroken(&format!(
            "{} from {} to {}",
            report.spec.name_of(span.symbol),
            show(span.range[0]),
            show(span.range[1])
        ))
    });
    let spans: Vec<String> = spans.collect();
    let within = if spans.is_empty() { "nothing moves".to_owned() } else { spans.join(", ") };
    let _ = writeln!(
        text,
        "{} ({})\n{}\n\nBox: {}.",
        report.spec.title,
        report.manipulator,
        report.study.title,
        wrapped(&within, 5)
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
        text += "\nNo error source is enabled: there is no error to bound.\n";
        return text;
    }
    for (title, errors) in &kinds {
        let _ = writeln!(text, "\n{title}\n{}", table(report, errors));
    }
    let unknown =
        kinds.iter().any(|(_, errors)| errors.all().iter().any(|largest| largest.certified.is_none()));
    let unknown = match unknown {
        true => {
            " Where no bound is given, none could be proved: an expression may divide by zero in \
             the box."
        }
        false => "",
    };
    let end = format!(
        "The true maximum of each error lies between both numbers: the first was found at this \
         configuration, and no error in the box exceeds the second.{unknown} All to first order, \
         ΔX = J_e ε. {} boxes were examined.",
        report.boxes
    );
    let _ = writeln!(text, "{}", wrapped(&end, 0));
    let margins = [
        (report.margin, &report.radius.norm, report.length, 1.0),
        (report.orientation_margin, &report.radius.orientation, "mrad", 1e3),
    ];
    let margins = margins.into_iter().filter_map(|(margin, largest, unit, factor)| {
        Some(of_tolerance(&margin?, largest, report.contains_more, (unit, factor)))
    });
    for sentence in
        [first_order_remainder(report), after_one_step(report)].into_iter().flatten().chain(margins)
    {
        let _ = writeln!(text, "{}", wrapped(&sentence, 0));
    }
    text
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

fn of_joints(dexterity: &Dexterity) -> Table {
    let pose = dexterity.pose.as_ref().map(|pose| ("tool, 1 rad as 1 m", pose, 1.0));
    let rows: Vec<_> = std::iter::once(("tool point", &dexterity.point, 1.0)).chain(pose).collect();
    least(&rows)
}

/// Least values, each with its name and its factor.
fn least(rows: &[(&str, &LowerBound, f64)]) -> Table {
    let mut table = Table::new(&["of", "never below", "found", "found at"]);
    for (name, least, factor) in rows {
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
        table.row([(*name).to_owned(), certified, found, unbroken(place) + mark]);
    }
    table.right(&[1, 2])
}

/// States the bound of the first-order remainder; none without repeatable sources.
pub(in crate::text) fn first_order_remainder(report: &Report) -> Option<String> {
    let Some(certified) = report.remainder.as_ref()?.certified else {
        return Some(
            "The difference between the exact chain and first order could not be bounded.".to_owned(),
        );
    };
    // Two digits: it is no closer than that.
    let decimals = number::decimals(certified, 2);
    Some(format!(
        "Within the box, the tool point of the exact chain A_1 E_1 … A_n E_n T differs from first \
         order by no more than {} {} (repeatable sources).",
        number::rounded_up(certified, decimals),
        report.length
    ))
}

/// States the bound of the error after one step of compensation; none without repeatable sources.
pub(in crate::text) fn after_one_step(report: &Report) -> Option<String> {
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

/// States whether a tolerance is kept.
fn of_tolerance(
    margin: &Margin,
    largest: &ErrorBound,
    contains_more: bool,
    (unit, factor): (&str, f64),
) -> String {
    let show = |value: f64| number::digits(factor * value, 3);
    let left = |value: f64| number::rounded_down(factor * value, number::decimals(factor * value, 3));
    let tolerance = show(margin.tolerance);
    let plain = match margin.certified {
        Some(certified) if certified >= 0.0 => {
            format!("is met everywhere in the box, with a margin of at least {} {unit}.", left(certified))
        }
        _ if margin.found < 0.0 && contains_more => format!(
            "is undecided for the study: {} {unit} found in the box, which contains configurations \
             that the study does not have.",
            show(largest.found)
        ),
        _ if margin.found < 0.0 => {
            format!("is exceeded in the box: {} {unit} found.", show(largest.found))
        }
        _ => "is undecided: the bound on the largest error is not tight enough.".to_owned(),
    };
    let compensated = match margin.after_one_step {
        Some(certified) if certified >= 0.0 => format!(
            " After such a step, and with the random sources to first order, the margin is at \
             least {} {unit} wherever the joint limits allow the step.",
            left(certified)
        ),
        _ => String::new(),
    };
    format!("The tolerance of {tolerance} {unit} {plain}{compensated}")
}

fn table(report: &Report, errors: &ErrorBounds) -> Table {
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
        let place = if largest.label.is_empty() { "home" } else { &largest.label };
        let found = number::rounded_down(factor * largest.found, decimals);
        table.row([name.to_owned(), found, certified, unit.to_owned(), unbroken(place) + mark]);
    }
    table.right(&[1, 2])
}
