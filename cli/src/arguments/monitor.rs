use std::path::PathBuf;

use abbe_study::monitor::options::FALSE_ALARM;
use clap::{Args, ValueHint};

use super::shared::{Page, Running, Subject, Writing};
use super::values::whole;

#[derive(Args, Debug)]
#[command(after_help = after_help!(
    "  abbe monitor ur5 monday.csv tuesday.csv wednesday.csv --map ur5
  abbe monitor ur5 monday.csv tuesday.csv --map ur5 --tolerance 0.2mm --check
", "with --check: there is an alarm"))]
pub(crate) struct Monitor {
    #[command(flatten)]
    pub(crate) subject: Subject,
    /// Checks in the order of their dates: CSV files with the same few configurations each, or one with a column of dates
    #[arg(required = true, value_hint = ValueHint::FilePath)]
    pub(crate) data: Vec<PathBuf>,
    /// What the columns are: a map (TOML), or the name of a shipped one
    #[arg(long, value_name = "FILE")]
    pub(crate) map: PathBuf,
    /// How far the tool point may move from where it was at the first check: when that is used up
    #[arg(long, value_name = "LENGTH", allow_hyphen_values = true)]
    pub(crate) tolerance: Option<String>,
    /// Begin with the check of this date: after the machine was serviced or zeroed
    #[arg(long, value_name = "DATE", allow_hyphen_values = true)]
    pub(crate) since: Option<String>,
    /// On average no more than one false alarm in so many checks, over all charts together
    #[arg(long, value_name = "CHECKS", default_value_t = FALSE_ALARM.default, value_parser = whole(FALSE_ALARM.range))]
    pub(crate) false_alarm: usize,
    /// End with status 1 if there is an alarm
    #[arg(long)]
    pub(crate) check: bool,
    #[command(flatten)]
    pub(crate) page: Page,
    #[command(flatten)]
    pub(crate) writing: Writing,
    #[command(flatten)]
    pub(crate) running: Running,
}
