//! The error budget of a workspace, its options, and its progress callbacks.

use super::{Combined, SourceErrors};
use crate::{Measurand, Row, UnreachableSummary};

/// Error budget: effects of the sources of a manipulator over a workspace, to first order.
#[derive(Clone, Debug, PartialEq)]
pub struct Budget {
    /// Figures of each source, in the order of the description.
    pub sources: Vec<SourceErrors>,
    /// Figures of all sources together.
    pub combined: Combined,
    /// Orientation errors, rows 4–6 of ΔX.
    pub orientation: OrientationErrors,
    /// Indices of the configurations at which the tolerances of position and orientation are least
    /// likely to be met, by an approximation, the least likely first, at most 32; and last that
    /// with the largest error at 95 %. None without a tolerance.
    pub least_likely: [Vec<usize>; 2],
    /// Number of configurations reached and evaluated.
    pub configurations: usize,
    /// Unreachable configurations.
    pub unreachable: UnreachableSummary,
}

impl Budget {
    /// Returns the figures of a measurand: each source, and all together.
    pub fn errors(&self, measurand: Measurand) -> (&[SourceErrors], &Combined) {
        match measurand {
            Measurand::Position => (&self.sources, &self.combined),
            Measurand::Orientation => (&self.orientation.sources, &self.orientation.combined),
        }
    }
}

/// Options of a budget.
#[derive(Clone, Copy, Debug, Default)]
pub struct BudgetOptions {
    /// Tolerances for the norms of the errors of position (length unit) and orientation (rad).
    pub tolerances: [Option<f64>; 2],
}

/// Errors of the orientation of the tool over a workspace: rows 4–6, in rad.
#[derive(Clone, Debug, PartialEq)]
pub struct OrientationErrors {
    /// Figures of each source, in the order of the description.
    pub sources: Vec<SourceErrors>,
    /// Figures of all sources together.
    pub combined: Combined,
    /// Number of configurations at which rows 4–6 exist: all reached ones but those where Euler
    /// angles are singular.
    pub configurations: usize,
    /// `true` if rows 4–6 exist at home. If not, `relative_to_home` of the sources has no meaning.
    pub at_home: bool,
}

/// Callbacks during the computation of a budget. `()` ignores them.
pub trait Watch {
    /// Returns whether to call [`row`](Self::row) for every configuration, which takes longer than
    /// the budget itself.
    fn rows(&self) -> bool {
        false
    }
    /// Receives the reached configurations in order, one per call.
    fn row(&mut self, _row: &Row) {}
    /// Reports that all configurations before this one are done. Returns whether to continue;
    /// otherwise the budget covers these configurations.
    fn done(&mut self, _before: usize) -> bool {
        true
    }
}

impl Watch for () {}

/// Calls the function for every configuration.
impl<F: FnMut(&Row)> Watch for F {
    fn rows(&self) -> bool {
        true
    }

    fn row(&mut self, row: &Row) {
        self(row);
    }
}
