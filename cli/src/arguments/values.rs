//! Parsers of option values.

use std::{ops::RangeInclusive, time::Duration};

use abbe_spec::{Spec, expr::Dimension};
use abbe_study::options::{self, Choices};
use clap::builder::{PossibleValue, PossibleValuesParser, RangedI64ValueParser, TypedValueParser};

use crate::{Result, failure::Failure};

/// Returns a parser of whole numbers in a range.
pub(crate) fn whole(range: RangeInclusive<usize>) -> RangedI64ValueParser<usize> {
    let (least, most) = range.into_inner();
    RangedI64ValueParser::new().range(least as i64..=most as i64)
}

/// Returns a parser of named values. Help lists the names.
pub(crate) fn named<T>(choices: Choices<T>) -> impl TypedValueParser<Value = T>
where
    T: Copy + PartialEq + Send + Sync + 'static,
{
    let possible = choices.0.iter().map(|(_, name, help)| match *help {
        "" => PossibleValue::new(*name),
        help => PossibleValue::new(*name).help(help),
    });
    let find = move |name: String| choices.find(&name.to_lowercase()).ok_or("no such value");
    PossibleValuesParser::new(possible).try_map(find)
}

pub(crate) fn duration(text: &str) -> Result<Duration, String> {
    let digits = text.trim_end_matches(|c: char| c.is_ascii_alphabetic());
    let factor = match text[digits.len()..].trim() {
        "s" => 1.0,
        "min" => 60.0,
        "h" => 3600.0,
        _ => return Err("expected a time with a unit: `60s`, `5min`, `1h`".to_owned()),
    };
    let seconds = digits.trim().parse::<f64>().map_err(|error| error.to_string())? * factor;
    Duration::try_from_secs_f64(seconds).map_err(|error| error.to_string())
}

pub(crate) fn share(text: &str) -> Result<f64, String> {
    let value = text.parse::<f64>().map_err(|error| error.to_string())?;
    Ok(options::share(value)?)
}

/// Parses a length that must not be negative, in the length unit of the spec.
pub(crate) fn length(option: &str, text: &str, spec: &Spec) -> Result<f64> {
    match options::quantity(option, text, spec.length, Dimension::LENGTH, "this")? {
        value if value >= 0.0 => Ok(value),
        _ => Err(Failure::new(option, "this must not be negative").help(format!("write `{option} 0.04mm`"))),
    }
}
