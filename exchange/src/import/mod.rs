//! Parts that the readers of all formats share.
//!
//! A reader turns a file into a [`Chain`], its joints with their geometry, and an
//! [`AngleRounding`] repairs angles that the file has rounded. `spec_writer` writes the chain as a
//! spec, and [`ImportReport`] compares the two.

pub(crate) mod chain;
mod report;
mod spec_writer;

pub use self::chain::Chain;
pub use self::report::{ImportReport, ImportedFrame};
pub use chain::AngleRounding;
