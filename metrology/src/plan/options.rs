//! Options of a plan.

use abbe::identify::Criterion;

use abbe_study::options::{Choices, NumericOption};

/// Number of configurations to select.
pub const COUNT: NumericOption<usize> = NumericOption { default: 50, range: 1..=5000 };

/// Number of candidate samples to select from.
pub const CANDIDATES: NumericOption<usize> = NumericOption { default: 500, range: 1..=1_000_000 };

/// Optimality criteria.
pub const CRITERIA: Choices<Criterion> = Choices(&[
    (Criterion::Variance, "v", "V-optimal: smallest variance of the tool point at the configurations of use"),
    (Criterion::Determinant, "d", "D-optimal"),
]);

/// Default optimality criterion.
pub const CRITERION: Criterion = Criterion::Variance;
