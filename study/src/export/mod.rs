//! `abbe export`: a machine with its repeatable errors in files that controllers and other programs
//! load. `abbe_exchange` has the formats.

mod job;
mod options;

pub use abbe_exchange::export::{ExportReport as Report, ExportedFile, Figure, PoseDifference, RotaryAxis};
pub use abbe_exchange::urdf::Ends;
pub use abbe_exchange::{FORMATS, Format, FormatMismatch, Needs};

pub use self::job::Export;
pub use self::options::{SAMPLES, SAMPLES_RANGE};
