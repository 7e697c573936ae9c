//! `abbe positioning`: evaluates runs of an axis by ISO 230-2, of body diagonals by ISO 230-6, or
//! of circles by ISO 230-4.

use std::path::PathBuf;

use abbe_metrology::positioning;
use abbe_report::views;
use abbe_study::RunRecord;
use clap::{Args, ValueHint};

use crate::arguments::{Page, Showing, Writing};
use crate::{Console, Failure, Outcome, Outputs, Result};

#[derive(Args, Debug)]
#[command(after_help = after_help!(
    "  abbe positioning x-axis.csv --reading-uncertainty 0.1um --scale-uncertainty 1um/m
  abbe positioning x-axis.csv --out exx.csv
  abbe positioning x-axis.csv --accept \"A 12um, B 3um\" --report x-axis.html
  abbe positioning diagonals.csv
  abbe positioning ballbar.csv --accept \"G 10um, H 3um\"
", "a characteristic is not within its limit by its uncertainty"))]
pub(crate) struct Positioning {
    /// Runs: a CSV file with columns `position (mm)`, `direction` (`+` or `-`) and `deviation
    /// (um)`, or `actual (mm)`; or with one column for each pass, `1+ (um)`, `1- (um)`, …
    ///
    /// A column `diagonal` names the body diagonal of each row, and the runs are evaluated by
    /// ISO 230-6.
    ///
    /// A column `angle (deg)` instead of `position` has a circular test, of a ballbar or a
    /// spindle, whose `deviation (um)` is that of the radius; `+` is counterclockwise. It is
    /// evaluated by ISO 230-4, and by ISO 230-7 if angles have several readings.
    #[arg(value_hint = ValueHint::FilePath)]
    data: PathBuf,
    /// Standard uncertainty of one reading of the instrument: `0.1um`, `0.05arcsec`
    #[arg(long, value_name = "VALUE")]
    reading_uncertainty: Option<String>,
    /// Standard uncertainty of the scale of the instrument, with that of the temperature: `1um/m`
    #[arg(long, value_name = "VALUE")]
    scale_uncertainty: Option<String>,
    /// Accept the axis if its characteristics are within these limits by at least their
    /// uncertainty: "A 12um, B 3um"; they are those of both directions if the runs have both
    #[arg(long, value_name = "LIMITS")]
    accept: Option<String>,
    /// Write the mean deviations at the positions to this CSV file, for a table of a spec
    #[arg(long, short, value_name = "FILE", value_hint = ValueHint::FilePath)]
    out: Option<PathBuf>,
    #[command(flatten)]
    page: Page,
    #[command(flatten)]
    writing: Writing,
    #[command(flatten)]
    showing: Showing,
}

pub(crate) fn run(arguments: &Positioning) -> Result<Outcome> {
    let Positioning { data, reading_uncertainty, scale_uncertainty, accept, out, page, writing, showing } =
        arguments;
    let job = positioning::Positioning {
        data: data.into(),
        reading: reading_uncertainty.clone(),
        scale: scale_uncertainty.clone(),
        accept: accept.clone(),
    };
    let mut outputs = Outputs::new(&job, writing.force);
    let file = outputs.wanted(out.as_deref())?;
    let html = outputs.wanted(page.report.as_deref())?;
    let report = job.run(&mut Console::default())?;
    let next = match file.is_none() && report.table().is_some() {
        true => "--out FILE writes the mean deviations for a table of a spec, --full shows every position",
        false => "--full for every position",
    };
    let document = views::positioning(&report);
    let mut record = RunRecord::default();
    page.dated.date(&mut record);
    let html = html.map(|file| file.fill(&document.page_of_data("runs", job.data, record)?)).transpose()?;
    let text = showing.answer(&report, document, next)?;
    let table = match (file, report.table()) {
        (None, _) => None,
        (Some(file), Some(table)) => Some(file.fill(&table.csv())?),
        (Some(_), None) => {
            let message = "the deviations of diagonals and circles are not a table of one axis";
            return Err(Failure::new("--out", message).help("leave `--out` out"));
        }
    };
    let printed = outputs.finish(table.into_iter().chain(html))?;
    let is_accepted = report.accepted.as_ref().is_none_or(|verdict| verdict.is_met());
    Ok(Outcome::checked(text, is_accepted).beside(printed))
}
