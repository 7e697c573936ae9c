//! `abbe simulate`: measurements of a machine whose errors are known.

use std::io::Write;
use std::path::Path;

use abbe::analysis::{Workspace, random_joint_samples};
use abbe::identify::{Chance, Observation, Uncertainty, simulate};
use abbe::{Description, Manipulator};
use abbe_codegen::document::Document;
use abbe_codegen::expr::{Dimension, parse_value};
use abbe_codegen::spec::Spec;
use abbe_interpreter::Interpreter;

use crate::arguments::Simulate;
use crate::data::{Data, Map};
use crate::failure::Failure;
use crate::identify::Setup;
use crate::output::{Outcome, Pending, cannot_write};
use abbe_study::Machine;

pub(crate) fn run(arguments: &Simulate) -> Result<Outcome, Failure> {
    let mut found = Machine::find(&arguments.spec)?;
    found.change(&arguments.changes.read(&found.spec)?);
    let map = Map::find(&arguments.map, &found.spec)?;
    let noise = match &arguments.noise {
        Some(text) => length("--noise", text, &found.spec)?,
        None => map.uncertainty.length,
    };
    let interpreter = Interpreter::new(found.spec.clone());
    let description = interpreter.description();
    let list = match &arguments.at {
        Some(file) => Data::read_commanded(file, &map)?,
        None => sampled(&interpreter, description, &map, arguments)?,
    };
    let setup = Setup::at_home(&interpreter, &map)?;
    let chance = Chance {
        noise: Uncertainty { length: noise, angle: map.uncertainty.angle * noise / map.uncertainty.length },
        outliers: arguments.outliers,
        gross: 0.05 * setup.arm,
        random_sources: arguments.random,
        seed: arguments.seed,
    };
    let fail = |(row, error): (usize, abbe::Error)| {
        let line = list.lines.get(row).copied().unwrap_or_default();
        Failure::evaluation(&list.file, &format!("line {line}"), &error, description)
    };
    let seen = simulate(&setup.real, &list.observations, &chance).map_err(fail)?;
    let mut rows = Vec::new();
    let mut room = setup.ideal.room();
    for (i, row) in seen.iter().enumerate() {
        let ideal = setup.ideal.pose(&mut room, row, &[]).map_err(|error| fail((i, error)))?.position();
        rows.push(map.numbers(row, ideal, true));
    }
    let text = csv(&map.heading(true), &rows);
    match &arguments.out {
        Some(file) => {
            write(file, &text)?;
            Ok(Outcome::passed(format!("{}: {} rows\n", file.display(), rows.len())))
        }
        None => Ok(Outcome::passed(text)),
    }
}

/// Random configurations within the limits; what the map holds fixed stays so.
fn sampled(
    interpreter: &Interpreter,
    description: &Description,
    map: &Map,
    arguments: &Simulate,
) -> Result<Data, Failure> {
    let moved: Vec<usize> = map.moved().collect();
    let samples = random_joint_samples(interpreter, &moved, arguments.samples, arguments.seed);
    let samples = samples.map_err(|error| Failure::of(&arguments.spec, error))?.reached();
    let rows: Vec<Observation> = samples.into_iter().map(|sample| map.asked(sample.q, description)).collect();
    Ok(Data {
        file: "--samples".to_owned(),
        lines: (1..=rows.len() as u64).collect(),
        observations: rows,
        ..Data::default()
    })
}

/// A length that an option gives; it is not negative.
pub(crate) fn length(option: &str, text: &str, spec: &Spec) -> Result<f64, Failure> {
    let mut document = Document::new(option, text);
    let value = parse_value(&mut document, 0..text.len(), spec.length, Dimension::LENGTH, "this");
    match document.finish(value)? {
        value if value >= 0.0 => Ok(value),
        _ => Err(Failure::of(option, "this is not negative").help(format!("write `{option} 0.04mm`"))),
    }
}

/// A file with a heading; what was not seen is an empty field. Digits enough for a nanometre.
pub(crate) fn csv(heading: &[String], rows: &[Vec<Option<f64>>]) -> String {
    let mut text = heading.join(",") + "\n";
    for row in rows {
        let fields = row.iter().map(|value| value.map_or(String::new(), field));
        text += &(fields.collect::<Vec<_>>().join(",") + "\n");
    }
    text
}

fn field(value: f64) -> String {
    let value = format!("{value:.9e}").parse::<f64>().unwrap_or(value);
    format!("{}", value + 0.0)
}

/// A file that is whole or not there.
pub(crate) fn write(file: &Path, text: &str) -> Result<(), Failure> {
    let mut pending = Pending::create(file)?;
    pending.write_all(text.as_bytes()).map_err(|error| cannot_write(file, &error))?;
    pending.finish()
}
