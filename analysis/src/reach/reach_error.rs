//! Why a target could not be reached.

use core::fmt;

use abbe_core::Error;

/// Why a target could not be reached. Lengths in the manipulator's unit, angles in rad.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum ReachError {
    /// No values of the free variables were found that reach it, with limits or without.
    OutOfReach {
        /// The smallest distance of the tool point from the target that was found, limits aside.
        residual: f64,
        /// What remains to be turned there, as the norm of rows 4–6; 0 for a target point.
        turn: f64,
    },
    /// It is reached, but only outside the limits; this variable is furthest outside of its own.
    OutsideLimits {
        /// Index of the variable.
        variable: usize,
        /// The value that it needs, or is held at.
        value: f64,
        /// Its limits.
        limits: [f64; 2],
    },
    /// The manipulator could not be evaluated, not even where the search begins.
    Evaluation(Error),
}

impl fmt::Display for ReachError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::OutOfReach { residual, turn: 0.0 } => {
                write!(f, "out of reach: at best {residual:.6} length units away")
            }
            Self::OutOfReach { residual, turn } => {
                write!(f, "out of reach: at best {residual:.6} length units away and {turn:.6} rad turned")
            }
            Self::OutsideLimits { variable, value, limits: [lower, upper] } => write!(
                f,
                "variable {variable} would have to be {value:.6}, outside its limits {lower} … {upper}"
            ),
            Self::Evaluation(error) => error.fmt(f),
        }
    }
}

impl core::error::Error for ReachError {}

impl From<Error> for ReachError {
    fn from(error: Error) -> Self {
        Self::Evaluation(error)
    }
}
