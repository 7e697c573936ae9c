//! Options of jobs: the ranges, defaults and names of their values, told once for the command and for Python.
//!
//! Each job has its own in the file `options.rs` of its folder.

use std::ops::RangeInclusive;

use abbe_spec::DhConvention;

/// Numbers of threads that a job may run on.
pub const THREADS: RangeInclusive<usize> = 1..=1024;

/// Conventions of a table of Denavit-Hartenberg numbers.
pub const CONVENTIONS: Choices<DhConvention> = Choices(&[
    (DhConvention::Standard, DhConvention::Standard.name(), ""),
    (DhConvention::Modified, DhConvention::Modified.name(), ""),
]);

/// A number that an option takes.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Number<T> {
    /// The value if none is given.
    pub default: T,
    /// The least and the largest value.
    pub range: RangeInclusive<T>,
}

/// The values of an option that is chosen by name: value, name, and one sentence where the name does not say it.
#[derive(Clone, Copy, Debug)]
pub struct Choices<T: 'static>(pub &'static [(T, &'static str, &'static str)]);

impl<T: Copy + PartialEq> Choices<T> {
    /// Finds the value of a name.
    pub fn find(self, wanted: &str) -> Option<T> {
        self.0.iter().find(|(_, name, _)| *name == wanted).map(|(value, ..)| *value)
    }

    /// Returns the name of a value; empty if it cannot be chosen.
    pub fn name(self, wanted: T) -> &'static str {
        self.0.iter().find(|(value, ..)| *value == wanted).map_or("", |(_, name, _)| name)
    }
}

/// Returns a share, which is from 0 to 1.
pub fn share(value: f64) -> Result<f64, &'static str> {
    if (0.0..=1.0).contains(&value) { Ok(value) } else { Err("a share is from 0 to 1") }
}
