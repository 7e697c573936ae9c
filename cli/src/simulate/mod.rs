//! `abbe simulate`: measurements of a machine whose errors are known.

use abbe_study::data::{Data, Map};
use abbe_study::simulate::{Places, Simulate};

use crate::arguments;
use crate::console::Console;
use crate::failure::Failure;
use crate::number::length;
use crate::output::{Outcome, Outputs, json};

pub(crate) fn run(arguments: &arguments::Simulate) -> Result<Outcome, Failure> {
    arguments.running.start()?;
    let machine = arguments.subject.machine()?;
    let map = Map::find(&arguments.map, &machine.spec)?;
    let noise = arguments.noise.as_ref().map(|text| length("--noise", text, &machine.spec)).transpose()?;
    let at = match &arguments.data {
        Some(file) => Places::Rows(Data::read_commanded(file, &map)?),
        None => Places::Samples(arguments.samples),
    };
    let job = Simulate {
        machine,
        map,
        at,
        noise,
        outliers: arguments.outliers,
        random: arguments.random,
        seed: arguments.seed,
    };
    let mut outputs = Outputs::new(&job, arguments.writing.force);
    let out = outputs.wanted(arguments.out.as_deref())?;
    let report = job.run(&mut Console::default())?;
    let table = &report.table;
    let printed = outputs.finish(out.map(|file| file.fill(&table.csv())).transpose()?)?;
    let text = match &arguments.out {
        _ if arguments.running.json => json(&report)?,
        Some(file) => format!("{}: {} rows\n", file.display(), table.rows.len()),
        None => table.csv(),
    };
    Ok(Outcome::passed(text).beside(printed))
}
