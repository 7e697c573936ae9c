//! Arguments that several commands have, and parsers of values.

#[macro_use]
mod help;
mod shared;
mod usage;
mod values;

pub(crate) use shared::{Changes, Common, Dated, Measured, Page, Running, Showing, Subject, Writing, study};
pub(crate) use usage::with_tip;
pub(crate) use values::{duration, length, named, share, whole};
