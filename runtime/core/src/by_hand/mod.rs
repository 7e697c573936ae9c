//! Two robots written by hand: what tests of the analysis and of laws are about.

mod pps;
mod puma;

pub(crate) use pps::Pps;
pub(crate) use puma::Puma;
