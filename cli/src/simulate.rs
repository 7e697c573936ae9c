//! `abbe simulate`: simulates measurements of a machine with the errors of its spec.

use std::io;
use std::path::{Path, PathBuf};

use abbe_metrology::data::{Csv, Data, Map};
use abbe_metrology::simulate::options::{OUTLIERS, SAMPLES};
use abbe_metrology::simulate::{self, Places};
use clap::{Args, ValueHint};

use crate::arguments::{Running, Subject, Writing, length, share, whole};
use crate::output::{Outcome, Outputs, cannot_write, json};
use crate::{Console, Result};

#[derive(Args, Debug)]
#[command(after_help = after_help!(
    "  abbe simulate ur5 plan.csv --map ur5 --out data.csv
  abbe simulate ur5 --map ur5 --samples 200 --noise 0.02mm --seed 1 --out test.csv
"))]
pub(crate) struct Simulate {
    #[command(flatten)]
    subject: Subject,
    /// Configurations: a CSV file with the joint and input columns of the map. [default: random
    /// configurations within the limits]
    #[arg(value_hint = ValueHint::FilePath)]
    data: Option<PathBuf>,
    /// Map (TOML) that describes the columns to write, or name of a shipped map
    #[arg(long, value_name = "FILE")]
    map: PathBuf,
    /// Number of random configurations
    #[arg(long, value_name = "N", default_value_t = SAMPLES.default, conflicts_with = "data", value_parser = whole(SAMPLES.range))]
    samples: usize,
    /// Standard deviation of the noise of each coordinate: `0.04mm`. [default: the uncertainty in
    /// the map]
    #[arg(long, value_name = "LENGTH", allow_hyphen_values = true)]
    noise: Option<String>,
    /// Fraction of the rows that are outliers, from 0 to 1
    #[arg(long, value_name = "SHARE", default_value_t = OUTLIERS.default, value_parser = share)]
    outliers: f64,
    /// Also draw the random sources of the spec, anew in every row, and its tolerances, once
    #[arg(long)]
    random: bool,
    /// Seed of the configurations, noise, outliers and random sources
    #[arg(long, value_name = "S", default_value_t = 0)]
    seed: u64,
    /// Write to this file instead of stdout
    #[arg(long, short, value_name = "FILE")]
    out: Option<PathBuf>,
    #[command(flatten)]
    writing: Writing,
    #[command(flatten)]
    running: Running,
    /// Print the report as JSON
    #[arg(long, display_order = 111)]
    json: bool,
}

pub(crate) fn run(arguments: &Simulate) -> Result<Outcome> {
    arguments.running.start()?;
    let machine = arguments.subject.machine()?;
    let map = Map::find(&arguments.map, &machine.spec)?;
    let noise = arguments.noise.as_ref().map(|text| length("--noise", text, &machine.spec)).transpose()?;
    let at = match &arguments.data {
        Some(file) => Places::Rows(Data::read_commanded(file, &map)?),
        None => Places::Samples(arguments.samples),
    };
    let job = simulate::Simulate {
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
    if arguments.json {
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
