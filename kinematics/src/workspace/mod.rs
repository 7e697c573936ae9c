//! Sets of configurations over which errors are analyzed.
//!
//! A [`Workspace`] generates configurations by index: grids and samples of joints, a volume of tool
//! points presented at one point, a box of points, poses of a platform, or a list, each with
//! optional values of inputs. Unreachable configurations are counted by reason.

mod axis;
mod base_box;
mod configuration_list;
mod configurations;
mod joint_grid;
mod joint_samples;
mod platform_grid;
mod presented_volume;
mod subset;
mod unreachable;
mod with_inputs;

pub use axis::Axis;
pub use base_box::{BaseBox, ReachedBox, ToolOrientation, base_box};
pub use configuration_list::{Listed, listed};
pub use configurations::{One, Show, Workspace};
pub use joint_grid::{JointGrid, joint_grid};
pub use joint_samples::{JointSamples, STREAM, joint_samples, random_joint_samples};
pub use platform_grid::{Legs, PlatformGrid, platform_grid};
pub use presented_volume::{Presentation, PresentedVolume, presented_volume};
pub use subset::Subset;
pub use unreachable::Unreachable;
pub use with_inputs::{WithInputs, with_inputs};
