//! Reports as plain text, at most 100 wide: what a terminal and an interpreter of Python print.

mod analysis;
mod table;

pub use analysis::analysis;
pub use table::{Table, WIDTH, listed, wrapped};
