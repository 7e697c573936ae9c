//! Error budgets: the effect of every source over a workspace, and their combination.
//!
//! [`error_budget`] computes all of it in one sweep, in lanes. Each kind of figure has an
//! accumulator, which takes tile after tile, and a partial result, which merges chunk after chunk.

mod aligned_sums;
mod budget_sweep;
mod combined;
mod ellipsoid;
mod error_budget;
mod extreme;
mod least_likely;
mod over_signs;
mod partial_errors;
mod peak;
mod source_errors;
mod sums;

pub use budget_sweep::{BudgetSweep, Gap, PartialBudget, error_budget};
pub use combined::Combined;
pub use ellipsoid::{CHI_SQUARED_95, Ellipsoid, covariance, variance};
pub use error_budget::{Budget, BudgetOptions, OrientationErrors, Watch};
pub use extreme::{Extreme, comparable};
pub use source_errors::{Figures, SourceErrors};
