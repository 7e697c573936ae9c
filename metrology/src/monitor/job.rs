//! Monitoring job: measurements, single errors, charts, and the change found.

use abbe_interpreter::Interpreter;
use abbe_spec::diagnostic::Diagnostics;

use super::charts::{Chart, Limit, charts};
use super::check_values::CheckValues;
use super::checks::Checks;
use super::finding::finding;
use super::options::Settings;
use super::report::{Alarm, Report};
use super::single_errors::SingleErrors;
use crate::data::Map;
use abbe_study::{Machine, Notes, finite, number};

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
    pub fn run(&self, notes: &mut dyn Notes) -> Result<Report, Diagnostics> {
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
