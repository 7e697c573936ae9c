//! Errors of identification.

use core::fmt;

use super::Observation;
use abbe_core::{Error, Quantity, Remedy};

/// A result whose error, unless another one is named, is a [`Failure`].
pub(super) type Result<T, E = Failure> = core::result::Result<T, E>;

/// Reason why identification has no result.
#[derive(Clone, Debug, PartialEq)]
pub enum Failure {
    /// The model cannot be evaluated at an observation.
    Observation {
        /// Line of the observation.
        line: u64,
        /// Error of the evaluation.
        error: Error,
    },
    /// The model cannot be evaluated at its home configuration.
    Machine(Error),
    /// There are fewer numbers than identifiable combinations, or no more without a stated
    /// uncertainty.
    TooFew {
        /// Number of measured numbers, without repeated visits.
        numbers: usize,
        /// Number of configurations.
        configurations: usize,
        /// Number of identifiable combinations of unknowns.
        rank: usize,
    },
    /// No configuration near an observation touches.
    Untouched {
        /// Line of the observation.
        line: u64,
    },
    /// The iterations do not converge: the model is far from the measurements.
    NotConverged {
        /// Number of iterations.
        steps: usize,
    },
}

impl Failure {
    /// Returns `true` if loops do not close.
    pub(super) const fn is_open(&self) -> bool {
        matches!(self, Self::Observation { error, .. } | Self::Machine(error) if error.is_open())
    }

    /// Returns the failure of derivatives of some rows.
    pub(super) fn not_finite(data: &[Observation]) -> Self {
        let line = data.first().map_or(0, |first| first.line);
        Self::Observation { line, error: Error::NotFinite { quantity: Quantity::Jacobian, index: 0 } }
    }

    /// Returns a result; `None` where loops do not close, so that a step ends there.
    pub(super) fn unless_open<T>(result: Result<T, Self>) -> Result<Option<T>, Self> {
        match result {
            Err(failure) if failure.is_open() => Ok(None),
            other => other.map(Some),
        }
    }
}

impl fmt::Display for Failure {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Observation { line, error } => write!(f, "line {line}: {error}"),
            Self::Machine(error) => error.fmt(f),
            Self::TooFew { numbers, configurations, rank } => {
                let plural = if *configurations == 1 { "" } else { "s" };
                write!(
                    f,
                    "{numbers} independent values were measured ({configurations} configuration{plural}) \
                     for {rank} or more unknowns"
                )
            }
            Self::Untouched { line } => {
                write!(f, "line {line}: within the joint limits the tool does not reach contact")
            }
            Self::NotConverged { steps } => write!(f, "no least squares solution after {steps} steps"),
        }
    }
}

impl core::error::Error for Failure {}

impl Remedy for Failure {
    fn remedy(&self) -> &'static str {
        match self {
            Self::Observation { error, .. } => match error {
                Error::NotFinite { .. } => {
                    "check the cells of the row and the units of the map, or leave the row out"
                }
                error => error.remedy(),
            },
            Self::Machine(error) => error.remedy(),
            Self::TooFew { .. } => "measure at more configurations; repeated visits do not count",
            Self::Untouched { .. } => "leave the row out, or widen the limits of the joints",
            Self::NotConverged { .. } => {
                "check for outliers, wrong units and reversed joints in the map (`abbe doctor`), \
                 or weight the rows robustly"
            }
        }
    }
}
