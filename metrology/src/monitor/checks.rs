//! Checks of a machine in chronological order.

use std::{borrow::Cow, mem::take};

use abbe::identify::Observation;
use abbe_interpreter::Interpreter;

use crate::data::{Data, Dated, Map, Source};
use abbe_study::date::{Calendar, in_name, parse_date};
use abbe_study::{Result, mistake};

/// Measurement of the machine at one date.
#[derive(Clone, Debug)]
pub struct Check {
    /// Time, as counted by the calendar of all checks.
    pub time: f64,
    /// Measured rows.
    pub data: Data,
}

/// Checks of a machine in chronological order.
#[derive(Clone, Debug)]
pub struct Checks {
    /// Calendar of the times.
    pub calendar: Calendar,
    /// Checks, the earliest first.
    pub list: Vec<Check>,
    /// First date, if earlier checks were removed.
    pub since: Option<String>,
}

const DATES: &str = "write a date as 2026-03-14, optionally with a time, or as a number of days";

impl Checks {
    /// Reads files or tables of checks. A source with rows of several dates becomes several checks.
    ///
    /// The dates come from the map's `[time]`, or else from the file names. Without either, the
    /// checks are numbered.
    pub fn read<'a>(sources: impl IntoIterator<Item = impl Into<Source<'a>>>, map: &Map) -> Result<Self> {
        let mut checks: Vec<(Calendar, Check)> = Vec::new();
        let sources: Vec<Source<'_>> = sources.into_iter().map(Into::into).collect();
        let names: Vec<Option<f64>> =
            sources.iter().map(|source| in_name(&source.file()?.file_name()?.to_string_lossy())).collect();
        let named = names.iter().all(Option::is_some);
        for (source, name) in sources.into_iter().zip(names) {
            let Dated { data, calendars } = Dated::read(source, map)?;
            match calendars {
                Some(calendars) => checks.extend(split(data, &calendars)),
                None => {
                    let (calendar, time) = match name {
                        Some(date) if named => (Calendar::Dates, date),
                        _ => (Calendar::Checks, checks.len() as f64 + 1.0),
                    };
                    checks.push((calendar, Check { time, data }));
                }
            }
        }
        for pair in checks.windows(2) {
            let [(before, first), (calendar, check)] = pair else { continue };
            if before != calendar {
                let message = format!(
                    "this file counts time in {}, the check before it in {}",
                    calendar_name(*calendar),
                    calendar_name(*before)
                );
                let help = "use either dates or days in all files";
                return Err(mistake::with_help(&check.data.file, message, help));
            }
            if check.time < first.time {
                let [here, earlier] = [check.time, first.time].map(|time| calendar.show(time));
                let message =
                    format!("the checks are not in chronological order: {here} comes after {earlier}");
                let help = "give the checks in chronological order";
                return Err(mistake::with_help(&check.data.file, message, help));
            }
        }
        let calendar = checks.first().map_or(Calendar::Checks, |(calendar, _)| *calendar);
        Ok(Self { calendar, list: checks.into_iter().map(|(_, check)| check).collect(), since: None })
    }

    /// Returns the checks with the inputs derived from their rows.
    pub(super) fn completed(&self, map: &Map, machine: &Interpreter) -> Result<Cow<'_, Self>> {
        let spec = machine.spec();
        if !map.follows_from_rows() && spec.loops.is_empty() {
            return Ok(Cow::Borrowed(self));
        }
        let one = |check: &Check| {
            let data = Data::closed(check.data.completed(map, machine, spec), machine)?;
            Ok(Check { data: data.into_owned(), time: check.time })
        };
        let list = self.list.iter().map(one).collect::<Result<_>>()?;
        Ok(Cow::Owned(Self { calendar: self.calendar, list, since: self.since.clone() }))
    }

    /// Removes the checks before a date. `option` is the name of the command-line option for error
    /// messages.
    pub fn since(&mut self, option: &str, date: &str) -> Result<()> {
        let wrong = |message: String, help: &str| mistake::with_help(option, message, help);
        let (calendar, since) = match (parse_date(date), self.calendar) {
            (Some((Calendar::Days, number)), Calendar::Checks) => (Calendar::Checks, number),
            (Some(date), _) => date,
            (None, _) => return Err(wrong(format!("`{}` is not a date", date.escape_debug()), DATES)),
        };
        if calendar != self.calendar {
            let message = format!(
                "this is in {}, but the checks are in {}",
                calendar_name(calendar),
                calendar_name(self.calendar)
            );
            return Err(wrong(message, "use the same unit as the checks"));
        }
        self.list.retain(|check| check.time >= since);
        self.since = Some(date.to_owned());
        match self.list.is_empty() {
            true => Err(wrong("there is no check after this date".to_owned(), "give an earlier date")),
            false => Ok(()),
        }
    }
}

fn calendar_name(calendar: Calendar) -> &'static str {
    match calendar {
        Calendar::Dates => "dates",
        Calendar::Days => "days",
        Calendar::Checks => "checks",
    }
}

/// Splits the rows by day.
fn split(mut data: Data, calendars: &[Calendar]) -> Vec<(Calendar, Check)> {
    let (mut rows, mut unusable) = (take(&mut data.observations), take(&mut data.unusable));
    let day = |row: &Observation| row.time().unwrap_or_default().floor();
    let begins = |i: &usize| *i == 0 || day(&rows[*i]) != day(&rows[i - 1]);
    let starts: Vec<usize> = (0..rows.len()).filter(begins).collect();
    // Splitting from the end frees memory at each step, so that the rows are never in memory twice.
    let mut checks: Vec<(Calendar, Check)> = Vec::with_capacity(starts.len());
    for start in starts.into_iter().rev() {
        let observations = rows.split_off(start);
        rows.shrink_to_fit();
        // The first check keeps the unusable rows.
        let unusable = if start == 0 { take(&mut unusable) } else { Vec::new() };
        let time = observations.first().and_then(Observation::time).unwrap_or_default();
        let data = Data { observations, unusable, ..data.clone() };
        checks.push((calendars[start], Check { time, data }));
    }
    checks.reverse();
    checks
}
