//! `abbe import`: converts descriptions of robots in other formats to specs.

use std::path::PathBuf;

use abbe_report::text;
use abbe_spec::DhConvention;
use abbe_study::import::{self, Format, Units};
use abbe_study::options::CONVENTIONS;
use clap::{Args, ValueHint};

use crate::arguments::{Writing, named};
use crate::output::{Outcome, Outputs, json};
use crate::{Console, Result};

#[derive(Args, Debug)]
#[command(after_help = after_help!(
    "  abbe import robot.urdf --base base_link --tip tool0 -o robot.toml
  abbe import robot.urdf --tip tool0 --fold --round-angles
  abbe import dh.csv --dh standard --units mm,deg -o dh.toml
"))]
pub(crate) struct Import {
    /// URDF file (expand xacro files first: `xacro robot.urdf.xacro > robot.urdf`). With --dh: a
    /// table of Denavit-Hartenberg parameters, as CSV or as the Robotics Toolbox prints it
    #[arg(value_hint = ValueHint::FilePath)]
    file: PathBuf,
    /// Link whose frame is F_0. [default: the root link]
    #[arg(long, value_name = "LINK", conflicts_with = "dh")]
    base: Option<String>,
    /// Link whose frame is the tool point. [default: the last link, if there is only one]
    #[arg(long, value_name = "LINK", conflicts_with = "dh")]
    tip: Option<String>,
    /// Merge fixed joints into the frames that follow them, and trailing ones into the tool; by
    /// default each fixed joint is a frame with errors of its own
    #[arg(long, conflicts_with = "dh")]
    fold: bool,
    /// Read a table with the columns theta, d, a and alpha of this convention: standard is
    /// Rz(theta) Tz(d) Tx(a) Rx(alpha), modified (Craig) is Rx(alpha) Tx(a) Rz(theta) Tz(d)
    #[arg(long, value_name = "CONVENTION", value_parser = named(CONVENTIONS))]
    dh: Option<DhConvention>,
    /// Units of the table if its header names none: `mm,deg` or `m,rad`, for example
    #[arg(long, value_name = "UNITS", requires = "dh")]
    units: Option<Units>,
    /// Round angles within 1e-5 rad of a multiple of 45° to that multiple
    #[arg(long)]
    round_angles: bool,
    /// Write the spec to this file instead of stdout
    #[arg(long, short, value_name = "SPEC")]
    out: Option<PathBuf>,
    #[command(flatten)]
    writing: Writing,
    /// Print the report as JSON
    #[arg(long, display_order = 111)]
    json: bool,
}

pub(crate) fn run(arguments: &Import) -> Result<Outcome> {
    let Import { file, base, tip, out, .. } = arguments;
    let format = match arguments.dh {
        None => Format::Urdf { base: base.clone(), tip: tip.clone(), fold: arguments.fold },
        Some(convention) => Format::Table { convention, units: arguments.units.unwrap_or_default() },
    };
    let job = import::Import { file: file.clone(), format, round_angles: arguments.round_angles };
    let mut outputs = Outputs::new(&job, arguments.writing.force);
    let wanted = outputs.wanted(out.as_deref())?;
    let report = job.run(&mut Console::default())?;
    let printed = outputs.finish(wanted.map(|file| file.fill(&report.spec)).transpose()?)?;
    let text = match out {
        _ if arguments.json => json(&report)?,
        Some(_) => text::imported(&report),
        None => report.spec,
    };
    Ok(Outcome::passed(text).beside(printed))
}
