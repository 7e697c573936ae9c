//! Tool point error that a figure shows, and its configuration.

use abbe::analysis::sampling::norm;

/// Error of three rows: the signed repeatable part, and the bound ± of the random part.
#[derive(Clone, Copy, Debug)]
pub(super) struct Errors {
    pub(super) repeatable: [f64; 3],
    pub(super) random: [f64; 3],
    /// Norm of the random part.
    pub(super) random_norm: f64,
}

impl Errors {
    /// Returns the sum of both norms, as in the combined radius.
    pub(super) fn norm(&self) -> f64 {
        norm(self.repeatable) + self.random_norm
    }
}
