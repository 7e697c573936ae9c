//! Values of options.

use std::time::Duration;

use abbe_study::identify::Prior;

pub(super) fn prior(text: &str) -> Result<Prior, String> {
    match text {
        "spec" => Ok(Prior::Spec),
        "auto" => Ok(Prior::Auto),
        text => share(text).map(Prior::Share),
    }
}

pub(super) fn duration(text: &str) -> Result<Duration, String> {
    let digits = text.trim_end_matches(|c: char| c.is_ascii_alphabetic());
    let factor = match text[digits.len()..].trim() {
        "s" => 1.0,
        "min" => 60.0,
        "h" => 3600.0,
        _ => return Err("a time has a unit: `60s`, `5min`, `1h`".to_owned()),
    };
    let seconds = digits.trim().parse::<f64>().map_err(|error| error.to_string())? * factor;
    Duration::try_from_secs_f64(seconds).map_err(|error| error.to_string())
}

pub(super) fn share(text: &str) -> Result<f64, String> {
    let value = text.parse::<f64>().map_err(|error| error.to_string())?;
    if (0.0..=1.0).contains(&value) { Ok(value) } else { Err("a share is from 0 to 1".to_owned()) }
}

/// `1%` or `0.01`.
pub(super) fn gap(text: &str) -> Result<f64, String> {
    let (digits, unit) = match text.trim().strip_suffix('%') {
        Some(digits) => (digits, 0.01),
        None => (text, 1.0),
    };
    let value = digits.trim().parse::<f64>().map_err(|error| error.to_string())? * unit;
    let is_gap = value > 0.0 && value < 10.0;
    if is_gap { Ok(value) } else { Err("a gap is more than 0: `1%`, `0.1%`".to_owned()) }
}

pub(super) fn folds(text: &str) -> Result<usize, String> {
    let value = text.parse::<usize>().map_err(|error| error.to_string())?;
    if (2..=1000).contains(&value) { Ok(value) } else { Err("from 2 to 1000 parts".to_owned()) }
}
