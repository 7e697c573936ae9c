//! Why a configuration could not be evaluated.

use core::fmt;

/// The smallest margin `cos ρ` at which Euler rows are still given.
///
/// Below it the rows would be amplified a million times or more: an answer nobody should act on.
pub const MINIMUM_MARGIN: f64 = 1e-6;

/// Which argument or result an [`Error`] is about.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Quantity {
    /// The joint variables `q`.
    Variables,
    /// The structural parameters `s`.
    Parameters,
    /// The inputs `u`.
    Inputs,
    /// A pose or the transforms it is made of.
    Pose,
    /// A Jacobian.
    Jacobian,
    /// What the sources cause: one value per [`Effect`](crate::Effect).
    Effects,
    /// Generalized errors, six per frame, or their variances.
    Errors,
    /// What the errors of sources are multiplied with: one value per source.
    Magnitudes,
    /// The rows of arguments of a batch.
    Arguments,
    /// The rows of results of a batch.
    Results,
    /// The configurations of a batch.
    Configurations,
    /// The lanes of a batch.
    Lanes,
    /// The displacement of the tool point, its covariance, or variances that were given for it.
    Displacement,
}

impl fmt::Display for Quantity {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Variables => "joint variable",
            Self::Parameters => "structural parameter",
            Self::Inputs => "input",
            Self::Pose => "pose entry",
            Self::Jacobian => "Jacobian column",
            Self::Effects => "effect of a source",
            Self::Errors => "generalized error",
            Self::Magnitudes => "magnitude of a source",
            Self::Arguments => "row of arguments",
            Self::Results => "row of results",
            Self::Configurations => "configuration of a batch",
            Self::Lanes => "lane",
            Self::Displacement => "displacement entry",
        })
    }
}

/// Why a configuration could not be evaluated. Indices count from 0.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Error {
    /// A slice has the wrong length.
    Count {
        /// What it holds.
        quantity: Quantity,
        /// How many the manipulator has.
        expected: usize,
        /// How many were given.
        found: usize,
    },
    /// A value that came in, or would have gone out, is NaN or infinite.
    NotFinite {
        /// What it is.
        quantity: Quantity,
        /// Which of them.
        index: usize,
    },
    /// An input is outside the range that the spec gives it.
    OutOfRange {
        /// Which input.
        input: usize,
        /// Its value.
        value: f64,
        /// The range.
        range: [f64; 2],
    },
    /// Roll is at ±90°: the Euler rows do not exist here.
    EulerSingularity {
        /// `cos ρ`, less than [`MINIMUM_MARGIN`].
        margin: f64,
    },
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
            Self::EulerSingularity { margin } => write!(
                f,
                "Euler angles are singular here (cos roll = {margin:e}); use orientation = \"rotation-vector\""
            ),
        }
    }
}

impl core::error::Error for Error {}
