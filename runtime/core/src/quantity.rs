//! Quantities that functions take and return.

use core::fmt;

/// Argument or result of a function, which an [`Error`](crate::Error) is about.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Quantity {
    /// The joint variables `q`.
    Variables,
    /// The passive variables `p`.
    Passive,
    /// The structural parameters `s`.
    Parameters,
    /// The inputs `u`.
    Inputs,
    /// A pose, or the transforms of a pose.
    Pose,
    /// A Jacobian.
    Jacobian,
    /// Generalized errors that the sources cause: one value per [`Effect`](crate::Effect).
    Effects,
    /// Generalized errors, six per frame, or their variances.
    Errors,
    /// Magnitudes of the sources: one value per source.
    Magnitudes,
    /// Rows of arguments of a batch.
    Arguments,
    /// Rows of results of a batch.
    Results,
    /// Configurations of a batch.
    Configurations,
    /// Lanes of a batch.
    Lanes,
    /// Displacement of the tool point, its covariance, or given variances.
    Displacement,
    /// Corrections of joint commands, and their bounds.
    Corrections,
    /// Weights of rotations that are to be reached.
    Rotations,
    /// Solutions of inverse kinematics.
    Solutions,
}

impl fmt::Display for Quantity {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Variables => "joint variable",
            Self::Passive => "passive variable",
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
            Self::Corrections => "correction",
            Self::Rotations => "rotation",
            Self::Solutions => "solution",
        })
    }
}
