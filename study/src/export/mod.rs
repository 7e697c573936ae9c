//! `abbe export`: a machine with its repeatable errors in files that controllers and other programs
//! load. `abbe_exchange` has the formats.

mod job;
mod options;

pub use abbe_exchange::export::{ExportReport as Report, ExportedFile, Figure, PoseDifference, RotaryAxis};

pub use self::job::Export;
pub use self::options::{Format, SAMPLES, SAMPLES_RANGE};
