//! An analysis in parts, on as many machines as there are: each sweeps a share of the workspace, and the parts merge into the
//! report of one run, byte for byte.
//!
//! `question` is what is asked, with the texts of its files; `shard` which share of it; `part` what was gathered there, and
//! `file` how that is written. `merge` puts the parts together.

mod file;
mod merge;
mod part;
mod question;
pub(super) mod shard;

pub use merge::merge;
pub use part::Part;
pub use question::{Change, Question, Written};
pub use shard::Shard;
