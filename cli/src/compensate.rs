//! `abbe compensate`: joint commands that compensate the errors of the machine.

use std::io;
use std::path::{Path, PathBuf};

use abbe_metrology::compensate::options::TOLERANCE;
use abbe_metrology::compensate::program::{Program, read_frame};
use abbe_metrology::compensate::{self, Report, check_poses};
use abbe_metrology::data::{Csv, Data, Map};
use abbe_report::views;
use abbe_spec::Spec;
use clap::{Args, ValueHint};

use crate::arguments::{Common, Page, Subject, length};
use crate::output::{Outcome, Outputs, cannot_write};
use crate::{Console, Failure, Result};

#[derive(Args, Debug)]
#[command(after_help = after_help!(
    "  abbe compensate found.toml plan.csv --map found.map.toml --out commands.csv
  abbe compensate found.toml plan.csv --map found.map.toml --tolerance 0.01mm --json
  abbe compensate found.toml part.mod --frame \"Tx(500) Rz(90deg)\" -o corrected.mod
", "some rows are not compensated within the tolerance"))]
pub(crate) struct Compensate {
    #[command(flatten)]
    subject: Subject,
    /// Joint commands: a CSV file with the joint and input columns of the map; or the program of a
    /// robot (RAPID, KRL, TP as `.ls`, URScript, Mecademic), whose positions are corrected
    #[arg(value_hint = ValueHint::FilePath)]
    data: PathBuf,
    /// Pose in F_0 of the frame in which a program has its positions (work object, user frame,
    /// $BASE), such as "Tx(500) Rz(90deg)". [default: F_0]
    #[arg(long, value_name = "TRANSFORM", allow_hyphen_values = true, conflicts_with = "poses")]
    frame: Option<String>,
    /// Map (TOML) that describes the columns, or name of a shipped map. [default: columns named as
    /// the variables and inputs of the spec, in its length unit and in rad]
    #[arg(long, value_name = "FILE")]
    map: Option<PathBuf>,
    /// Compensate the poses in the map's `[pose]` columns instead of the joint commands; the joints
    /// of each row are the start of the iteration
    #[arg(long, requires = "map")]
    poses: bool,
    /// Largest error allowed to remain at the tool point, as a length; for orientations, 1 rad
    /// counts as 1 m
    #[arg(long, value_name = "LENGTH", default_value = TOLERANCE, allow_hyphen_values = true)]
    tolerance: String,
    /// Length that weighs as much as 1 rad of the orientation where both cannot be reached, such as
    /// 1m. [default: the position has priority]
    #[arg(long, value_name = "LENGTH")]
    weight: Option<String>,
    /// Write the corrected commands and their remaining errors to this CSV file; of a program, the
    /// corrected program
    #[arg(long, short, value_name = "FILE")]
    out: Option<PathBuf>,
    #[command(flatten)]
    page: Page,
    #[command(flatten)]
    common: Common,
}

pub(crate) fn run(arguments: &Compensate) -> Result<Outcome> {
    arguments.common.running.start()?;
    let machine = arguments.subject.machine()?;
    let program = Program::read(&arguments.data)?;
    if arguments.frame.is_some() && program.is_none() {
        let message = "only a program has its positions in a frame";
        return Err(Failure::new("--frame", message).help("leave `--frame` out, or give a program"));
    }
    let frame = arguments.frame.as_ref().map(|text| read_frame(text, machine.spec.length)).transpose()?;
    let mut map = match (&program, &arguments.map) {
        (Some(program), None) => program.map(&machine.spec),
        _ => map(arguments, &machine.spec)?,
    };
    arguments.page.dated.date(&mut map.record);
    let tolerance = length("--tolerance", &arguments.tolerance, &machine.spec)?;
    let weight = arguments.weight.as_ref().map(|text| length("--weight", text, &machine.spec)).transpose()?;
    let mut console = Console::default();
    let evaluator = machine.evaluator(true);
    let data = match &program {
        Some(program) => {
            program.commands((&*evaluator, &machine.spec), &map, frame.as_ref(), &mut console)?
        }
        None if arguments.poses => Data::read_wanted(&arguments.data, &map)?,
        None => Data::read_commanded(&arguments.data, &map)?,
    };
    let job = compensate::Compensate { machine, map, data, poses: arguments.poses, tolerance, weight };
    let mut outputs = Outputs::new(&job, arguments.common.writing.force);
    let out = arguments.out.as_deref();
    let failed = |error: io::Error| cannot_write(out.unwrap_or(Path::new("-")), &error);
    let mut written = outputs.wanted(out)?;
    let commands = written.take_if(|_| program.is_none()).map(|file| Csv::new(file, &job.heading()));
    let mut commands = commands.transpose().map_err(failed)?;
    let page = outputs.wanted(arguments.page.report.as_deref())?;
    let mut rows = Vec::new();
    // JSON, figures and programs need all rows at once; a file of commands is written row by row.
    let keep = arguments.common.showing.json || page.is_some() || program.is_some();
    let report = job.for_each_row(&mut console, |row| {
        if let Some(csv) = &mut commands {
            csv.row(job.label(&row), &row.numbers(&job.map)).map_err(failed)?;
        }
        if keep {
            rows.push(row);
        }
        Ok::<_, Failure>(())
    })?;
    let report = Report { rows, ..report };
    let commands = match (&program, written) {
        (Some(program), Some(file)) => {
            let text = program.corrected(&report.rows, &*evaluator, &job.map, frame.as_ref())?;
            Some(file.fill(&text)?)
        }
        _ => commands.map(Csv::finish).transpose().map_err(failed)?,
    };
    let document = || views::compensation(&job.machine.spec, evaluator.description(), &job.map, &report);
    let page = page.map(|file| {
        let map = arguments.map.as_ref().map(|_| &job.map);
        let (files, residuals) = ([("commands", &arguments.data)], report.residuals());
        file.fill(&document().measured_page(&job.machine, map, files, residuals, &mut Console::default())?)
    });
    let printed = outputs.finish(commands.into_iter().chain(page.transpose()?))?;
    let next = match out {
        None => "--out FILE writes the corrected commands, --full shows the first of them",
        Some(_) => "--full shows the first corrected commands",
    };
    let is_json = arguments.common.showing.json;
    let mut text = arguments.common.showing.answer(&report, document(), next)?;
    if let (Some(file), false) = (out, is_json) {
        text += &format!("\n{}: {} rows\n", file.display(), report.row_summary.rows);
    }
    Ok(Outcome::checked(text, report.complete()).beside(printed))
}

/// Reads the given map, or makes one from the names of the spec.
fn map(arguments: &Compensate, spec: &Spec) -> Result<Map> {
    let Some(file) = &arguments.map else {
        return Ok(Map::from_names(&Data::heading(&arguments.data)?, spec));
    };
    let map = Map::find(file, spec)?;
    if arguments.poses {
        check_poses(&map)?;
    }
    Ok(map)
}
