//! Options of a bound.

use std::{fmt, str::FromStr};

use abbe_bound::Effort;

use crate::options::NumericOption;

/// Largest number of boxes that are evaluated for each error.
pub const BOXES: NumericOption<usize> =
    NumericOption { default: Effort::DEFAULT.boxes, range: 1..=100_000_000 };

/// Largest excess of the certified over the found error, as a share of the found error.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Gap(f64);

impl Gap {
    /// Creates a gap; fails unless it is greater than 0 and less than 10.
    pub fn new(share: f64) -> Result<Self, &'static str> {
        let is_gap = share > 0.0 && share < 10.0;
        if is_gap { Ok(Self(share)) } else { Err("a gap must be positive: `1%`, `0.1%`") }
    }

    /// Returns the gap as a share.
    pub fn share(self) -> f64 {
        self.0
    }
}

impl Default for Gap {
    fn default() -> Self {
        Self(Effort::DEFAULT.gap)
    }
}

/// Parses `1%` or `0.01`.
impl FromStr for Gap {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let (digits, unit) = text.trim().strip_suffix('%').map_or((text, 1.0), |digits| (digits, 0.01));
        let value = digits.trim().parse::<f64>().map_err(|error| error.to_string())?;
        Ok(Self::new(value * unit)?)
    }
}

impl fmt::Display for Gap {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}%", 100.0 * self.0)
    }
}
