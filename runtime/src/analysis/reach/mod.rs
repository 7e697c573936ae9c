//! Joint variables that bring the tool to a target: the ideal tool, and the real one.

mod compensate;
mod inverse;
mod reach_error;

pub use compensate::compensated;
pub use inverse::{Target, inverse};
pub use reach_error::ReachError;
