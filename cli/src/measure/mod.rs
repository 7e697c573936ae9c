//! `abbe measure`: how good a machine is. Accuracy, repeatability, and what the sources of its spec explain.
//!
//! `errors` are ΔX of every row; `repeated` what ISO 9283 says of configurations that were visited again;
//! `explained` compares with the prediction; `text` and `page` show it.

mod errors;
mod explained;
mod page;
mod repeated;
mod text;

use abbe_interpreter::Interpreter;
use serde::Serialize;

use crate::arguments::Measure;
use crate::data::{Data, Map};
use crate::failure::Failure;
use crate::identify::{Setup, check_readings};
use crate::output::{Outcome, cannot_write, json};
use crate::simulate::{csv, write};
use abbe_study::Machine;

use errors::Errors;
use explained::Explained;
use repeated::Repeated;

/// What is printed.
#[derive(Serialize)]
struct Report {
    name: String,
    length: &'static str,
    title: String,
    rows: usize,
    /// ΔX = measured − ideal: along x, y, z and as norm; of poses the turns about x, y, z as well.
    errors: Vec<Size>,
    explained: Explained,
    repeated: Repeated,
    unusable: usize,
}

/// One component of ΔX over all rows.
#[derive(Serialize)]
struct Size {
    name: &'static str,
    unit: &'static str,
    mean: f64,
    rms: f64,
    /// The largest, either sign.
    max: f64,
    /// Three standard deviations about the mean.
    three_sigma: f64,
}

impl Size {
    fn of(name: &'static str, unit: &'static str, values: &[f64]) -> Self {
        let n = values.len().max(1) as f64;
        let mean = values.iter().sum::<f64>() / n;
        let squares = values.iter().map(|v| (v - mean).powi(2)).sum::<f64>();
        Self {
            name,
            unit,
            mean: mean + 0.0,
            rms: (values.iter().map(|v| v * v).sum::<f64>() / n).sqrt(),
            max: values.iter().fold(0.0, |most: f64, v| most.max(v.abs())),
            three_sigma: 3.0 * (squares / (n - 1.0).max(1.0)).sqrt(),
        }
    }
}

pub(crate) fn run(arguments: &Measure) -> Result<Outcome, Failure> {
    let mut found = Machine::find(&arguments.spec)?;
    found.change(&arguments.changes.read(&found.spec)?);
    let map = Map::find(&arguments.map, &found.spec)?;
    let mut data = Data::read(&arguments.data, &map)?;
    let interpreter = Interpreter::new(found.spec.clone());
    let setup = Setup::new(&interpreter, &map, &data, 0)?;
    check_readings(&setup, &map, &data)?;
    let errors = Errors::of(&setup, &mut data)?;
    let unit = found.spec.length.symbol();
    let along = |axis: usize| errors.rows.iter().map(|row| row[axis]).collect::<Vec<_>>();
    let mut sizes: Vec<Size> =
        ["x", "y", "z"].into_iter().enumerate().map(|(i, name)| Size::of(name, unit, &along(i))).collect();
    sizes.push(Size::of("norm", unit, &errors.norms()));
    if errors.turns {
        let names = ["about x", "about y", "about z"].into_iter().enumerate();
        sizes.extend(names.map(|(i, name)| Size::of(name, "rad", &along(3 + i))));
    }
    let report = Report {
        name: found.spec.name.clone(),
        length: unit,
        title: map.title.clone(),
        rows: errors.rows.len(),
        errors: sizes,
        explained: explained::of(&setup, &map, &data, &errors)?,
        repeated: repeated::of(&data, &errors),
        unusable: data.unusable.len(),
    };
    if let Some(folder) = &arguments.out {
        std::fs::create_dir_all(folder).map_err(|error| cannot_write(folder, &error))?;
        write(&folder.join("errors.csv"), &errors.csv(&data))?;
        write(&folder.join("report.html"), &page::page(&found.spec, &report, &errors, &data))?;
    }
    let text = if arguments.json { json(&report)? } else { text::of(&found.spec, &map, &data, &report) };
    Ok(Outcome::passed(text))
}

impl Errors {
    /// ΔX row by row.
    fn csv(&self, data: &Data) -> String {
        let names = ["line", "x", "y", "z", "about_x", "about_y", "about_z"];
        let names = &names[..if self.turns { 7 } else { 4 }];
        let heading: Vec<String> = names.iter().map(|name| (*name).to_owned()).collect();
        let rows = self.rows.iter().zip(&data.lines).map(|(row, line)| {
            let values = row[..names.len() - 1].iter().map(|value| Some(*value));
            std::iter::once(Some(*line as f64)).chain(values).collect()
        });
        csv(&heading, &rows.collect::<Vec<_>>())
    }
}
