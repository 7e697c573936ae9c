//! The options of a simulation.

use crate::options::Number;

/// Number of random configurations, where no file has them.
pub const SAMPLES: Number<usize> = Number { default: 100, range: 1..=10_000_000 };

/// Share of rows that are grossly wrong.
pub const OUTLIERS: Number<f64> = Number { default: 0.0, range: 0.0..=1.0 };
