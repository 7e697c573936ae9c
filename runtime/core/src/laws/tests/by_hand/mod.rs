//! Two robots written by hand, for tests of the laws.

mod pps;
mod puma;

pub(crate) use pps::Pps;
pub(crate) use puma::Puma;
