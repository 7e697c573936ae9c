//! The options of an identification.

use std::fmt;
use std::str::FromStr;
use std::time::Duration;

use abbe::identify::Loss;

use super::families::Family;
use super::priors::Prior;
use crate::options::{Choices, Number, share};

/// Number of parts for cross-validation.
pub const FOLDS: Number<usize> = Number { default: 10, range: 2..=1000 };

/// What a residual costs.
pub const LOSSES: Choices<Loss> =
    Choices(&[(Loss::Squares, "none", ""), (Loss::Huber, "huber", ""), (Loss::Tukey, "tukey", "")]);

/// Families of richer terms.
pub const TERMS: Choices<&[Family]> = Choices(&[
    (&Family::ALL, "auto", "All that follow"),
    (
        &[Family::Joint],
        "joint",
        "Errors that change with a frame's own joint: one to four times per turn, or with its travel",
    ),
    (&[Family::Load], "load", "Errors in proportion to an input: a load, a temperature, a motor's current"),
    (&[Family::Elastic], "elastic", "Turns in proportion to the moment of weights"),
    (
        &[Family::Backlash],
        "backlash",
        "Errors of joints by the direction they came from, row by row, or in which a weight pulls",
    ),
    (&[Family::Product], "product", "Errors of joints with another joint, or with two"),
    (
        &[Family::Drift],
        "drift",
        "Errors that grow or settle from row to row: they are of the file, not of the machine",
    ),
]);

/// How an identification is done.
#[derive(Clone, Debug)]
pub struct Settings {
    /// What a residual costs.
    pub loss: Loss,
    /// How large errors are expected to be.
    pub prior: Prior,
    /// Into how many parts the rows are dealt, each left out in turn.
    pub folds: usize,
    /// How long richer terms are tried; then no further ones are, and what comes out depends on the computer. As long as it
    /// takes if there is none.
    pub time: Option<Duration>,
    /// Whether what is left of every point is kept, for pictures.
    pub points: bool,
}

impl Default for Settings {
    fn default() -> Self {
        Self { loss: Loss::Squares, prior: Prior::default(), folds: FOLDS.default, time: None, points: false }
    }
}

impl Default for Prior {
    /// A hundredth of the arm's length, and 0.01 rad.
    fn default() -> Self {
        Self::Share(Self::DEFAULT_SHARE)
    }
}

/// `spec`, `auto`, or a share from 0 to 1.
impl FromStr for Prior {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        match text {
            "spec" => Ok(Self::Spec),
            "auto" => Ok(Self::Auto),
            text => {
                let value = text.parse::<f64>().map_err(|error| error.to_string())?;
                Ok(Self::Share(share(value)?))
            }
        }
    }
}

impl fmt::Display for Prior {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Spec => f.write_str("spec"),
            Self::Auto => f.write_str("auto"),
            Self::Share(share) => write!(f, "{share}"),
        }
    }
}
