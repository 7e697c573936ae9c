//! Error analysis of a machine over its workspace: section 5 of the paper, for any
//! [`Manipulator`](abbe_core::Manipulator).
//!
//! | folder | contents |
//! |---|---|
//! | `sweep` | [`sweep`] evaluates a workspace block by block, in parallel, and visits every [`Row`] in order; nothing is stored |
//! | `budget` | [`error_budget`]: the errors of every source ([`SourceErrors`]), and of all together ([`Combined`]) |
//! | `normal` | [`NormalVector`], [`StudentVector`]: probabilities and quantiles of the norm of an error with known or estimated variances |
//! | `uncertainty` | [`Statement`]: the uncertainty budget of the GUM at one configuration; [`ErrorDistribution`]: the probability that a tolerance is met; [`Machines`]: the share of machines that meet it everywhere |
//! | `allocation` | [`Allocator`]: factors of the sources at which a tolerance is kept at least cost |
//! | `parts` | [`ErrorParts`]: errors of several sources together, in a ball |
//! | `worst_case` | [`worst_case()`]: the largest error over all signs at one configuration |
//! | `random` | [`monte_carlo`]: Monte Carlo simulation on the exact chain |
//!
//! The configurations are those of [`abbe_kinematics`], which is a part of this module: workspaces
//! and inverse kinematics.
//!
//! [`identifiable()`] counts the generalized errors that measurements can identify,
//! [`identifiable_in_parts`] those of a chain of any length.
//!
//! Example: an error budget over 10,000 random configurations.
//!
//! ```
//! # include!(concat!(env!("CARGO_MANIFEST_DIR"), "/../tests/golden/pps.rs"));
//! # fn main() -> Result<(), Box<dyn core::error::Error>> {
//! use abbe::analysis::{BudgetOptions, error_budget, random_joint_samples};
//! use pps::{DESCRIPTION, Pps};
//!
//! let moved = [0, 1, 2, 3]; // the three slides and the spin; the other joints stay at home
//! let workspace = random_joint_samples(&Pps, &moved, 10_000, 1)?;
//! let budget = error_budget(&Pps, &workspace, BudgetOptions::default(), &mut ())?;
//! for errors in &budget.sources {
//!     println!("{}: {:.4} mm", DESCRIPTION.sources[errors.source].name, errors.plain_max.norm);
//! }
//! let largest = budget.combined.radius;
//! println!("all together: {:.3} mm in configuration {:?}", largest.value, largest.configuration);
//! # assert!(budget.configurations == 10_000 && largest.value > 5.0);
//! # Ok(())
//! # }
//! ```

mod allocation;
mod budget;
mod identifiable;
mod normal;
mod parts;
mod random;
mod sweep;
mod uncertainty;
mod worst_case;

#[cfg(test)]
#[path = "../../runtime/core/src/laws/tests/by_hand/mod.rs"]
mod by_hand;
#[cfg(test)]
mod tests;
#[cfg(test)]
#[path = "../../tests/src/thorough.rs"]
mod thorough;

pub use abbe_core::lanes::Sweepable;
pub use abbe_kinematics::*;
pub use allocation::{Allocation, AllocationCriterion, Allocator, ErrorRow, ScalableSource};
pub use budget::{
    Budget, BudgetOptions, BudgetSweep, CHI_SQUARED_95, Combined, Ellipsoid, Extreme, Figures, Gap,
    OrientationErrors, PartialBudget, SourceErrors, Watch, comparable, covariance, error_budget, variance,
};
pub use identifiable::{
    Identifiability, Measurement, Parts, RANK_THRESHOLD, identifiable, identifiable_in_parts,
};
pub use normal::{FLAT, NormalVector, PROBABILITY_ERROR, Principal, StudentVector};
pub use parts::{ErrorParts, Measurand};
pub use random::{MonteCarlo, Quantile, monte_carlo};
pub use sweep::{BLOCK, Row, Unevaluated, UnreachableSummary, in_order, in_order_until, sweep};
pub use uncertainty::{
    COVERAGE, Compliance, Contribution, Correction, DRAWS, ErrorDistribution, ErrorsAt, Machines, Residual,
    Statement, WorstCase, Yield, errors_at, student_95, student_factor,
};
pub use worst_case::worst_case;
