//! Estimates which error has changed, since when, how fast, and when it exceeds the tolerance.

use abbe::control::{Change, Kind};
use serde::Serialize;

use super::charts::value;
use super::check_values::CheckValues;
use super::checks::Checks;
use super::single_errors::{SingleError, SingleErrors};

/// Largest difference in log-likelihood at which an explanation counts as equally good as the best
/// one; a likelihood ratio of e².
const EQUALLY_GOOD: f64 = 2.0;

/// Change of one error that explains the measurements best.
#[derive(Clone, Debug, Serialize)]
pub struct Finding {
    /// Name of the error.
    pub name: String,
    /// Errors that explain the measurements equally well.
    pub as_well: Vec<String>,
    /// Is true if this error, or an equally good one, belongs to the station or to what is mounted
    /// on the tool instead of the machine.
    pub may_be_outside: bool,
    /// Kind of change: `drift`, `jump` or `excursion`, a jump that went back.
    pub kind: &'static str,
    /// Time of the change, or of the beginning of the drift, as counted by the calendar.
    pub since: f64,
    /// Date of that time.
    pub since_date: String,
    /// Interval of that time with 95 % coverage, as counted by the calendar; an end is none if it
    /// lies before the first check.
    pub between: [Option<f64>; 2],
    /// Dates of the interval.
    pub between_dates: [Option<String>; 2],
    /// Rate per day (or check) of a drift, or height of a jump, in `unit`.
    pub size: f64,
    /// Standard deviation of the size, in `unit`.
    pub standard_deviation: f64,
    /// Unit of the error: the length unit, or rad.
    pub unit: &'static str,
    /// Largest displacement of the tool point per unit of the error, in the length unit.
    pub effect: f64,
    /// Displacement of the tool point at that configuration until the last check, in the length
    /// unit.
    pub moved: f64,
    /// Date at which an excursion was over.
    pub until_date: Option<String>,
    /// Largest displacement of the tool point at that configuration at any check, in the length
    /// unit.
    pub farthest: f64,
    /// Date of that check.
    pub farthest_date: String,
    /// Time at which the tolerance is exceeded, if there are a tolerance and a drift.
    pub leaves: Option<Exceedance>,
    /// Value of the error at every check, and the value predicted by the change.
    #[serde(skip)]
    pub series: Vec<[f64; 2]>,
}

/// Predicted time at which a drift exceeds the tolerance.
#[derive(Clone, Debug, Serialize)]
pub struct Exceedance {
    /// Time, as counted by the calendar of the checks.
    pub time: f64,
    /// Date of that time.
    pub date: String,
    /// Standard deviation, as counted by the calendar of the checks.
    pub standard_deviation: f64,
}

/// Change of one error.
struct Candidate<'e> {
    error: &'e SingleError,
    change: Change,
    values: Vec<f64>,
    /// Reduction of the sum of squares, in units of the instrument's uncertainty.
    explained: f64,
    scatter: f64,
}

/// Returns the best explanation by a change of one error, if there are enough checks.
pub(super) fn finding(
    errors: &SingleErrors,
    numbers: &CheckValues,
    checks: &Checks,
    tolerance: Option<f64>,
) -> Option<Finding> {
    let times: Vec<f64> = checks.list.iter().map(|check| check.time).collect();
    let candidate = |error| candidate(error, numbers, &times);
    let all: Vec<Candidate> = errors.list.iter().filter_map(candidate).collect();
    let best = all.iter().max_by(|a, b| a.explained.total_cmp(&b.explained))?;
    let behind = |other: &Candidate| {
        (best.explained - other.explained) / (2.0 * best.scatter * best.scatter).max(1e-300)
    };
    // Of equally good ones, the first in the order of the errors: zeros of joints before others.
    let mut good = all.iter().filter(|other| behind(other) < EQUALLY_GOOD);
    let Candidate { error, change, values, .. } = good.next()?;
    let as_well: Vec<&Candidate> = good.collect();
    let show = |time: f64| checks.calendar.show(time);
    let last = *times.last()?;
    let away = values.iter().zip(&times).map(|(value, time)| ((value - change.level).abs(), *time));
    let (farthest, farthest_at) = away.max_by(|a, b| a.0.total_cmp(&b.0))?;
    let leaves = tolerance.and_then(|tolerance| change.reaches(tolerance / error.effect));
    Some(Finding {
        name: error.name.clone(),
        may_be_outside: error.is_placement || as_well.iter().any(|other| other.error.is_placement),
        as_well: as_well.iter().map(|other| other.error.name.clone()).collect(),
        kind: match change.kind {
            Kind::Drift => "drift",
            Kind::Jump => "jump",
            Kind::Excursion => "excursion",
        },
        since: change.since,
        since_date: show(change.since),
        between: change.between,
        between_dates: change.between.map(|end| end.map(show)),
        size: change.size,
        standard_deviation: change.standard_deviation,
        unit: error.unit,
        effect: error.effect,
        moved: change.moved(last).abs() * error.effect,
        until_date: change.until.map(show),
        farthest: farthest * error.effect,
        farthest_date: show(farthest_at),
        leaves: leaves.map(|(time, standard_deviation)| Exceedance {
            time,
            date: show(time),
            standard_deviation,
        }),
        series: times
            .iter()
            .zip(values)
            .map(|(t, value)| [*value, change.level + change.moved(*t)])
            .collect(),
    })
}

fn candidate<'e>(error: &'e SingleError, numbers: &CheckValues, times: &[f64]) -> Option<Candidate<'e>> {
    let values: Vec<f64> = numbers.checks.iter().map(|check| value(&error.column, check)).collect();
    let change = Change::fit(times, &values)?;
    let square: f64 = error.column.iter().map(|v| v * v).sum();
    let (explained, scatter) = (change.explained * square, change.scatter * square.sqrt());
    Some(Candidate { error, change, values, explained, scatter })
}
