//! `abbe check`: checks a spec and shows its model.

use abbe_report::views;
use abbe_study::{Notes, check};
use clap::Args;

use crate::arguments::{Showing, Subject};
use crate::output::{Outcome, quoted};
use crate::{Console, Result};

#[derive(Args, Debug)]
#[command(after_help = after_help!(
    "  abbe check arm.toml
  abbe check arm.toml --set payload=5kg
", "a self-check fails: J_e differs from the exact chain"))]
pub(crate) struct Check {
    #[command(flatten)]
    subject: Subject,
    #[command(flatten)]
    showing: Showing,
}

pub(crate) fn run(arguments: &Check) -> Result<Outcome> {
    let job = check::Check { machine: arguments.subject.machine()? };
    let mut console = Console::default();
    let report = job.run(&mut console)?;
    for warning in &report.warnings {
        let line = warning.line.map(|line| format!(":{line}")).unwrap_or_default();
        console.warn(&format!("{}{line}: {}", report.facts.spec, warning.message));
    }
    let next = match report.passed() {
        true => format!(
            "abbe analyze {}; --full for matrices, sources, laws and operation counts",
            quoted(&report.facts.spec)
        ),
        false => "--full for matrices, sources and laws".to_owned(),
    };
    let shown = arguments.showing.answer(&report, views::check(&report), &next)?;
    Ok(Outcome::checked(shown, report.passed()))
}
