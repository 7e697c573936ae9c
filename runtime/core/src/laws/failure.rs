//! How well a law holds, and how it fails to.

use core::fmt;

use crate::Error;

/// The largest difference between two ways to compute the same, over all samples.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Discrepancy {
    /// The largest difference, relative to the largest entry; lengths in arm lengths, so that m, mm and rad
    /// weigh the same. Infinite where there was nothing to compare with.
    pub relative: f64,
    /// The joint variables where it occurs.
    pub q: Vec<f64>,
    /// How many configurations were compared.
    pub compared: usize,
    /// How many were left out because Euler rows are nearly singular there.
    pub skipped: usize,
}

impl Discrepancy {
    /// [`Failure::Discrepant`] if it is larger than a tolerance.
    pub fn within(&self, law: &'static str, tolerance: f64) -> Result<(), Failure> {
        if self.relative <= tolerance {
            return Ok(());
        }
        let (relative, q) = (self.relative, self.q.clone());
        Err(Failure::Discrepant { law, relative, tolerance, q })
    }

    /// Takes in a difference; one that is not a number is an infinite one.
    pub(super) fn add(&mut self, relative: f64, q: &[f64]) {
        let relative = if relative.is_nan() { f64::INFINITY } else { relative };
        if relative >= self.relative {
            self.relative = relative;
            self.q = q.to_vec();
        }
    }
}

/// How a manipulator breaks a law.
#[derive(Clone, Debug, PartialEq)]
pub enum Failure {
    /// It could not be evaluated at a configuration within its limits.
    Evaluation {
        /// The joint variables.
        q: Vec<f64>,
        /// Why.
        error: Error,
    },
    /// It gave NaN or infinity without saying so.
    NotFinite {
        /// The method.
        method: &'static str,
        /// The joint variables.
        q: Vec<f64>,
    },
    /// It took NaN, or a slice of the wrong length, without saying so.
    Unguarded {
        /// The method.
        method: &'static str,
        /// What it took.
        input: &'static str,
    },
    /// Fewer than half of the configurations are far enough from Euler singularities to be compared.
    Skipped {
        /// How many were left out.
        skipped: usize,
        /// Of how many.
        samples: usize,
    },
    /// Two ways to compute the same differ.
    Discrepant {
        /// What differs.
        law: &'static str,
        /// By how much, relative.
        relative: f64,
        /// How much it may be.
        tolerance: f64,
        /// The joint variables where it differs most.
        q: Vec<f64>,
    },
    /// The first-order remainder does not fall with the square of the errors.
    Slope {
        /// The slope instead of 2.
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
                write!(f, "{method} gives a value that is not finite at q = {q:?}")
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
