//! `abbe doctor`: finds the conventions of rows of joints and poses.

use std::path::{Path, PathBuf};

use abbe_metrology::{data::Source, doctor};
use abbe_report::views;
use abbe_spec::expr::Dimension;
use abbe_study::{Notes, options::quantity};
use clap::{Args, ValueHint};

use crate::arguments::{Showing, Subject, Writing};
use crate::{Console, Outcome, Outputs, Result};

#[derive(Args, Debug)]
#[command(after_help = after_help!(
    "  abbe doctor ur5 pendant.csv
  abbe doctor ur5 pendant.csv --within 5mm -o pendant.toml
  abbe doctor ur5 pendant.csv -o pendant.toml --corrected corrected.toml
", "no interpretation of the data fits"))]
pub(crate) struct Doctor {
    #[command(flatten)]
    subject: Subject,
    /// CSV file of about ten rows: one column per joint, then x, y, z and, optionally, an
    /// orientation (three angles, a quaternion, a 3×3 matrix of nine columns, or a homogeneous
    /// matrix of twelve or sixteen). Joint columns are found by name; otherwise they are the first
    /// columns
    #[arg(value_hint = ValueHint::FilePath)]
    data: PathBuf,
    /// Largest position residual of an interpretation that fits, as a length. [default: 2 % of the
    /// spread of the positions]
    #[arg(long, value_name = "LENGTH")]
    within: Option<String>,
    /// Write the map of the best interpretation to this file
    #[arg(long, short, value_name = "MAP")]
    out: Option<PathBuf>,
    /// Write a corrected spec to this file if the best interpretation needs one: another
    /// convention, a joint coupling, a base or a tool
    #[arg(long, value_name = "SPEC")]
    corrected: Option<PathBuf>,
    #[command(flatten)]
    writing: Writing,
    #[command(flatten)]
    showing: Showing,
}

pub(crate) fn run(arguments: &Doctor) -> Result<Outcome> {
    let machine = arguments.subject.machine()?;
    let length =
        |text: &String| quantity("--within", text, machine.spec.length, Dimension::LENGTH, "`--within`");
    let within = arguments.within.as_ref().map(length).transpose()?;
    let job = doctor::Doctor { machine, data: Source::File(&arguments.data), within };
    let mut outputs = Outputs::new(&job, arguments.writing.force);
    let [map, spec] = [&arguments.out, &arguments.corrected].map(Option::as_deref);
    let wanted = [outputs.wanted(map)?, outputs.wanted(spec)?];
    let report = job.run(&mut Console::default())?;
    let corrected = |file: &Path| {
        report.corrected(&job.machine.spec, &job.machine.text_for(file)?, &file.display().to_string())
    };
    let corrected = spec.map(corrected).transpose()?.flatten();
    let none = match report.fits {
        false => ["no interpretation fits: no file was written, existing files are unchanged"; 2],
        true => [
            "",
            "no spec was written: the interpretation needs no change of the spec, or one that \
             cannot be made in its text; an existing file is unchanged",
        ],
    };
    let mut written = Vec::new();
    for ((file, text), none) in wanted.into_iter().zip([&report.map, &corrected]).zip(none) {
        match (file, text) {
            (Some(file), Some(text)) => written.push(file.fill(text)?),
            (Some(_), None) => Console::default().note(none),
            (None, _) => {}
        }
    }
    let printed = outputs.finish(written)?;
    let next = match (&arguments.out, report.fits) {
        (None, true) => "--out MAP writes the map, --full for all interpretations",
        _ => "--full for all interpretations",
    };
    let text = arguments.showing.answer(&report, views::doctor(&report), next)?;
    Ok(Outcome::checked(text, report.fits).beside(printed))
}
