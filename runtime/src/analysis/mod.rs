//! The errors of a machine over its workspace: section 5 of the paper, on any [`Manipulator`](crate::Manipulator).
//!
//! A [`Workspace`] makes configurations by index: joint grids and samples, a presented volume or a box solved by
//! [`inverse()`], a list. [`sweep`] evaluates it block by block, in parallel, and shows every [`Row`] in order;
//! nothing is stored. [`error_budget`] gathers what every source does alone ([`SourceErrors`]) and what they do
//! together ([`Combined`]), [`Compensation`] what is left, [`Admissible`] what a tolerance allows. [`monte_carlo`]
//! draws errors on the exact chain, [`corrected()`] commands compensate them. [`identifiable()`] counts which generalized errors measurements can tell apart.

mod budget;
mod identifiable;
mod random;
mod reach;
pub mod sampling;
mod sweep;
mod workspace;

#[cfg(test)]
pub(crate) mod by_hand;
#[cfg(test)]
mod tests;

pub use budget::{
    Admissible, Budget, CHI_SQUARED_95, Combined, Compensation, Ellipsoid, Extreme, Figures, Residual,
    SourceErrors, Sphere, Watch, covariance, error_budget, variance,
};
pub use identifiable::{Identifiability, Measurement, RANK_THRESHOLD, identifiable};
pub use random::{MonteCarlo, Quantile, monte_carlo};
pub use reach::{Target, Unreached, corrected, inverse};
pub use sweep::{BLOCK, Row, Sweepable, Unevaluated, sweep};
pub use workspace::{
    Axis, BaseBox, Configuration, JointGrid, JointSamples, Listed, Presentation, PresentedVolume, ReachedBox,
    Scattered, ToolOrientation, Unreachable, Unreachables, Workspace, base_box, joint_grid, joint_samples,
    listed, presented_volume, random_joint_samples,
};
