//! Joint variables that bring the tool to a target: the ideal tool, and the real one.

mod bounded;
mod compensate;
mod inverse;
mod obstacle;
mod reach_error;
mod real_tool;

pub use compensate::compensated;
pub use inverse::{Target, inverse};
pub use obstacle::{Missing, Obstacle, mobility, obstacle};
pub use reach_error::ReachError;
