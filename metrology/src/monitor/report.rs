//! Report of monitoring.

use serde::Serialize;

use super::charts::{Chart, Limit};
use super::finding::Finding;
use crate::data::Summary;
use abbe_study::date::Calendar;
use abbe_study::{Residuals, RunRecord};

/// Result of monitoring: charts, alarm and the change found.
#[derive(Clone, Debug, Serialize)]
pub struct Report {
    /// Name of the machine.
    pub name: String,
    /// Length unit of all lengths.
    pub length: &'static str,
    /// Title of the map.
    pub title: String,
    /// Calendar of the times.
    pub calendar: Calendar,
    /// Time of every check, as counted by the calendar.
    pub times: Vec<f64>,
    /// Dates of the checks.
    pub dates: Vec<String>,
    /// Number of configurations common to all checks.
    pub configurations: usize,
    /// Number of configurations that are not in all checks and therefore unused.
    pub left_out: usize,
    /// Number of independent values per check once the station is known.
    pub numbers: usize,
    /// Is true if the instrument stays in place between checks; otherwise its pose is unknown at
    /// each check.
    pub fixed_station: bool,
    /// Control limit of the charts.
    pub limit: Limit,
    /// Charts of the errors, one per group of indistinguishable errors.
    pub charts: Vec<Chart>,
    /// Chart of the distance of each check from the checks before it, whatever the cause.
    pub left: Chart,
    /// Errors that are indistinguishable from a displacement of the instrument.
    pub unseen: Vec<String>,
    /// First alarm, if there is one.
    pub alarm: Option<Alarm>,
    /// Change found, if there is an alarm.
    pub finding: Option<Finding>,
    /// Permitted displacement of the tool point, in the length unit; none if not given.
    pub tolerance: Option<f64>,
    /// Stated date, persons and instruments, and the version of abbe; absent if nothing is stated.
    #[serde(skip_serializing_if = "RunRecord::is_empty")]
    pub record: RunRecord,
    /// Measured minus predicted points of the first and the last check; none for instruments that
    /// measure no points.
    #[serde(skip)]
    pub residuals: Option<Residuals>,
    /// Files of the checks.
    #[serde(skip)]
    pub files: Vec<Summary>,
}

/// First check at which a chart exceeds its limit.
#[derive(Clone, Debug, Serialize)]
pub struct Alarm {
    /// Index of the check, from 0.
    pub check: usize,
    /// Date of the check.
    pub date: String,
    /// Name of the chart that is farthest beyond its limit.
    pub chart: String,
}

impl Report {
    /// Returns the charts of the errors: those with an alarm first, each group by descending
    /// distance from zero.
    pub fn nearest_first(&self) -> Vec<&Chart> {
        let mut charts: Vec<&Chart> = self.charts.iter().collect();
        let now = |chart: &Chart| chart.share(self.dates.len().saturating_sub(1));
        charts.sort_by(|a, b| now(b).total_cmp(&now(a)));
        charts.sort_by_key(|chart| chart.alarm.is_none());
        charts
    }
}
