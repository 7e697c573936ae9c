//! The errors of a real machine, as text: `brief` is a page, `full` is everything.

mod brief;
mod full;

pub use brief::identification;
pub use full::full_identification;
