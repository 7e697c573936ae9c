//! Errors of inverse kinematics.

use core::fmt;

use abbe_core::Error;

/// Failure to reach a target. Lengths are in the manipulator's unit, angles in rad.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum ReachError {
    /// No values of the free variables reach the target, with limits or without.
    OutOfReach {
        /// Smallest distance found between tool point and target, without limits.
        residual: f64,
        /// Remaining rotation there, the norm of rows 4–6. 0 for a target point.
        turn: f64,
    },
    /// The target is reached only outside the limits. The variable is the one furthest outside its
    /// limits.
    OutsideLimits {
        /// Index of the variable.
        variable: usize,
        /// Value that it needs, or is fixed at.
        value: f64,
        /// Limits of the variable.
        limits: [f64; 2],
    },
    /// The target is reached only outside the limits of a sum of joint variables.
    OutsideSumLimit {
        /// Index of the limit among those of the description.
        limit: usize,
        /// Value of the sum there.
        value: f64,
    },
    /// The manipulator could not be evaluated, not even at the start.
    Evaluation(Error),
}

impl fmt::Display for ReachError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::OutOfReach { residual, turn: 0.0 } => {
                write!(f, "out of reach by {residual:.6} length units")
            }
            Self::OutOfReach { residual, turn } => {
                write!(f, "out of reach by {residual:.6} length units and {turn:.6} rad")
            }
            Self::OutsideLimits { variable, value, limits: [lower, upper] } => write!(
                f,
                "variable {variable} would need to be {value:.6}, outside its limits {lower} … \
                 {upper}"
            ),
            Self::OutsideSumLimit { limit, value } => {
                write!(f, "the sum of limit {} would need to be {value:.6}, outside its limits", limit + 1)
            }
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
