//! Monitoring job: measurements, single errors, charts, and the change found.
//!
//! Report of monitoring.

use abbe_interpreter::Interpreter;
use abbe_study::{Machine, Notes, Residuals, Result, RunRecord, date::Calendar, finite, number};
use serde::Serialize;

use super::charts::{Chart, Limit, charts};
use super::check_values::CheckValues;
use super::finding::{Finding, finding};
use super::single_errors::SingleErrors;
use super::{Checks, Settings};
use crate::data::{Map, Summary};

/// Monitoring of a machine by repeated checks.
pub struct Monitor {
    /// Machine with the errors in its spec, identified ones included.
    pub machine: Machine,
    /// Meaning of the columns of the data.
    pub map: Map,
    /// Checks to evaluate.
    pub checks: Checks,
    /// Settings of the charts.
    pub settings: Settings,
}

impl Monitor {
    /// Returns the options that the figures depend on.
    fn options(&self) -> Vec<(&'static str, String)> {
        let Self { machine, map: _, checks, settings } = self;
        let Settings { checks_per_false_alarm, lambda: _, tolerance } = settings;
        let tolerance = tolerance.map(|tolerance| number::length(tolerance, machine.spec.length));
        machine.options_with([
            ("since", checks.since.clone().unwrap_or_default()),
            ("false-alarm", number::short(*checks_per_false_alarm)),
            ("tolerance", tolerance.unwrap_or_default()),
        ])
    }

    /// Evaluates all checks in chronological order.
    pub fn run(&self, notes: &mut dyn Notes) -> Result<Report> {
        let Self { machine, map, checks, settings } = self;
        let spec = &machine.spec;
        let interpreter = Interpreter::new(spec.clone());
        let checks = &checks.completed(map, &interpreter)?;
        let (numbers, model) = CheckValues::new(&interpreter, map, checks, notes)?;
        let errors = SingleErrors::new(spec, &model, &numbers);
        let limit = Limit::new(settings, errors.charts.len());
        let (charts, left) = charts(&errors, &numbers, &limit);
        let date = |check: usize| checks.calendar.show(checks.list[check].time);
        let alarm = alarm(&charts, &left, date);
        let tolerance = settings.tolerance.or(map.accept.largest_error());
        let found = alarm.as_ref().and_then(|_| finding(&errors, &numbers, checks, tolerance));
        let report = Report {
            name: spec.name.clone(),
            length: spec.length.symbol(),
            title: map.title.clone(),
            calendar: checks.calendar,
            times: checks.list.iter().map(|check| check.time).collect(),
            dates: (0..checks.list.len()).map(date).collect(),
            configurations: numbers.configurations,
            left_out: numbers.left_out,
            numbers: numbers.free(),
            fixed_station: numbers.fixed_station,
            limit,
            charts,
            left,
            unseen: errors.unseen,
            finding: found,
            alarm,
            tolerance,
            residuals: numbers.residuals,
            record: map.record.with_options(self.options()),
            files: checks.list.iter().map(|check| check.data.summary()).collect(),
        };
        finite("abbe monitor", report)
    }
}

fn alarm(charts: &[Chart], left: &Chart, date: impl Fn(usize) -> String) -> Option<Alarm> {
    let all = || charts.iter().chain([left]);
    let check = all().filter_map(|chart| chart.alarm).min()?;
    let here = all().filter(|chart| chart.alarm == Some(check));
    let farthest = here.max_by(|a, b| a.share(check).total_cmp(&b.share(check)))?;
    Some(Alarm { check, date: date(check), chart: farthest.name.clone() })
}

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
