//! `abbe list`: the shipped manipulators.

use abbe_report::text;
use abbe_study::list;

use crate::arguments::List;
use crate::console::Console;
use crate::failure::Failure;
use crate::output::{Outcome, json};

pub(crate) fn run(arguments: &List) -> Result<Outcome, Failure> {
    let shipped = list::List.run(&mut Console::default())?;
    Ok(Outcome::passed(if arguments.json { json(&shipped)? } else { text::list(&shipped) }))
}
