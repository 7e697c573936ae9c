//! `abbe measure`: evaluates measurements of a machine.

use std::path::PathBuf;

use abbe_metrology::AcceptanceVerdict;
use abbe_metrology::data::{Data, Map};
use abbe_metrology::measure::{self, Report};
use abbe_report::views;
use abbe_spec::Spec;
use clap::{Args, ValueEnum};

use crate::arguments::{Common, Dated, Measured, Subject};
use crate::{Console, Outcome, Outputs, Result};

#[derive(Args, Debug)]
#[command(after_help = after_help!(
    "  abbe measure ur5 data.csv --map ur5
  abbe measure ur5 data.csv --map ur5 --accept \"mean 0.5 mm\" --out measured
", "--accept, or the map's `accept`, is not met"))]
pub(crate) struct Measure {
    #[command(flatten)]
    subject: Subject,
    #[command(flatten)]
    measured: Measured,
    /// Estimate the station of the instrument from the data instead of taking it from the map:
    /// `new` if the instrument was moved
    #[arg(long, value_enum, value_name = "WHICH")]
    station: Option<Station>,
    /// Judge rows whose commands were corrected by this spec, as with `commands = "corrected"` in the
    /// map
    #[arg(long)]
    corrected: bool,
    /// Acceptance limits on mean, rms, p95 and max of the position error of the machine:
    /// `mean 0.15 mm, max 0.3 mm`. Exit with status 1 if they are not met beyond the uncertainty of
    /// the measurement
    #[arg(long, value_name = "LIMITS")]
    accept: Option<String>,
    /// Write report.html, and errors.csv with ΔX, prediction and residual of every row, into this
    /// folder
    #[arg(long, short, value_name = "DIR")]
    out: Option<PathBuf>,
    #[command(flatten)]
    dated: Dated,
    #[command(flatten)]
    common: Common,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum Station {
    /// The instrument stands at a station that the map does not describe
    New,
}

pub(crate) fn run(arguments: &Measure) -> Result<Outcome> {
    arguments.common.running.start()?;
    let machine = arguments.subject.machine()?;
    let map = Map::find(&arguments.measured.map, &machine.spec)?;
    let mut map = if arguments.station.is_some() { map.newly_stationed() } else { map };
    map.is_corrected |= arguments.corrected;
    arguments.dated.date(&mut map.record);
    let data = Data::read(&arguments.measured.data, &map)?;
    let accept = map.limits("--accept", arguments.accept.as_deref(), &machine.spec)?;
    let job = measure::Measure { machine, map, data, accept };
    let mut outputs = Outputs::new(&job, arguments.common.writing.force);
    let files = match &arguments.out {
        None => None,
        Some(folder) => {
            outputs.folder(folder)?;
            Some((outputs.file(&folder.join("errors.csv"))?, outputs.file(&folder.join(abbe_report::PAGE))?))
        }
    };
    let (spec, map) = (&job.machine.spec.clone(), &job.map.clone());
    let Some((errors, page)) = files else {
        return outcome(arguments, spec, map, &job.figures(&mut Console::default())?);
    };
    let report = job.run(&mut Console::default())?;
    let files = [("measurements", &arguments.measured.data)];
    let (document, residuals) = (views::measurement(spec, map, &report), report.residuals());
    let text = document.measured_page(&job.machine, Some(map), files, residuals, &mut Console::default())?;
    outputs.finish([errors.fill(&report.table().csv())?, page.fill(&text)?])?;
    outcome(arguments, spec, map, &report)
}

fn outcome(arguments: &Measure, spec: &Spec, map: &Map, report: &Report) -> Result<Outcome> {
    let accepted = report.accepted.as_ref().is_none_or(AcceptanceVerdict::is_met);
    let next = match (report.explained.repeatable, &arguments.out) {
        (0, _) => "abbe identify finds the errors of this machine; --full for all figures of ISO 9283",
        (_, None) => "--out DIR for a page and the errors of each row, --full for all figures of ISO 9283",
        _ => "--full for all figures of ISO 9283",
    };
    let text = arguments.common.showing.answer(report, views::measurement(spec, map, report), next)?;
    Ok(Outcome::checked(text, accepted))
}
