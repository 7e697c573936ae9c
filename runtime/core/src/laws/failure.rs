//! The discrepancy of a law, and its failure.

use core::fmt;

use crate::Error;

/// Arguments at which laws are checked.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Configuration {
    /// Joint variables.
    pub q: Vec<f64>,
    /// Structural parameters.
    pub s: Vec<f64>,
    /// Inputs.
    pub u: Vec<f64>,
}

impl fmt::Display for Configuration {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "q = {:?}", self.q)?;
        let others = [("s", &self.s), ("u", &self.u)];
        others
            .iter()
            .filter(|(_, values)| !values.is_empty())
            .try_for_each(|(name, values)| write!(f, ", {name} = {values:?}"))
    }
}

/// Largest difference between two ways to compute the same values, over all samples.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Discrepancy {
    /// Largest difference, relative to the largest entry. Lengths are in arm lengths, so that m, mm
    /// and rad have the same weight. Infinite if a value is NaN.
    pub relative: f64,
    /// Configuration at which it occurs.
    pub at: Configuration,
    /// Number of configurations compared.
    pub compared: usize,
    /// Number of configurations skipped because Euler rows are nearly singular there.
    pub skipped: usize,
}

impl Discrepancy {
    /// Returns [`Failure::Discrepant`] if the discrepancy exceeds a tolerance.
    pub fn within(&self, law: &'static str, tolerance: f64) -> Result<(), Failure> {
        if self.relative <= tolerance {
            return Ok(());
        }
        let (relative, at) = (self.relative, self.at.clone());
        Err(Failure::Discrepant { law, relative, tolerance, at })
    }

    /// Adds a difference. NaN counts as infinity.
    pub(super) fn add(&mut self, relative: f64, at: &Configuration) {
        let relative = if relative.is_nan() { f64::INFINITY } else { relative };
        if relative >= self.relative {
            self.relative = relative;
            self.at = at.clone();
        }
    }
}

/// Violation of a law by a manipulator.
#[derive(Clone, Debug, PartialEq)]
pub enum Failure {
    /// The manipulator could not be evaluated at a configuration within its limits.
    Evaluation {
        /// The configuration.
        at: Configuration,
        /// Cause.
        error: Error,
    },
    /// A method returned NaN or infinity instead of an error.
    NotFinite {
        /// The method.
        method: &'static str,
        /// The configuration.
        at: Configuration,
    },
    /// A method accepted NaN, or a slice of the wrong length, instead of returning an error.
    Unguarded {
        /// The method.
        method: &'static str,
        /// Description of the invalid input.
        input: &'static str,
    },
    /// Fewer than half of the configurations are far enough from Euler singularities to be
    /// compared.
    Skipped {
        /// Number of configurations skipped.
        skipped: usize,
        /// Number of configurations sampled.
        samples: usize,
    },
    /// Two ways to compute the same differ.
    Discrepant {
        /// Name of the law.
        law: &'static str,
        /// Relative difference.
        relative: f64,
        /// Tolerance.
        tolerance: f64,
        /// Configuration at which the difference is largest.
        at: Configuration,
    },
    /// The first-order remainder does not fall with the square of the errors.
    Slope {
        /// Slope found.
        slope: f64,
        /// The configuration.
        at: Configuration,
    },
}

impl fmt::Display for Failure {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Evaluation { at, error } => write!(f, "at {at}: {error}"),
            Self::NotFinite { method, at } => {
                write!(f, "{method} returns a value that is not finite at {at}")
            }
            Self::Unguarded { method, input } => write!(f, "{method} accepts {input}"),
            Self::Skipped { skipped, samples } => write!(
                f,
                "{skipped} of {samples} configurations are near Euler singularities; use orientation = \"rotation-vector\""
            ),
            Self::Discrepant { law, relative, tolerance, at } => write!(
                f,
                "{law}: relative discrepancy {relative:.2e}, at most {tolerance:.0e} expected, at {at}"
            ),
            Self::Slope { slope, at } => {
                write!(f, "first-order remainder: slope {slope:.3} on a log-log plot, 2 expected, at {at}")
            }
        }
    }
}

impl core::error::Error for Failure {}
