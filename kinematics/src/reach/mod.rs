//! Joint variables that bring the tool to a target: the ideal tool, and the real one.

mod bounded;
mod bounds;
mod compensate;
mod curvature;
mod descents;
mod extent;
mod generated;
mod inverse;
mod inverses;
mod joint_chain;
mod lane_chain;
mod obstacle;
mod pose_error;
mod reach_error;
mod real_tool;
mod search;
mod sum_limits;
mod target;
mod target_search;
#[cfg(test)]
mod tests;

pub use compensate::{Goal, compensated};
pub(crate) use inverse::Inverse;
pub use inverse::inverse;
pub use inverses::InverseKinematics;
pub use obstacle::{Missing, Obstacle, mobility, obstacle};
pub use reach_error::ReachError;
pub(crate) use sum_limits::SumLimits;
pub use target::Target;
