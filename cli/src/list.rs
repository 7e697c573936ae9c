//! `abbe list`: the shipped manipulators.

use abbe_report::text;
use abbe_study::list;
use clap::Args;

use crate::output::{Outcome, json};
use crate::{Console, Result};

#[derive(Args, Debug)]
#[command(after_help = after_help!("  abbe list
"))]
pub(crate) struct List {
    /// Print the list as JSON
    #[arg(long)]
    json: bool,
}

pub(crate) fn run(arguments: &List) -> Result<Outcome> {
    let shipped = list::List.run(&mut Console::default())?;
    Ok(Outcome::passed(if arguments.json { json(&shipped)? } else { text::list(&shipped) }))
}
