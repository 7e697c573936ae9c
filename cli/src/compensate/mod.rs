//! `abbe compensate`: joint commands that put the real tool where the ideal one should be.
//!
//! `rows` solves row by row, `text` shows it.

mod rows;
mod text;

use abbe::identify::Figures;
use abbe_codegen::spec::Spec;
use serde::Serialize;

use crate::arguments::Compensate;
use crate::data::{Data, Map, Unusable};
use crate::failure::Failure;
use crate::output::{Outcome, json};
use crate::simulate::{csv, length, write};
use abbe_study::Machine;

use rows::Row;

/// What is printed.
#[derive(Serialize)]
struct Report {
    name: String,
    length: &'static str,
    /// How many rows are compensated to the tolerance.
    compensated: usize,
    tolerance: f64,
    /// The distance of the tool point from where it should be, with the commands as they were and corrected.
    before: Size,
    after: Size,
    rows: Vec<Row>,
    unusable: Vec<Unusable>,
}

/// Figures of the norms of ΔX: lengths in the spec's unit, angles in rad.
#[derive(Serialize)]
struct Size {
    mean: f64,
    rms: f64,
    max: f64,
    angle_max: f64,
}

impl Size {
    fn of(norms: impl Iterator<Item = (f64, f64)>) -> Self {
        let (lengths, angles): (Vec<f64>, Vec<f64>) = norms.unzip();
        let Figures { mean, rms, max, .. } = Figures::of(lengths);
        Self { mean, rms, max, angle_max: angles.into_iter().fold(0.0, f64::max) }
    }
}

pub(crate) fn run(arguments: &Compensate) -> Result<Outcome, Failure> {
    let mut found = Machine::find(&arguments.spec)?;
    let changes = arguments.changes.read(&found.spec)?;
    found.change(&changes);
    let map = map(arguments, &found.spec)?;
    let tolerance = length("--tolerance", &arguments.tolerance, &found.spec)?;
    let mut data = match arguments.poses {
        true => Data::read_wanted(&arguments.data, &map)?,
        false => Data::read_commanded(&arguments.data, &map)?,
    };
    let manipulator = found.evaluator(true);
    let rows = rows::of(&*manipulator, &mut data, arguments.poses, tolerance)?;
    let report = Report {
        name: found.spec.name.clone(),
        length: found.spec.length.symbol(),
        compensated: rows.iter().filter(|row| row.reason.is_none()).count(),
        tolerance,
        before: Size::of(rows.iter().map(|row| (row.before.length, row.before.angle))),
        after: Size::of(rows.iter().map(|row| (row.after.length, row.after.angle))),
        unusable: data.unusable.clone(),
        rows,
    };
    if let Some(file) = &arguments.out {
        write(file, &table(&map, &data, &report))?;
    }
    let text = match arguments.json {
        true => json(&report)?,
        false => text::of(manipulator.description(), &data, &report, arguments.out.as_deref()),
    };
    Ok(Outcome::checked(text, report.compensated == report.rows.len() + report.unusable.len()))
}

/// The map that is given, or the names of the spec.
fn map(arguments: &Compensate, spec: &Spec) -> Result<Map, Failure> {
    let Some(file) = &arguments.map else {
        return Ok(Map::of_names(&Data::heading(&arguments.data)?, spec)?);
    };
    let map = Map::find(file, spec)?;
    if arguments.poses && (!map.is_pose() || map.base_unknown) {
        let message = "`--poses` needs a map with `[pose]`, in F_0";
        return Err(Failure::of(file.display(), message)
            .help("name the columns of position and orientation; or leave `--poses` out to correct joints"));
    }
    Ok(map)
}

/// The corrected commands in the columns and units of the data, and what they leave.
fn table(map: &Map, data: &Data, report: &Report) -> String {
    let mut heading = map.heading(false);
    let added = ["line", "error_before", "error_after", "angle_before", "angle_after", "compensated"];
    heading.extend(added.map(str::to_owned));
    let lines = report.rows.iter().zip(&data.observations).map(|(row, asked)| {
        let mut values = map.numbers(asked, [0.0; 3], false);
        let done = f64::from(u8::from(row.reason.is_none()));
        let Row { line, before, after, .. } = row;
        let added = [*line as f64, before.length, after.length, before.angle, after.angle, done];
        values.extend(added.map(Some));
        values
    });
    csv(&heading, &lines.collect::<Vec<_>>())
}
