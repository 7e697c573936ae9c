//! `abbe simulate`: simulates measurements of a machine with the errors of its spec.

use std::io;
use std::path::Path;

use abbe_metrology::data::{Csv, Data, Map};
use abbe_metrology::simulate::{Places, Simulate};

use crate::arguments;
use crate::console::Console;
use crate::failure::Failure;
use crate::number::length;
use crate::output::{Outcome, Outputs, cannot_write, json};

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
    let mut watch = Console::default();
    if arguments.running.json {
        let out = outputs.wanted(arguments.out.as_deref())?;
        let report = job.run(&mut watch)?;
        let printed = outputs.finish(out.map(|file| file.fill(&report.table.csv())).transpose()?)?;
        return Ok(Outcome::passed(json(&report)?).beside(printed));
    }
    let out = arguments.out.as_deref().unwrap_or(Path::new("-"));
    let failed = |error: io::Error| cannot_write(out, &error);
    let mut csv = Csv::new(outputs.file(out)?, &job.heading()).map_err(failed)?;
    let count = job.each(&mut watch, |row| csv.row(row.label, &row.numbers).map_err(failed))?;
    let printed = outputs.finish([csv.finish().map_err(failed)?])?;
    Ok(match &arguments.out {
        Some(file) => Outcome::passed(format!("{}: {count} rows\n", file.display())).beside(printed),
        None => Outcome::passed(String::new()),
    })
}
