//! Dates in columns and file names, as days since 1970-01-01.

use chrono::{NaiveDate, NaiveTime, Timelike};
use serde::Serialize;

/// Unit and origin of times.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Calendar {
    /// Days since 1970-01-01.
    Dates,
    /// Days since an unknown day.
    Days,
    /// Number of the check, without dates.
    Checks,
}

impl Calendar {
    /// Formats a time: `2026-03-14`, `day 12`, `check 12`.
    pub fn show(self, time: f64) -> String {
        match self {
            Self::Dates => NaiveDate::from_epoch_days(time.floor() as i32).unwrap_or_default().to_string(),
            Self::Days => format!("day {}", crate::number::trimmed(time, 1)),
            Self::Checks => format!("check {}", crate::number::trimmed(time, 1)),
        }
    }

    /// Returns the name of the unit: `day` or `check`.
    pub fn unit(self) -> &'static str {
        if self == Self::Checks { "check" } else { "day" }
    }
}

/// Parses `2026-03-14`, `20260314`, `2026-03-14T08:30`, `2026-03-14 08:30:00`, or a number of days.
pub fn parse_date(text: &str) -> Option<(Calendar, f64)> {
    if let Some(date) = compact(text) {
        return Some((Calendar::Dates, date));
    }
    if let Ok(days) = text.parse::<f64>() {
        return days.is_finite().then_some((Calendar::Days, days));
    }
    let (date, rest) = text.split_at_checked(10)?;
    let days = day(date)?;
    let rest = rest.trim_start_matches(['T', ' ']);
    let rest = rest.strip_suffix('Z').unwrap_or(rest);
    if rest.is_empty() {
        return Some((Calendar::Dates, days));
    }
    let of_day = |form| NaiveTime::parse_from_str(rest, form).ok();
    let of_day = of_day("%H:%M").or_else(|| of_day("%H:%M:%S%.f"))?;
    let seconds = f64::from(of_day.num_seconds_from_midnight()) + 1e-9 * f64::from(of_day.nanosecond());
    Some((Calendar::Dates, days + seconds / 86_400.0))
}

/// Finds the date in a file name: `check-2026-03-14.csv`, `20260314_flange.csv`.
pub fn in_name(name: &str) -> Option<f64> {
    let starts = (0..name.len()).filter(|i| *i == 0 || !name.as_bytes()[i - 1].is_ascii_digit());
    let mut dates = starts.filter_map(|i| {
        if let Some(date) = name.get(i..i + 10).and_then(day) {
            return Some(date);
        }
        let longer = name.as_bytes().get(i + 8).is_some_and(u8::is_ascii_digit);
        name.get(i..i + 8).filter(|_| !longer).and_then(compact)
    });
    dates.next_back()
}

/// Parses `20260314`.
fn compact(date: &str) -> Option<f64> {
    of_digits(date, 8, "%Y%m%d")
}

/// Parses `2026-03-14`, also with `_` or `.` as separators.
fn day(date: &str) -> Option<f64> {
    of_digits(&date.replace(['_', '.'], "-"), 10, "%Y-%m-%d")
}

/// Parses a date of eight digits and this length.
fn of_digits(date: &str, length: usize, form: &str) -> Option<f64> {
    let is_whole = date.len() == length && date.bytes().filter(u8::is_ascii_digit).count() == 8;
    let date = NaiveDate::parse_from_str(date, form).ok().filter(|_| is_whole)?;
    Some(f64::from(date.to_epoch_days()))
}

#[cfg(test)]
mod tests;
