//! What comes out.

use serde::Serialize;

use super::charts::{Chart, Limit};
use super::finding::Finding;
use crate::data::{Calendar, Summary};

/// What the checks say.
#[derive(Clone, Debug, Serialize)]
pub struct Report {
    /// The machine's name.
    pub name: String,
    /// The length unit of everything.
    pub length: &'static str,
    /// What the map is called.
    pub title: String,
    /// What times count.
    pub calendar: Calendar,
    /// The time of every check.
    pub times: Vec<f64>,
    /// The same as dates.
    pub dates: Vec<String>,
    /// How many configurations every check has.
    pub configurations: usize,
    /// How many more single checks have, which are not used.
    pub left_out: usize,
    /// How many numbers of a check are left when the station is known.
    pub numbers: usize,
    /// Whether the instrument stays where it is; else its place is unknown at every check.
    pub fixed_station: bool,
    /// Where charts alarm.
    pub limit: Limit,
    /// A chart for every error, those that cannot be told apart together.
    pub charts: Vec<Chart>,
    /// The chart of what differs from the checks before, whatever error it comes from.
    pub left: Chart,
    /// Errors that cannot be told from where the instrument stands.
    pub unseen: Vec<String>,
    /// The first alarm, if there is one.
    pub alarm: Option<Alarm>,
    /// What has changed, if there is an alarm.
    pub finding: Option<Finding>,
    /// The tolerance.
    pub tolerance: Option<f64>,
    /// The files.
    #[serde(skip)]
    pub files: Vec<Summary>,
}

/// The first check at which a chart was beyond its limit.
#[derive(Clone, Debug, Serialize)]
pub struct Alarm {
    /// Which, from 0.
    pub check: usize,
    /// When.
    pub date: String,
    /// The chart that was farthest beyond.
    pub chart: String,
}

impl Report {
    /// The charts of the errors: those that were beyond their limits, then all others, each the farthest from zero first.
    pub fn nearest_first(&self) -> Vec<&Chart> {
        let mut charts: Vec<&Chart> = self.charts.iter().collect();
        let now = |chart: &Chart| chart.average.last().map_or(0.0, |share| share.abs());
        charts.sort_by(|a, b| now(b).total_cmp(&now(a)));
        charts.sort_by_key(|chart| chart.alarm.is_none());
        charts
    }
}
