//! The options of a compensation.

/// Length that may be left at the tool point if nothing is said.
pub const TOLERANCE: &str = "0.001mm";
