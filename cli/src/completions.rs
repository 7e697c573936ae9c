//! `abbe completions`: completion scripts for shells.

use clap::{Args, Command};
use clap_complete::Shell;

use crate::{Outcome, Result};

#[derive(Args, Debug)]
#[command(after_help = after_help!(
    "  abbe completions bash
  abbe completions zsh
"))]
pub(crate) struct Completions {
    /// Shell to generate completions for
    #[arg(value_enum)]
    shell: Shell,
}

pub(crate) fn run(arguments: &Completions, mut command: Command) -> Result<Outcome> {
    let mut script = Vec::new();
    clap_complete::generate(arguments.shell, &mut command, "abbe", &mut script);
    Ok(Outcome::passed(String::from_utf8_lossy(&script).into_owned()))
}
