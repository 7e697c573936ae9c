//! Options of a compensation.

/// Default tolerance of the tool point.
pub const TOLERANCE: &str = "0.001mm";
