//! `ΔX = J_e ε` of every source at one configuration.

use core::fmt;

use crate::Configuration;
use abbe_core::{Error, Pose};

/// Error of a configuration of the workspace that cannot be evaluated.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Unevaluated {
    /// Index of the configuration. `None` for the home configuration.
    pub configuration: Option<usize>,
    /// Cause.
    pub error: Error,
}

impl fmt::Display for Unevaluated {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.configuration {
            Some(index) => write!(f, "configuration {index}: {}", self.error),
            None => write!(f, "home configuration: {}", self.error),
        }
    }
}

impl core::error::Error for Unevaluated {}

/// Errors of the sources at one configuration, to first order.
///
/// Rows 1–3 of deviations are in the length unit and in `F_0`, rows 4–6 in rad as the manipulator's
/// orientation says.
#[derive(Clone, Copy, Debug)]
pub struct Row<'a> {
    /// Index of the configuration in the workspace. Unreachable ones are skipped.
    pub index: usize,
    /// Configuration.
    pub configuration: &'a Configuration,
    /// Nominal pose of the tool point in `F_0`, equation (3).
    pub pose: Pose,
    /// `true` if rows 4–6 exist. Where Euler angles are singular, they are 0 in all deviations.
    pub oriented: bool,
    /// ΔX of each source: with its sign for a repeatable one; the bound (half-width or 3σ), of
    /// unknown overall sign, for a random one.
    pub sources: &'a [[f64; 6]],
    /// Sum of the repeatable sources.
    pub repeatable: [f64; 6],
    /// Root sum of squares of the random sources, row by row.
    pub random: [f64; 6],
    /// Root sum of squares of their norms, of rows 1–3 and of rows 4–6. An error with several parts
    /// has its largest norm, less than the norm of its largest rows.
    pub random_norms: [f64; 2],
}
