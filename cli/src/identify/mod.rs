//! `abbe identify`: the generalized errors of a real machine, from measurements.

mod alike;
mod text;

use std::path::Path;

use abbe::identify::Loss;
use abbe_study::Machine;
use abbe_study::data::{Data, Map};
use abbe_study::identify::{Family, Identify, Report, Settings};

use crate::arguments::{self, Robust, Terms};
use crate::console::Console;
use crate::failure::Failure;
use crate::output::{Outcome, json, note, write};

pub(crate) use alike::table as alike_table;

pub(crate) fn run(arguments: &arguments::Identify) -> Result<Outcome, Failure> {
    let mut machine = Machine::find(&arguments.spec)?;
    let changes = arguments.changes.read(&machine.spec)?;
    if arguments.out.is_some() && !changes.is_empty() {
        return Err(Failure::of(
            "--out",
            "the spec that is written has no room for changes of this command line",
        )
        .help("make them in a copy of the spec, then identify that"));
    }
    machine.change(&changes);
    let map = Map::find(&arguments.map, &machine.spec)?;
    let data = Data::read(&arguments.data, &map)?;
    let test = arguments.test.as_ref().map(|file| Data::read(file, &map)).transpose()?;
    let settings = Settings { loss: loss(arguments.robust), prior: arguments.prior, folds: arguments.folds };
    let job = Identify { machine, map, data, test, terms: families(&arguments.terms), settings };
    let report = job.run(&mut Console::default())?;
    let written = arguments.out.as_ref().map(|file| write_spec(file, &job.machine, &report)).transpose()?;
    if arguments.json {
        report.notes.iter().for_each(|line| note(line));
        return Ok(Outcome::passed(json(&report)?));
    }
    Ok(Outcome::passed(text::text(&job.machine.spec, &report, written.as_deref())))
}

/// Writes the spec of the identified machine; what was added to it comes back, line by line.
fn write_spec(file: &Path, machine: &Machine, report: &Report) -> Result<String, Failure> {
    let spec = report.found.written(&machine.spec, &machine.text()?, &file.display().to_string())?;
    write(file, &spec.text)?;
    let lines = spec.added.trim_end().lines().map(|line| format!("+ {line}").trim_end().to_owned() + "\n");
    let lines: String = lines.collect();
    Ok(format!("Written to {}: the nominal spec and these lines\n{lines}", file.display()))
}

fn loss(robust: Robust) -> Loss {
    match robust {
        Robust::None => Loss::Squares,
        Robust::Huber => Loss::Huber,
        Robust::Tukey => Loss::Tukey,
    }
}

fn families(terms: &[Terms]) -> Vec<Family> {
    let families = terms.iter().flat_map(|terms| match terms {
        Terms::Auto => vec![Family::Joint, Family::Load, Family::Elastic],
        Terms::Joint => vec![Family::Joint],
        Terms::Load => vec![Family::Load],
        Terms::Elastic => vec![Family::Elastic],
    });
    families.collect()
}
