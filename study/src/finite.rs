//! Checks that a report has only finite numbers.
//!
//! Configurations that cannot be evaluated are reported earlier, with their values. This check
//! finds results of finite numbers that overflow, or ratios with a zero denominator.

use std::fmt::Display;

use ciborium::Value;
use serde::{Serialize, Serializer};

use crate::{Result, mistake};

/// Returns the report, or a diagnostic that names the first number in it that is not finite.
pub fn finite<R: Serialize>(subject: impl Display, report: R) -> Result<R> {
    match Value::serialized(&report).ok().as_ref().and_then(place_of_infinite) {
        Some(place) if !place.is_empty() => {
            let message = format!("`{}` of the result is not a finite number", place.join("."));
            let help = "an input is far too large or too small: check the units in the spec, the \
                map and the options";
            Err(mistake::with_help(subject, message, help))
        }
        _ => Ok(report),
    }
}

/// Returns the names of the fields that lead to the first number that is not finite.
fn place_of_infinite(value: &Value) -> Option<Vec<String>> {
    let below = |name: String, value: &Value| {
        let mut place = place_of_infinite(value)?;
        place.insert(0, name);
        Some(place)
    };
    match value {
        Value::Float(number) => (!number.is_finite()).then(Vec::new),
        Value::Array(list) => (1..).zip(list).find_map(|(i, value): (usize, _)| below(i.to_string(), value)),
        Value::Map(fields) => fields
            .iter()
            .find_map(|(name, value)| below(name.as_text().unwrap_or_default().to_owned(), value)),
        _ => None,
    }
}

/// Serializes a number, or a list of numbers, that may be infinite by definition: infinite ones as
/// `null`.
pub fn or_null<S: Serializer>(value: &impl MayBeInfinite, serializer: S) -> Result<S::Ok, S::Error> {
    value.finite_numbers().serialize(serializer)
}

/// A number, or a list of numbers, that may be infinite.
pub trait MayBeInfinite {
    /// Type with `None` for infinite numbers.
    type Finite: Serialize;

    /// Replaces infinite numbers by `None`.
    fn finite_numbers(&self) -> Self::Finite;
}

impl MayBeInfinite for f64 {
    type Finite = Option<f64>;

    fn finite_numbers(&self) -> Option<f64> {
        (!self.is_infinite()).then_some(*self)
    }
}

impl<const N: usize> MayBeInfinite for [f64; N]
where
    [Option<f64>; N]: Serialize,
{
    type Finite = [Option<f64>; N];

    fn finite_numbers(&self) -> [Option<f64>; N] {
        self.map(|value| value.finite_numbers())
    }
}

#[cfg(test)]
mod tests;
