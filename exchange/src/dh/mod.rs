//! Tables of Denavit-Hartenberg numbers, CSV.
//!
//! `read` takes a table, also as the Robotics Toolbox prints it, as a chain. `table` holds the
//! nominal numbers of a spec, and `write` those that fit the real machine best.

mod read;
mod table;
mod write;

pub(crate) use self::table::DhTable;
pub use self::{read::read, write::write};
pub use table::Units;
