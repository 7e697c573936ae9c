//! `abbe check`: whether a spec is right, and what follows from it.
//!
//! `facts` is what the spec says, `identifiable` what measurements could tell, `laws` whether the closed form
//! agrees with the exact chain; `text` shows all three to people.

mod facts;
mod identifiable;
mod laws;
mod text;

use abbe_interpreter::Interpreter;
use serde::Serialize;

use crate::arguments::Check;
use crate::failure::Failure;
use crate::output::{Outcome, json};
use abbe_study::Machine;

use facts::Facts;
use identifiable::Identified;
use laws::Law;

/// What is printed.
#[derive(Serialize)]
struct Report<'a> {
    #[serde(flatten)]
    facts: Facts<'a>,
    identifiable: Vec<Identified>,
    configurations: usize,
    laws: Vec<Law>,
}

pub(crate) fn run(arguments: &Check) -> Result<Outcome, Failure> {
    let found = Machine::find(&arguments.spec)?;
    let interpreter = Interpreter::new(found.spec.clone());
    let configurations = laws::configurations(&found.spec);
    let report = Report {
        facts: Facts::new(&found.spec, &found.origin),
        identifiable: identifiable::count(&found.spec),
        configurations,
        laws: laws::check(&interpreter, configurations),
    };
    let passed = report.laws.iter().all(|law| law.holds);
    let text = if arguments.json { json(&report)? } else { text::of(&found.spec, &report) };
    Ok(Outcome::checked(text, passed))
}
