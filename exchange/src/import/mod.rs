//! Parts that the readers of all formats share.
//!
//! A reader turns a file into a [`Chain`]: its joints with their `geometry`, and an
//! [`AngleRounding`] repairs angles that the file has rounded. `spec_writer` writes the chain as a
//! spec, and [`ImportReport`] compares the two.

mod angle_rounding;
pub(crate) mod chain;
pub(crate) mod geometry;
mod report;
mod spec_writer;

pub use self::angle_rounding::AngleRounding;
pub use self::chain::Chain;
pub use self::report::{ImportReport, ImportedFrame};
