//! Configurations of a manipulator: workspaces and their samples, and the joint variables that
//! bring the tool to a target, for any [`Manipulator`](abbe_core::Manipulator).
//!
//! | module | contents |
//! |---|---|
//! | `workspace` | [`Workspace`]: configurations by index, as grids and samples of joints, a presented volume, a box, a list |
//! | `configuration` | [`Configuration`]: joint variables, structural parameters and inputs |
//! | `reach` | [`inverse()`] brings the tool to a target, [`InverseKinematics`] finds all solutions, [`compensated()`] the real tool; [`obstacle()`] explains a remaining error |
//! | [`sampling`] | sample points and random errors, the same on every machine |
//! | [`decompose`] | singular values and eigenvectors |

mod configuration;
pub mod decompose;
mod reach;
pub mod sampling;
mod workspace;

#[cfg(test)]
#[path = "../../runtime/core/src/laws/tests/by_hand/mod.rs"]
mod by_hand;

pub use configuration::Configuration;
pub use reach::{
    Goal, InverseKinematics, Missing, Obstacle, ReachError, Target, compensated, inverse, mobility, obstacle,
};
use reach::{Inverse, SumLimits};
pub use workspace::{
    Axis, BaseBox, JointSamples, Legs, Presentation, ReachedBox, STREAM, Show, Subset, ToolOrientation,
    Unreachable, WithInputs, Workspace, base_box, joint_grid, joint_samples, listed, one, platform_grid,
    presented_volume, random_joint_samples, with_inputs,
};
