//! Reports as plain text, at most 100 wide: what a terminal and an interpreter of Python print.

mod analysis;
mod bound;
mod doctor;
mod exported;
mod imported;
mod table;

pub use analysis::analysis;
pub use bound::bound;
pub use doctor::doctor;
pub use exported::exported;
pub use imported::imported;
pub use table::{Table, WIDTH, listed, wrapped};
