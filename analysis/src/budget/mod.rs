//! What every source does alone over a workspace, what they do together, and what a tolerance allows.
//!
//! [`error_budget`] gathers all of it in one sweep, in lanes: each kind of figure has its `Lane`, which takes in tile after
//! tile, and what that comes to, which is merged chunk after chunk.

mod admissible;
mod aligned_sums;
mod budget_sweep;
mod combined;
mod ellipsoid;
mod enclosing_sphere;
mod error_budget;
mod gains;
mod gathering;
mod least_likely;
mod outline;
mod partial_budget;
mod peak;
mod remaining_errors;
mod source_errors;
mod sums;

pub use admissible::Admissible;
pub use budget_sweep::{BudgetSweep, error_budget};
pub use combined::{Combined, Extreme};
pub use ellipsoid::{CHI_SQUARED_95, Ellipsoid, covariance, variance};
pub use enclosing_sphere::Sphere;
pub use error_budget::{Budget, BudgetOptions, OrientationErrors, Watch};
pub use partial_budget::{Gap, PartialBudget};
pub use remaining_errors::{RemainingErrors, Residual};
pub use source_errors::{Figures, SourceErrors};
