//! Unreachable configurations of a workspace.

use crate::Configuration;
use crate::ReachError;

/// Unreachable configuration of a workspace.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Unreachable {
    /// Index in the workspace.
    pub index: usize,
    /// Target point in `F_0`, if targets vary.
    pub point: Option<[f64; 3]>,
    /// Requested configuration. Variables to be solved hold their start values.
    pub requested: Configuration,
    /// Reason.
    pub reason: ReachError,
}
