//! A configuration of a manipulator, and the range of its indices.

use abbe_core::{Description, Error, Quantity};

use crate::sampling;

/// Configuration: joint variables, structural parameters (which include the tool point), and
/// inputs.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Configuration {
    /// Joint variables.
    pub q: Vec<f64>,
    /// Structural parameters.
    pub s: Vec<f64>,
    /// Inputs.
    pub u: Vec<f64>,
}

impl Configuration {
    /// Returns the home configuration with nominal parameters and inputs.
    pub fn home(description: &Description) -> Self {
        Self {
            q: sampling::home(description),
            s: sampling::nominal_parameters(description),
            u: sampling::nominal_inputs(description),
        }
    }

    /// Copies another configuration of the same manipulator.
    pub(crate) fn copy_from(&mut self, other: &Self) {
        self.q.copy_from_slice(&other.q);
        self.s.copy_from_slice(&other.s);
        self.u.copy_from_slice(&other.u);
    }
}

/// Returns [`Error::Count`] if an index is `count` or more.
pub(crate) fn in_range(
    indices: impl Iterator<Item = usize>,
    quantity: Quantity,
    count: usize,
) -> Result<(), Error> {
    match indices.max() {
        Some(largest) if largest >= count => {
            Err(Error::Count { quantity, expected: count, found: largest + 1 })
        }
        _ => Ok(()),
    }
}
