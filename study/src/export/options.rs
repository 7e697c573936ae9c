//! Options of an export.

use std::ops::RangeInclusive;

/// Default number of configurations at which poses are compared.
pub const SAMPLES: usize = 1000;

/// Range of that number.
pub const SAMPLES_RANGE: RangeInclusive<usize> = 1..=1_000_000;
