//! `abbe identify`: the generalized errors of a real machine, from measurements.
//!
//! `readings` asks whether the data are read as they were meant; `terms` makes candidates for richer models;
//! `solved` fits, judges and chooses, on the data alone; only then the test file is opened. `found` is what comes
//! out, `words` and `text` say it to people, `written` puts it into a spec.

mod found;
mod readings;
mod setup;
mod solved;
mod terms;
mod text;
mod words;
mod written;

use abbe_interpreter::Interpreter;

use crate::arguments::Identify;
use crate::data::{Data, Map};
use crate::failure::Failure;
use crate::output::{Outcome, json, note};
use abbe_study::Machine;

pub(crate) use readings::check_readings;
pub(crate) use setup::{Counts, Setup};
pub(crate) use words::table as alike_table;

pub(crate) fn run(arguments: &Identify) -> Result<Outcome, Failure> {
    let mut found = Machine::find(&arguments.spec)?;
    let changes = arguments.changes.read(&found.spec)?;
    if arguments.out.is_some() && !changes.is_empty() {
        return Err(Failure::of(
            "--out",
            "the spec that is written has no room for changes of this command line",
        )
        .help("make them in a copy of the spec, then identify that"));
    }
    found.change(&changes);
    let map = Map::find(&arguments.map, &found.spec)?;
    let data = Data::read(&arguments.data, &map)?;
    let text = found.text()?;
    let candidates = terms::candidates(&found.spec, &arguments.terms);
    let mut spec = terms::with(&found.spec, &text, &candidates)?;
    changes.apply(&mut spec);
    let interpreter = Interpreter::new(spec);
    let setup = Setup::new(&interpreter, &map, &data, candidates.len())?;
    check_readings(&setup, &map, &data)?;
    let solved = solved::solve(&setup, &map, &data, &candidates, arguments)?;
    // From here on nothing is chosen any more.
    let test = arguments.test.as_ref().map(|file| Data::read(file, &map)).transpose()?;
    let report = found::report(&found.spec, &setup, &data, test.as_ref(), &solved, &map)?;
    let written = match &arguments.out {
        Some(file) => Some(written::write(file, &found.spec, &text, &setup, &solved, &candidates, &data)?),
        None => None,
    };
    if arguments.json {
        solved.notes.iter().for_each(|line| note(line));
        return Ok(Outcome::passed(json(&report)?));
    }
    Ok(Outcome::passed(text::of(
        &found.spec,
        &setup,
        &data,
        test.as_ref(),
        &solved,
        &report,
        written.as_deref(),
    )))
}
