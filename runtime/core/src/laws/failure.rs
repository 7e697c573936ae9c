//! The discrepancy of a law, and its failure.

use core::fmt;

use crate::Error;

/// Largest difference between two ways to compute the same values, over all samples.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Discrepancy {
    /// Largest difference, relative to the largest entry. Lengths are in arm lengths, so that m, mm
    /// and rad have the same weight. Infinite if a value is NaN.
    pub relative: f64,
    /// Joint variables at which it occurs.
    pub q: Vec<f64>,
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
        let (relative, q) = (self.relative, self.q.clone());
        Err(Failure::Discrepant { law, relative, tolerance, q })
    }

    /// Adds a difference. NaN counts as infinity.
    pub(super) fn add(&mut self, relative: f64, q: &[f64]) {
        let relative = if relative.is_nan() { f64::INFINITY } else { relative };
        if relative >= self.relative {
            self.relative = relative;
            self.q = q.to_vec();
        }
    }
}

/// Violation of a law by a manipulator.
#[derive(Clone, Debug, PartialEq)]
pub enum Failure {
    /// The manipulator could not be evaluated at a configuration within its limits.
    Evaluation {
        /// The joint variables.
        q: Vec<f64>,
        /// Cause.
        error: Error,
    },
    /// A method returned NaN or infinity instead of an error.
    NotFinite {
        /// The method.
        method: &'static str,
        /// The joint variables.
        q: Vec<f64>,
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
        /// Joint variables at which the difference is largest.
        q: Vec<f64>,
    },
    /// The first-order remainder does not fall with the square of the errors.
    Slope {
        /// Slope found.
        slope: f64,
        /// The joint variables.
        q: Vec<f64>,
    },
}

impl fmt::Display for Failure {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Evaluation { q, error } => write!(f, "at q = {q:?}: {error}"),
            Self::NotFinite { method, q } => {
                write!(f, "{method} returns a value that is not finite at q = {q:?}")
            }
            Self::Unguarded { method, input } => write!(f, "{method} accepts {input}"),
            Self::Skipped { skipped, samples } => write!(
                f,
                "{skipped} of {samples} configurations are near Euler singularities; use orientation = \"rotation-vector\""
            ),
            Self::Discrepant { law, relative, tolerance, q } => write!(
                f,
                "{law}: relative discrepancy {relative:.2e}, at most {tolerance:.0e} expected, at q = {q:?}"
            ),
            Self::Slope { slope, q } => write!(
                f,
                "first-order remainder: slope {slope:.3} on a log-log plot, 2 expected, at q = {q:?}"
            ),
        }
    }
}

impl core::error::Error for Failure {}
