//! `abbe check`: whether a spec is right, and what follows from it.

use abbe_report::text;
use abbe_study::Notes;
use abbe_study::check;

use crate::arguments::Check;
use crate::console::Console;
use crate::failure::Failure;
use crate::output::{Outcome, json};

pub(crate) fn run(arguments: &Check) -> Result<Outcome, Failure> {
    let job = check::Check { machine: arguments.subject.machine()? };
    let mut console = Console::default();
    let report = job.run(&mut console)?;
    for warning in &report.warnings {
        let line = warning.line.map(|line| format!(":{line}")).unwrap_or_default();
        console.warn(&format!("{}{line}: {}", report.facts.spec, warning.message));
    }
    let shown = if arguments.json { json(&report)? } else { text::check(&report) };
    Ok(Outcome::checked(shown, report.passed()))
}
