//! Remedies for errors.

use core::fmt::Display;

use crate::error::Error;

/// An error that names its remedy, as the `help` line of a diagnostic shows it.
pub trait Remedy: Display {
    /// Returns one sentence that says what to do about the error.
    fn remedy(&self) -> &'static str;
}

impl Remedy for Error {
    fn remedy(&self) -> &'static str {
        match self {
            Self::NotFinite { .. } => {
                "an expression divides by zero there or is far too large: check the units of the \
                 spec"
            }
            Self::PassiveLimit { .. } => {
                "leave this configuration out, or widen the limits of the passive joint"
            }
            Self::NotClosed => "leave this configuration out, or correct the lengths of the loops",
            Self::EulerSingularity { .. } => {
                "leave this configuration out, or set `orientation = \"rotation-vector\"`"
            }
            Self::OutOfRange { .. } => "give another value, or widen the input's `range` in the spec",
            Self::Count { .. } => "give as many values as the manipulator has",
            Self::NoFunction(_) => "implement it in `Manipulator::evaluate`",
        }
    }
}
