//! Dates in columns and file names, as days since 1970-01-01.

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
            Self::Dates => {
                let (year, month, day) = civil(time.floor() as i64);
                format!("{year:04}-{month:02}-{day:02}")
            }
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
    let mut parts =
        rest.split(':').map(|part| part.parse::<f64>().ok().filter(|part| (0.0..61.0).contains(part)));
    let (hour, minute, second) = (parts.next()??, parts.next()??, parts.next().unwrap_or(Some(0.0))?);
    (hour < 24.0 && parts.next().is_none())
        .then_some((Calendar::Dates, days + (hour + (minute + second / 60.0) / 60.0) / 24.0))
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
    let digits = date.len() == 8 && date.bytes().all(|byte| byte.is_ascii_digit());
    if digits { day(&format!("{}-{}-{}", &date[..4], &date[4..6], &date[6..])) } else { None }
}

/// Parses `2026-03-14`, also with `_` or `.` as separators.
fn day(date: &str) -> Option<f64> {
    let parts: Vec<&str> = date.split(['-', '_', '.']).collect();
    let [year, month, day] = parts[..] else { return None };
    let number = |text: &str, length: usize| {
        let digits = text.len() == length && text.bytes().all(|byte| byte.is_ascii_digit());
        if digits { text.parse::<i64>().ok() } else { None }
    };
    let (year, month, day) = (number(year, 4)?, number(month, 2)?, number(day, 2)?);
    let days = days(year, month, day);
    // An invalid date, such as the 31st of February, does not survive the round trip.
    (civil(days) == (year, month, day)).then_some(days as f64)
}

/// Returns the days from 1970-01-01 to a Gregorian date. Years begin in March, so that the leap day
/// is the last.
fn days(year: i64, month: i64, day: i64) -> i64 {
    let year = if month <= 2 { year - 1 } else { year };
    let (era, of_era) = (year.div_euclid(400), year.rem_euclid(400));
    let of_year = (153 * ((month + 9) % 12) + 2) / 5 + day - 1;
    era * 146_097 + of_era * 365 + of_era / 4 - of_era / 100 + of_year - 719_468
}

/// Returns the date `days` after 1970-01-01: year, month, day.
fn civil(days: i64) -> (i64, i64, i64) {
    let days = days + 719_468;
    let (era, of_era) = (days.div_euclid(146_097), days.rem_euclid(146_097));
    let year = (of_era - of_era / 1460 + of_era / 36_524 - of_era / 146_096) / 365;
    let of_year = of_era - (365 * year + year / 4 - year / 100);
    let month = (5 * of_year + 2) / 153;
    let day = of_year - (153 * month + 2) / 5 + 1;
    let month = if month < 10 { month + 3 } else { month - 9 };
    (era * 400 + year + i64::from(month <= 2), month, day)
}

#[cfg(test)]
mod tests;
