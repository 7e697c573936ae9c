//! `abbe bound`: how large the errors are at most.

use std::fmt::Write;

use abbe_interpreter::bound::Effort;
use abbe_report::text::{Table, wrapped};
use abbe_study::bound::{Bound, Errors, Report};
use abbe_study::number::{self, of_symbol, unbroken};
use abbe_study::workspace::name;

use crate::arguments;
use crate::console::Console;
use crate::failure::Failure;
use crate::output::{Outcome, json};

pub(crate) fn run(arguments: &arguments::Bound) -> Result<Outcome, Failure> {
    arguments.running.start()?;
    let machine = arguments.subject.as_written()?;
    let study = arguments::study(arguments.study.as_deref(), &machine)?;
    let changes = arguments.subject.changes(&machine.spec)?;
    let mut job = Bound::new(machine, study);
    job.change(&changes);
    job.effort = Effort { gap: arguments.gap, boxes: arguments.boxes as usize, ..job.effort };
    job.time = arguments.time;
    let report = job.run(&mut Console::default())?;
    Ok(Outcome::passed(if arguments.running.json { json(&report)? } else { text(&report) }))
}

fn text(report: &Report) -> String {
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
    let kinds = report.kinds();
    if kinds.is_empty() {
        text += "\nNo source of errors is switched on: there is nothing to bound.\n";
        return text;
    }
    for (title, errors) in &kinds {
        let _ = writeln!(text, "\n{title}\n{}", table(report, errors));
    }
    let end = format!(
        "The true maximum of each error lies between both numbers: the first was found at this place, and nothing in the box exceeds \
         the second. All to first order in the errors of the sources, ΔX = J_e ε. {} boxes were looked at.",
        report.boxes
    );
    let _ = writeln!(text, "{}", wrapped(&end, 0));
    text
}

/// As many decimals as five digits take.
fn decimals(value: f64) -> usize {
    if value > 0.0 { (4.0 - value.log10().floor()).clamp(0.0, 12.0) as usize } else { 4 }
}

fn table(report: &Report, errors: &Errors) -> Table {
    let unit = report.length;
    let mut table = Table::new(&["error", "at least", "at most", "unit", "found at"]);
    let names = ["norm", "x", "y", "z", "orientation"];
    for (name, largest) in names.into_iter().zip(errors.all()) {
        let (factor, unit) = if name == "orientation" { (1e3, "mrad") } else { (1.0, unit) };
        let decimals = decimals(factor * largest.found);
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
