//! `abbe completions`: completion scripts for shells.

use clap::CommandFactory;

use crate::arguments::{Arguments, Completions};
use crate::failure::Failure;
use crate::output::Outcome;

pub(crate) fn run(arguments: &Completions) -> Result<Outcome, Failure> {
    let mut script = Vec::new();
    clap_complete::generate(arguments.shell, &mut Arguments::command(), "abbe", &mut script);
    Ok(Outcome::passed(String::from_utf8_lossy(&script).into_owned()))
}
