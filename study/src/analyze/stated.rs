//! An uncertainty budget of a workspace.

use abbe::analysis::Statement;

/// A budget, and where it holds: where the combined standard uncertainty of the norm is largest.
#[derive(Clone, Debug)]
pub struct Stated {
    /// The budget.
    pub statement: Statement,
    /// Index of the configuration.
    pub configuration: Option<usize>,
}
