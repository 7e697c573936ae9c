//! Options of an analysis.

use std::ops::RangeInclusive;

/// Valid numbers of Monte Carlo draws.
pub const DRAWS: RangeInclusive<usize> = 1..=10_000_000;
