//! The options of a plan.

use abbe::identify::Criterion;

use crate::options::{Choices, Number};

/// Number of configurations that are chosen.
pub const COUNT: Number<usize> = Number { default: 50, range: 1..=5000 };

/// Number of samples that they are chosen from.
pub const CANDIDATES: Number<usize> = Number { default: 500, range: 1..=1_000_000 };

/// What is made small or large.
pub const CRITERIA: Choices<Criterion> = Choices(&[
    (Criterion::Variance, "v", "V-optimal: the tool point is known best where it is used"),
    (Criterion::Determinant, "d", "D-optimal"),
]);

/// What is optimal if nothing is said.
pub const CRITERION: Criterion = Criterion::Variance;
