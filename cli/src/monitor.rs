//! `abbe monitor`: control charts of repeated checks of a machine.

use std::path::PathBuf;

use abbe_metrology::data::Map;
use abbe_metrology::monitor::options::FALSE_ALARM;
use abbe_metrology::monitor::{self, Checks, Settings};
use abbe_report::views;
use clap::{Args, ValueHint};

use crate::arguments::{Common, Page, Subject, length, whole};
use crate::{Console, Outcome, Outputs, Result};

#[derive(Args, Debug)]
#[command(after_help = after_help!(
    "  abbe monitor ur5 monday.csv tuesday.csv wednesday.csv --map ur5
  abbe monitor ur5 monday.csv tuesday.csv --map ur5 --tolerance 0.2mm --check
", "with --check: there is an alarm"))]
pub(crate) struct Monitor {
    #[command(flatten)]
    subject: Subject,
    /// Checks in chronological order: CSV files with the same few configurations each, or one file
    /// with a date column
    #[arg(required = true, value_hint = ValueHint::FilePath)]
    data: Vec<PathBuf>,
    /// Map (TOML) that describes the columns, or name of a shipped map
    #[arg(long, value_name = "FILE")]
    map: PathBuf,
    /// Allowed displacement of the tool point since the first check, as a length; the report
    /// predicts the date on which it is reached
    #[arg(long, value_name = "LENGTH", allow_hyphen_values = true)]
    tolerance: Option<String>,
    /// First check to use, by its date: ignore the checks before the machine was serviced or zeroed
    #[arg(long, value_name = "DATE", allow_hyphen_values = true)]
    since: Option<String>,
    /// False-alarm rate: at most one false alarm in this number of checks on average, over all
    /// charts together
    #[arg(long, value_name = "CHECKS", default_value_t = FALSE_ALARM.default, value_parser = whole(FALSE_ALARM.range))]
    false_alarm: usize,
    /// Exit with status 1 if there is an alarm
    #[arg(long)]
    check: bool,
    #[command(flatten)]
    page: Page,
    #[command(flatten)]
    common: Common,
}

pub(crate) fn run(arguments: &Monitor) -> Result<Outcome> {
    arguments.common.running.start()?;
    let machine = arguments.subject.machine()?;
    let mut map = Map::find(&arguments.map, &machine.spec)?;
    arguments.page.dated.date(&mut map.record);
    let mut checks = Checks::read(&arguments.data, &map)?;
    if let Some(date) = &arguments.since {
        checks.since("--since", date)?;
    }
    let tolerance =
        arguments.tolerance.as_ref().map(|text| length("--tolerance", text, &machine.spec)).transpose()?;
    let settings =
        Settings { checks_per_false_alarm: arguments.false_alarm as f64, tolerance, ..Settings::default() };
    let job = monitor::Monitor { machine, map, checks, settings };
    let mut outputs = Outputs::new(&job, arguments.common.writing.force);
    let page = outputs.wanted(arguments.page.report.as_deref())?;
    let report = job.run(&mut Console::default())?;
    let document = || views::monitoring(&job.machine.spec, &job.map, &report);
    let page = page.map(|file| {
        let files = arguments.data.iter().map(|file| ("check", file));
        let (map, residuals) = (Some(&job.map), report.residuals.clone());
        file.fill(&document().measured_page(&job.machine, map, files, residuals, &mut Console::default())?)
    });
    let printed = outputs.finish(page.transpose()?)?;
    let passed = !arguments.check || report.alarm.is_none();
    let next = match &arguments.page.report {
        None => "--report FILE for a page with the charts, --full for all charts",
        Some(_) => "--full for all charts",
    };
    let text = arguments.common.showing.answer(&report, document(), next)?;
    Ok(Outcome::checked(text, passed).beside(printed))
}
