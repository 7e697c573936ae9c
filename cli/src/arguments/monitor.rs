use std::path::PathBuf;

use abbe_metrology::monitor::options::FALSE_ALARM;
use clap::{Args, ValueHint};

use super::shared::{Page, Running, Showing, Subject, Writing};
use super::values::whole;

#[derive(Args, Debug)]
#[command(after_help = after_help!(
    "  abbe monitor ur5 monday.csv tuesday.csv wednesday.csv --map ur5
  abbe monitor ur5 monday.csv tuesday.csv --map ur5 --tolerance 0.2mm --check
", "with --check: there is an alarm"))]
pub(crate) struct Monitor {
    #[command(flatten)]
    pub(crate) subject: Subject,
    /// Checks in chronological order: CSV files with the same few configurations each, or one file
    /// with a date column
    #[arg(required = true, value_hint = ValueHint::FilePath)]
    pub(crate) data: Vec<PathBuf>,
    /// Map (TOML) that describes the columns, or name of a shipped map
    #[arg(long, value_name = "FILE")]
    pub(crate) map: PathBuf,
    /// Allowed displacement of the tool point since the first check, as a length; the report
    /// predicts the date on which it is reached
    #[arg(long, value_name = "LENGTH", allow_hyphen_values = true)]
    pub(crate) tolerance: Option<String>,
    /// First check to use, by its date: ignore the checks before the machine was serviced or zeroed
    #[arg(long, value_name = "DATE", allow_hyphen_values = true)]
    pub(crate) since: Option<String>,
    /// False-alarm rate: at most one false alarm in this number of checks on average, over all
    /// charts together
    #[arg(long, value_name = "CHECKS", default_value_t = FALSE_ALARM.default, value_parser = whole(FALSE_ALARM.range))]
    pub(crate) false_alarm: usize,
    /// Exit with status 1 if there is an alarm
    #[arg(long)]
    pub(crate) check: bool,
    #[command(flatten)]
    pub(crate) page: Page,
    #[command(flatten)]
    pub(crate) writing: Writing,
    #[command(flatten)]
    pub(crate) showing: Showing,
    #[command(flatten)]
    pub(crate) running: Running,
}
