//! `abbe simulate`: measurements of a machine whose errors are known.

use abbe_study::Machine;
use abbe_study::data::{Data, Map};
use abbe_study::simulate::{Places, Simulate};

use crate::arguments;
use crate::console::Console;
use crate::failure::Failure;
use crate::number::length;
use crate::output::{Outcome, write};

pub(crate) fn run(arguments: &arguments::Simulate) -> Result<Outcome, Failure> {
    let mut machine = Machine::find(&arguments.spec)?;
    machine.change(&arguments.changes.read(&machine.spec)?);
    let map = Map::find(&arguments.map, &machine.spec)?;
    let noise = arguments.noise.as_ref().map(|text| length("--noise", text, &machine.spec)).transpose()?;
    let at = match &arguments.at {
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
    let table = job.run(&mut Console::default())?.table;
    match &arguments.out {
        Some(file) => {
            write(file, &table.csv())?;
            Ok(Outcome::passed(format!("{}: {} rows\n", file.display(), table.rows.len())))
        }
        None => Ok(Outcome::passed(table.csv())),
    }
}
