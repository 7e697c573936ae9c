//! Options of a simulation.

use abbe_study::options::NumericOption;

/// Number of random configurations, without a file of commands.
pub const SAMPLES: NumericOption<usize> = NumericOption { default: 100, range: 1..=10_000_000 };

/// Share of rows that are outliers.
pub const OUTLIERS: NumericOption<f64> = NumericOption { default: 0.0, range: 0.0..=1.0 };
