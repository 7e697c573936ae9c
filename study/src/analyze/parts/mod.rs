//! An analysis divided over several machines. Each sweeps a share of the workspace, and the merged
//! report is byte for byte that of a single run.
//!
//! `request` holds the options and file texts, `shard` identifies a share, and `part` holds its
//! data and has their format. `merge` combines the parts.

mod merge;
mod part;
mod request;
pub(super) mod shard;

pub use merge::Merge;
pub use part::Part;
pub use request::{AnalysisRequest, Change, FileText};
pub use shard::Shard;
