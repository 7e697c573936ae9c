//! What has changed, since when, how fast, and when it is too much.

use abbe::control::{Change, Kind};
use serde::Serialize;

use super::charts::value;
use super::checks::Checks;
use super::numbers::Numbers;
use super::single_errors::{SingleError, SingleErrors};

/// Errors that explain the numbers as well as this: within a likelihood ratio of e².
const AS_WELL: f64 = 2.0;

/// The change of one error that explains the numbers best.
#[derive(Clone, Debug, Serialize)]
pub struct Finding {
    /// The error.
    pub name: String,
    /// Errors that explain the numbers as well.
    pub as_well: Vec<String>,
    /// Whether it, or one of those, belongs to the station or to what is mounted on the tool, and not to the machine.
    pub may_be_outside: bool,
    /// `drift` or `jump`.
    pub kind: &'static str,
    /// Since when.
    pub since: f64,
    /// The same as a date.
    pub since_date: String,
    /// Between when and when, with 95 % probability; nothing before the first check if it may have been before that.
    pub between: [Option<f64>; 2],
    /// The same as dates.
    pub between_dates: [Option<String>; 2],
    /// Its speed per day (or check), or the jump: the length unit, or rad.
    pub size: f64,
    /// One standard deviation of that.
    pub standard_deviation: f64,
    /// The unit of the error.
    pub unit: &'static str,
    /// How far a unit of it moves the tool point where that is most. The length unit.
    pub effect: f64,
    /// By how much the tool point has moved there until the last check. The length unit.
    pub moved: f64,
    /// When the tolerance is left, if there is a tolerance and a drift.
    pub leaves: Option<Leaving>,
    /// The error at every check that it explains best, and what the change says of it.
    #[serde(skip)]
    pub series: Vec<[f64; 2]>,
}

/// When a drift has used a tolerance up.
#[derive(Clone, Debug, Serialize)]
pub struct Leaving {
    /// When.
    pub time: f64,
    /// The same as a date.
    pub date: String,
    /// One standard deviation, in days (or checks).
    pub standard_deviation: f64,
}

/// A change of one error.
struct Candidate<'e> {
    error: &'e SingleError,
    change: Change,
    values: Vec<f64>,
    /// By how much it makes the sum of squares smaller, in units of the instrument's uncertainty.
    explained: f64,
    scatter: f64,
}

/// The best explanation by a change of one error, if there are checks enough.
pub(super) fn finding(
    errors: &SingleErrors,
    numbers: &Numbers,
    checks: &Checks,
    tolerance: Option<f64>,
) -> Option<Finding> {
    let times: Vec<f64> = checks.list.iter().map(|check| check.time).collect();
    let candidate = |error| candidate(error, numbers, &times);
    let mut all: Vec<Candidate> = errors.list.iter().filter_map(candidate).collect();
    all.sort_by(|a, b| b.explained.total_cmp(&a.explained));
    let best = all.first()?;
    let Candidate { error, change, values, .. } = best;
    let behind = |other: &Candidate| {
        (best.explained - other.explained) / (2.0 * best.scatter * best.scatter).max(1e-300)
    };
    let as_well: Vec<&Candidate> = all[1..].iter().filter(|other| behind(other) < AS_WELL).collect();
    let show = |time: f64| checks.calendar.show(time);
    let last = *times.last()?;
    let leaves = tolerance.and_then(|tolerance| change.reaches(tolerance / error.effect));
    Some(Finding {
        name: error.name.clone(),
        may_be_outside: error.outside || as_well.iter().any(|other| other.error.outside),
        as_well: as_well.iter().map(|other| other.error.name.clone()).collect(),
        kind: if change.kind == Kind::Drift { "drift" } else { "jump" },
        since: change.since,
        since_date: show(change.since),
        between: change.between,
        between_dates: change.between.map(|end| end.map(show)),
        size: change.size,
        standard_deviation: change.standard_deviation,
        unit: error.unit,
        effect: error.effect,
        moved: change.moved(last).abs() * error.effect,
        leaves: leaves.map(|(time, standard_deviation)| Leaving {
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

fn candidate<'e>(error: &'e SingleError, numbers: &Numbers, times: &[f64]) -> Option<Candidate<'e>> {
    let values: Vec<f64> = numbers.checks.iter().map(|check| value(&error.column, check)).collect();
    let change = Change::fit(times, &values)?;
    let square: f64 = error.column.iter().map(|v| v * v).sum();
    let (explained, scatter) = (change.explained * square, change.scatter * square.sqrt());
    Some(Candidate { error, change, values, explained, scatter })
}
