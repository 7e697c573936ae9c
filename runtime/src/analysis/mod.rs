//! The errors of a machine over its workspace: section 5 of the paper, on any [`Manipulator`](crate::Manipulator).
//!
//! [`sampling`] chooses numbers, [`inverse()`] presents tool points, and together they make a [`Workspace`].
//! [`sweep`] evaluates it block by block; [`error_budget`] gathers what every source does alone
//! ([`SourceErrors`]) and what they do together ([`Combined`]). [`identifiable()`] counts which generalized
//! errors measurements can tell apart. `inverse`, `presented_volume` and `identifiable` need the feature
//! `nalgebra`.

mod budget;
mod combined;
#[cfg(feature = "nalgebra")]
mod identifiable;
#[cfg(feature = "nalgebra")]
mod inverse;
#[cfg(feature = "nalgebra")]
mod presented;
pub mod sampling;
mod single;
mod sweep;
mod unreached;
mod workspace;

#[cfg(test)]
pub(crate) mod pps_by_hand;
#[cfg(test)]
pub(crate) mod puma_by_hand;
#[cfg(all(test, feature = "nalgebra"))]
mod tests;

pub use budget::{Budget, error_budget};
pub use combined::{Combined, Extreme};
#[cfg(feature = "nalgebra")]
pub use identifiable::{Identifiability, Measurement, RANK_THRESHOLD, identifiable};
#[cfg(feature = "nalgebra")]
pub use inverse::{Target, inverse};
#[cfg(feature = "nalgebra")]
pub use presented::{Presentation, presented_volume};
pub use single::{Figures, SourceErrors};
pub use sweep::{BLOCK, Row, Unevaluated, sweep};
pub use unreached::Unreached;
pub use workspace::{Axis, Configuration, Unreachable, Workspace, joint_grid, joint_samples};
