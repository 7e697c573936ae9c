//! Reports as plain text, at most 100 wide: what a terminal and an interpreter of Python print.
//!
//! One file for each job, and one function from its report to text; `table` is what they are set with.

mod alike;
mod analysis;
mod bound;
mod check;
mod compensation;
mod doctor;
mod exported;
mod identification;
mod imported;
mod jacobian;
mod list;
pub(crate) mod measurement;
pub(crate) mod monitoring;
mod plan;
mod table;

pub use analysis::analysis;
pub use bound::bound;
pub use check::check;
pub use compensation::compensation;
pub use doctor::doctor;
pub use exported::exported;
pub use identification::{full_identification, identification};
pub use imported::imported;
pub use jacobian::jacobian;
pub use list::list;
pub use measurement::measurement;
pub use monitoring::monitoring;
pub use plan::plan;
pub use table::{Table, WIDTH, listed, wrapped};
