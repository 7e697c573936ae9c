//! Why there is no result.

use core::fmt;

use abbe_core::Error;

/// Why measurements gave no result.
#[derive(Clone, Debug, PartialEq)]
pub enum Failure {
    /// An observation cannot be evaluated.
    Observation {
        /// The line of the observation.
        line: u64,
        /// Why not.
        error: Error,
    },
    /// The machine cannot be evaluated at its home configuration.
    Machine(Error),
    /// There are not more numbers than combinations to be known: nothing would be left to judge the result by.
    TooFew {
        /// Numbers measured, those of a configuration that was visited again counted once.
        numbers: usize,
        /// At how many configurations.
        configurations: usize,
        /// Combinations of unknowns that they determine.
        rank: usize,
    },
    /// The machine touches nothing near a configuration.
    Untouched {
        /// The line of the observation.
        line: u64,
    },
    /// The steps do not come to an end: the model is far from what was measured.
    NotConverged {
        /// How many were made.
        steps: usize,
    },
}

impl fmt::Display for Failure {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Observation { line, error } => write!(f, "line {line}: {error}"),
            Self::Machine(error) => error.fmt(f),
            Self::TooFew { numbers, configurations, rank } => {
                write!(
                    f,
                    "{numbers} independent numbers were measured ({configurations} configurations) for {rank} unknowns: \
                     none is left to judge the result by"
                )
            }
            Self::Untouched { line } => {
                write!(f, "line {line}: within the limits, the tool does not come to where it is to touch")
            }
            Self::NotConverged { steps } => write!(f, "no least squares solution after {steps} steps"),
        }
    }
}

impl core::error::Error for Failure {}
