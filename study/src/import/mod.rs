//! `abbe import`: a robot in another format as a spec. `abbe_exchange` has the formats.

mod job;
mod options;

pub use abbe_exchange::import::{ImportReport as Report, ImportedFrame};

pub use self::job::Import;
pub use self::options::{Format, Units};
