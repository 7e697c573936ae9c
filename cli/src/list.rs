//! `abbe list`: the shipped manipulators.

use abbe_study::list;

use crate::arguments::List;
use crate::console::Console;
use crate::failure::Failure;
use crate::output::{Outcome, json};
use abbe_report::text::Table;

pub(crate) fn run(arguments: &List) -> Result<Outcome, Failure> {
    let shipped = list::List.run(&mut Console::default())?;
    if arguments.json {
        return Ok(Outcome::passed(json(&shipped)?));
    }
    let mut table = Table::new(&["name", "manipulator", "joints", "unit", "sources", "study"]);
    for manipulator in shipped {
        let study = if manipulator.study { "yes" } else { "" };
        table.row([
            manipulator.name,
            manipulator.title,
            manipulator.joints,
            manipulator.length.into(),
            manipulator.sources.to_string(),
            study.into(),
        ]);
    }
    Ok(Outcome::passed(table.right(&[4]).to_string()))
}
