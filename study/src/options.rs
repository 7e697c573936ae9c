//! Ranges, defaults and names of options, defined once for the command and Python.
//!
//! Options of a job are in `options.rs` of its folder.

use std::{fmt::Display, ops::RangeInclusive};

use abbe::LengthUnit;
use abbe_spec::{DhConvention, Document, expr::Dimension, value::parse_value};

use crate::Result;

/// Valid numbers of threads.
pub const THREADS: RangeInclusive<usize> = 1..=1024;

/// Conventions of Denavit-Hartenberg parameters.
pub const CONVENTIONS: Choices<DhConvention> = Choices(&[
    (DhConvention::Standard, DhConvention::Standard.name(), ""),
    (DhConvention::Modified, DhConvention::Modified.name(), ""),
]);

/// A numeric option.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct NumericOption<T> {
    /// Default value.
    pub default: T,
    /// Smallest and largest valid value.
    pub range: RangeInclusive<T>,
}

/// Choices of an option: value, name, and a sentence where the name needs an explanation.
#[derive(Clone, Copy, Debug)]
pub struct Choices<T: 'static>(pub &'static [(T, &'static str, &'static str)]);

impl<T: Copy + PartialEq> Choices<T> {
    /// Finds the value for a name.
    pub fn find(self, wanted: &str) -> Option<T> {
        self.0.iter().find(|(_, name, _)| *name == wanted).map(|(value, ..)| *value)
    }

    /// Returns the name of a value; empty if it is not a choice.
    pub fn name(self, wanted: T) -> &'static str {
        self.0.iter().find(|(value, ..)| *value == wanted).map_or("", |(_, name, _)| name)
    }
}

/// Reads the value of an option, in coherent units. `what` is its name in messages.
pub fn quantity(
    option: impl Display,
    text: &str,
    length: LengthUnit,
    dimension: Dimension,
    what: &str,
) -> Result<f64> {
    let document = Document::new(option, text);
    let value = parse_value(&document, 0..text.len(), length, dimension, what);
    document.finish(value)
}

/// Checks that a share is between 0 and 1.
pub fn share(value: f64) -> Result<f64, &'static str> {
    if (0.0..=1.0).contains(&value) { Ok(value) } else { Err("a share must be between 0 and 1") }
}
