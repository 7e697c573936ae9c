//! Sets of configurations over which errors are analyzed.
//!
//! A [`Workspace`] generates configurations by index: grids and samples of joints, a volume of tool
//! points presented at one point, a box of points, poses of a platform, or a list, each with
//! optional values of inputs. Unreachable configurations are counted by reason.

mod base_box;
mod configurations;
mod grids;
mod joint_samples;

pub use base_box::{BaseBox, ReachedBox, ToolOrientation, base_box};
pub use configurations::{Show, Subset, Unreachable, Workspace, listed, one};
pub use grids::{
    Axis, Legs, Presentation, WithInputs, joint_grid, platform_grid, presented_volume, with_inputs,
};
pub use joint_samples::{JointSamples, STREAM, joint_samples, random_joint_samples};
