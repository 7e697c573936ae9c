//! The errors of a machine over its workspace: section 5 of the paper, on any [`Manipulator`](crate::Manipulator).
//!
//! A [`Workspace`] makes configurations by index: joint grids and samples, a presented volume or a box solved by
//! [`inverse()`], a list. [`sweep`] evaluates it block by block, in parallel, and shows every [`Row`] in order;
//! nothing is stored. [`error_budget`] gathers what every source does alone ([`SourceErrors`]) and what they do
//! together ([`Combined`]), [`Compensation`] what is left, [`Admissible`] what a tolerance allows. [`monte_carlo`]
//! draws errors on the exact chain, [`corrected()`] commands compensate them. [`identifiable()`] counts which generalized errors measurements can tell apart.

mod admissible;
mod base_box;
mod block;
mod budget;
mod combined;
mod compensation;
mod corrected;
mod covariance;
mod enclosing;
mod identifiable;
mod inverse;
mod joints;
mod monte_carlo;
mod peak;
mod presented;
mod quantiles;
pub mod sampling;
mod scattered;
mod single;
mod stream;
mod sweep;
mod tightening;
mod together;
mod unreachables;
mod unreached;
mod workspace;

#[cfg(test)]
pub(crate) mod pps_by_hand;
#[cfg(test)]
pub(crate) mod puma_by_hand;
#[cfg(test)]
mod tests;

pub use admissible::Admissible;
pub use base_box::{BaseBox, ReachedBox, ToolOrientation, base_box};
pub use budget::{Budget, Watch, error_budget};
pub use combined::{Combined, Extreme};
pub use compensation::{Compensation, Residual};
pub use corrected::corrected;
pub use covariance::{CHI_SQUARED_95, Ellipsoid, covariance, variance};
pub use enclosing::Sphere;
pub use identifiable::{Identifiability, Measurement, RANK_THRESHOLD, identifiable};
pub use inverse::{Target, inverse};
#[cfg(feature = "identify")]
pub(crate) use joints::stream;
pub use joints::{JointGrid, JointSamples, Listed, joint_grid, joint_samples, listed, random_joint_samples};
pub use monte_carlo::{MonteCarlo, monte_carlo};
pub use presented::{Presentation, PresentedVolume, presented_volume};
pub use quantiles::Quantile;
pub use scattered::Scattered;
pub use single::{Figures, SourceErrors};
pub use sweep::{BLOCK, Row, Unevaluated, sweep};
pub use unreachables::Unreachables;
pub use unreached::Unreached;
pub use workspace::{Axis, Configuration, Unreachable, Workspace};
