//! Errors of evaluating a configuration.
//!
//! Remedies for errors.

use core::fmt::{self, Display};

use crate::{Function, Quantity};

/// Smallest margin `cos ρ` at which Euler rows are returned.
///
/// Below it the rows would be amplified a million times or more.
pub const MINIMUM_MARGIN: f64 = 1e-6;

/// Result of evaluating a configuration.
pub(crate) type Result<T, E = Error> = core::result::Result<T, E>;

/// Failure to evaluate a configuration. Indices count from 0.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Error {
    /// A slice has the wrong length.
    Count {
        /// Content of the slice.
        quantity: Quantity,
        /// Number of values that the manipulator has.
        expected: usize,
        /// Number of values given.
        found: usize,
    },
    /// An argument or a result is NaN or infinite.
    NotFinite {
        /// Content of the array.
        quantity: Quantity,
        /// Index of the value.
        index: usize,
    },
    /// An input is outside the range that the spec declares.
    OutOfRange {
        /// Index of the input.
        input: usize,
        /// Value of the input.
        value: f64,
        /// Declared range.
        range: [f64; 2],
    },
    /// The manipulator does not have a function.
    NoFunction(Function),
    /// The loops do not close in the mode of home: the straight path from home ends before the
    /// joint values, or a passive joint exceeds a limit.
    NotClosed,
    /// A passive joint exceeds a limit where the loops close.
    PassiveLimit {
        /// Index of the passive variable.
        passive: usize,
    },
    /// Roll is at ±90°, where the Euler rows are singular.
    EulerSingularity {
        /// `cos ρ`, less than [`MINIMUM_MARGIN`].
        margin: f64,
    },
}

impl Error {
    /// Returns `true` if loops do not close, or do so beyond the limit of a passive joint.
    pub const fn is_open(&self) -> bool {
        matches!(self, Self::NotClosed | Self::PassiveLimit { .. })
    }
}

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match *self {
            Self::Count { quantity, expected, found } => {
                write!(f, "expected {expected} values, one per {quantity}, found {found}")
            }
            Self::NotFinite { quantity, index } => {
                write!(f, "{quantity} {index} is not a finite number")
            }
            Self::OutOfRange { input, value, range: [lower, upper] } => {
                write!(f, "input {input} is {value}, outside its range {lower} … {upper}")
            }
            Self::NoFunction(function) => write!(f, "this manipulator has no function {}", function.name()),
            Self::NotClosed => {
                f.write_str("the loops do not close at these joint values, on the straight path from home")
            }
            Self::PassiveLimit { passive } => write!(f, "passive variable {passive} exceeds a limit"),
            Self::EulerSingularity { margin } => write!(
                f,
                "Euler angles are singular here (cos roll = {margin:e}); use orientation = \"rotation-vector\""
            ),
        }
    }
}

impl core::error::Error for Error {}

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
