//! The error budget of a workspace, its options, and who looks on.

use super::{Combined, RemainingErrors, Residual, SourceErrors};
use crate::sweep::Row;
use crate::{Measurand, UnreachableSummary};

/// What the sources of a manipulator do over a workspace, to first order.
#[derive(Clone, Debug, PartialEq)]
pub struct Budget {
    /// Each source alone, in the order of the description.
    pub sources: Vec<SourceErrors>,
    /// All together.
    pub combined: Combined,
    /// By how much the radius shrinks if a source is made smaller by one percent, in the length unit. Less than
    /// nothing where it counteracts the others.
    pub gains: Vec<f64>,
    /// The same figures of rows 4–6.
    pub orientation: OrientationErrors,
    /// Indices of the configurations at which the tolerances of position and orientation are least likely met, by an
    /// approximation, the least first; no more than 32, and none without a tolerance.
    pub least_likely: [Vec<usize>; 2],
    /// What is left after compensation, if it was asked for.
    pub compensation: Option<RemainingErrors>,
    /// How many configurations were reached and evaluated.
    pub configurations: usize,
    /// Those that could not be reached.
    pub unreachable: UnreachableSummary,
}

impl Budget {
    /// The figures of a measurand: each source alone, all together, and the gains.
    pub fn errors(&self, measurand: Measurand) -> (&[SourceErrors], &Combined, &[f64]) {
        match measurand {
            Measurand::Position => (&self.sources, &self.combined, &self.gains),
            Measurand::Orientation => {
                let OrientationErrors { sources, combined, gains } = &self.orientation;
                (sources, combined, gains)
            }
        }
    }

    /// Where the tolerance of a measurand is least likely met, [`least_likely`](Self::least_likely) of it.
    pub fn least_likely_of(&self, measurand: Measurand) -> &[usize] {
        &self.least_likely[measurand as usize]
    }
}

/// Options of a budget.
#[derive(Clone, Copy, Debug, Default)]
pub struct BudgetOptions<'a> {
    /// What compensation leaves of each source, none of random ones; nothing if there is no compensation.
    pub residuals: Option<&'a [Option<Residual>]>,
    /// How large the norms of the errors of position (length unit) and orientation (rad) may be, if that is said.
    pub tolerances: [Option<f64>; 2],
}

/// What the sources do to the orientation of the tool over a workspace: rows 4–6, rad.
#[derive(Clone, Debug, PartialEq)]
pub struct OrientationErrors {
    /// Each source alone, in the order of the description.
    pub sources: Vec<SourceErrors>,
    /// All together.
    pub combined: Combined,
    /// By how much the radius shrinks if a source is made smaller by one percent.
    pub gains: Vec<f64>,
}

/// Who looks on while a budget is made. `()` does not.
pub trait Watch {
    /// Whether every configuration is to be shown: it takes longer than the budget itself.
    fn rows(&self) -> bool {
        false
    }
    /// A configuration that was reached; in order.
    fn row(&mut self, _row: &Row) {}
    /// All configurations before this one are done with; whether to go on. Who ends it gets the budget of these.
    fn done(&mut self, _before: usize) -> bool {
        true
    }
}

impl Watch for () {}

/// Every configuration is shown to a function.
impl<F: FnMut(&Row)> Watch for F {
    fn rows(&self) -> bool {
        true
    }

    fn row(&mut self, row: &Row) {
        self(row);
    }
}
