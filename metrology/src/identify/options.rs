//! Options of an identification.

use std::{fmt, str::FromStr, time::Duration};

use abbe::identify::Loss;

use super::{Family, Prior};
use abbe_study::options::{Choices, NumericOption, share};

/// Number of parts for cross-validation.
pub const FOLDS: NumericOption<usize> = NumericOption { default: 10, range: 2..=1000 };

/// Loss functions for residuals.
pub const LOSSES: Choices<Loss> =
    Choices(&[(Loss::Squares, "none", ""), (Loss::Huber, "huber", ""), (Loss::Tukey, "tukey", "")]);

/// Parts that can be fitted alone.
pub const ONLY: Choices<bool> = Choices(&[(
    true,
    "placement",
    "The places of the machine, the instruments and the targets, and the camera: no error of the machine",
)]);

/// Families of richer terms.
pub const TERMS: Choices<&[Family]> = Choices(&[
    (&Family::ALL, "auto", "All of the following"),
    (
        &[Family::Joint],
        "joint",
        "Errors that vary with the frame's own joint: one to four cycles per turn, or \
         proportional to its travel",
    ),
    (
        &[Family::Load],
        "load",
        "Errors proportional to an input, such as a load, a temperature or a motor current",
    ),
    (&[Family::Elastic], "elastic", "Rotations proportional to the moment of weights"),
    (
        &[Family::Backlash],
        "backlash",
        "Joint errors that depend on the direction of approach, or on the sign of the weight's \
         moment",
    ),
    (&[Family::Product], "product", "Joint errors that depend on one or two other joints"),
    (
        &[Family::Drift],
        "drift",
        "Errors that vary with time along the file; they are not written to the spec",
    ),
    (
        &[Family::Profile],
        "profile",
        "Joint errors as functions of the joint, by up to 64 cycles per turn, as tables; best from \
         hundreds of points over whole turns",
    ),
]);

/// Returns the name of a family in [`TERMS`].
pub(super) fn family_name(family: Family) -> &'static str {
    TERMS.0.iter().find(|(families, ..)| *families == [family]).map_or("", |(_, name, _)| name)
}

/// Settings of an identification.
#[derive(Clone, Debug)]
pub struct Settings {
    /// Loss function for residuals.
    pub loss: Loss,
    /// Fits the places of the machine, the instruments and the targets alone, and no error of the
    /// machine.
    pub only_placement: bool,
    /// Expected size of errors.
    pub prior: Prior,
    /// Number of parts for cross-validation.
    pub folds: usize,
    /// Time limit for trying richer terms. The result then depends on the computer. No limit if
    /// none.
    pub time: Option<Duration>,
    /// Keeps the residuals of every point, for plots.
    pub points: bool,
}

impl Settings {
    /// Returns whether errors of frames are held at zero.
    pub(super) fn holds_errors(&self) -> bool {
        self.only_placement || self.prior.share() == 0.0
    }
}

impl Default for Settings {
    fn default() -> Self {
        let (loss, prior) = Default::default();
        Self { loss, only_placement: false, prior, folds: FOLDS.default, time: None, points: false }
    }
}

/// Parses `spec`, `auto`, or a share from 0 to 1.
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
