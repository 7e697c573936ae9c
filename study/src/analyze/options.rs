//! The options of an analysis.

use std::ops::RangeInclusive;

/// Numbers of draws.
pub const DRAWS: RangeInclusive<usize> = 1..=10_000_000;
