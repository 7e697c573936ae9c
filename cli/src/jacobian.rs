//! `abbe jacobian`: pose, error Jacobian and generalized errors at one configuration.

use abbe_report::text;
use abbe_study::jacobian;

use crate::arguments::Jacobian;
use crate::console::Console;
use crate::failure::Failure;
use crate::output::{Outcome, json};

pub(crate) fn run(arguments: &Jacobian) -> Result<Outcome, Failure> {
    let machine = arguments.subject.machine()?;
    let q = match &arguments.q {
        Some(text) => Some(jacobian::read_joint_variables(text, &machine.spec)?),
        None => None,
    };
    let report = jacobian::Jacobian { machine, q }.run(&mut Console::default())?;
    Ok(Outcome::passed(if arguments.json { json(&report)? } else { text::jacobian(&report) }))
}
