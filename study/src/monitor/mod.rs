//! Whether a machine that is checked again and again is still what it was.
//!
//! `checks` are the files in the order of their dates; `places` the configurations that they visit; `numbers` what is measured at
//! every check, and how it moves; `single_errors`
//! what may have changed; `charts` watch each of these, with one rate of false alarms for all; `finding` says what has changed, since
//! when and how fast; `sentences` say it in words.

mod charts;
mod checks;
mod finding;
mod numbers;
mod places;
mod sentences;
mod single_errors;

use abbe_interpreter::Interpreter;
use abbe_spec::diagnostic::Diagnostics;
use serde::Serialize;

use crate::data::{Calendar, Map, Summary};
use crate::{Machine, Notes, finite};

pub use charts::{Chart, Limit};
pub use checks::{Check, Checks};
pub use finding::{Finding, Leaving};

use numbers::Numbers;
use single_errors::SingleErrors;

/// Is this machine still what it was?
pub struct Monitor {
    /// The machine as its spec has it: with the errors that were identified, if they were.
    pub machine: Machine,
    /// What the columns of the data are.
    pub map: Map,
    /// The checks.
    pub checks: Checks,
    /// How it is watched.
    pub settings: Settings,
}

/// How a machine is watched.
#[derive(Clone, Copy, Debug)]
pub struct Settings {
    /// On average one false alarm in so many checks, at most, over all charts together.
    pub checks_per_false_alarm: f64,
    /// The weight of a new check in a moving average.
    pub lambda: f64,
    /// How far the tool point may move from where it was at first. The length unit.
    pub tolerance: Option<f64>,
}

impl Default for Settings {
    fn default() -> Self {
        Self { checks_per_false_alarm: 365.0, lambda: 0.2, tolerance: None }
    }
}

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

impl Monitor {
    /// Watches from the first check to the last.
    pub fn run(&self, notes: &mut dyn Notes) -> Result<Report, Diagnostics> {
        let Self { machine, map, checks, settings } = self;
        let spec = &machine.spec;
        let interpreter = Interpreter::new(spec.clone());
        let checks = &checks.completed(map, &interpreter, spec);
        let (numbers, model) = Numbers::new(&interpreter, map, checks, notes)?;
        let errors = SingleErrors::new(spec, &model, &numbers);
        let limit = Limit::new(settings, errors.charts.len() + 1);
        let (charts, left) = charts::charts(&errors, &numbers, &limit);
        let date = |check: usize| checks.calendar.show(checks.list[check].time);
        let alarm = alarm(&charts, &left, date);
        let found =
            alarm.as_ref().and_then(|_| finding::finding(&errors, &numbers, checks, settings.tolerance));
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
            tolerance: settings.tolerance,
            files: checks.list.iter().map(|check| check.data.summary()).collect(),
        };
        finite("abbe monitor", report)
    }
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

fn alarm(charts: &[Chart], left: &Chart, date: impl Fn(usize) -> String) -> Option<Alarm> {
    let all = || charts.iter().chain([left]);
    let check = all().filter_map(|chart| chart.alarm).min()?;
    let here = all().filter(|chart| chart.alarm == Some(check));
    let farthest = here.max_by(|a, b| a.average[check].abs().total_cmp(&b.average[check].abs()))?;
    Some(Alarm { check, date: date(check), chart: farthest.name.clone() })
}
