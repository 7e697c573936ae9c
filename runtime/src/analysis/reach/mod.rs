//! Joint variables that bring the tool to a target: the ideal tool, and the real one.

mod compensate;
mod inverse;
mod unreached;

pub use compensate::corrected;
pub use inverse::{Target, inverse};
pub use unreached::Unreached;
