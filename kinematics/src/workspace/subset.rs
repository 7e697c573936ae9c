//! Evenly spread subsets of a workspace.

use super::{Show, Workspace};
use crate::Configuration;
use crate::ReachError;

/// `1/φ`: its multiples modulo 1 are evenly spread, and align with no grid.
const GOLDEN: f64 = 0.618_033_988_749_894_9;

/// Subset of at most `count` configurations of a workspace, spread over its indices. A smaller
/// workspace is kept whole.
pub struct Subset<'a> {
    /// Original workspace.
    pub workspace: &'a dyn Workspace,
    /// Largest number of configurations.
    pub count: usize,
}

impl Workspace for Subset<'_> {
    fn len(&self) -> usize {
        self.workspace.len().min(self.count)
    }

    fn home(&self) -> &Configuration {
        self.workspace.home()
    }

    fn fill(&self, index: usize, configuration: &mut Configuration) -> Result<(), ReachError> {
        self.workspace.fill(self.place(index), configuration)
    }

    fn fill_each(&self, indices: &[usize], show: &mut Show<'_>) {
        let places: Vec<usize> = indices.iter().map(|index| self.place(*index)).collect();
        self.workspace.fill_each(&places, show);
    }
}

impl Subset<'_> {
    /// Returns the index in the original workspace.
    pub fn place(&self, index: usize) -> usize {
        let all = self.workspace.len();
        match all <= self.count {
            true => index,
            false => ((index as f64 * GOLDEN).fract() * all as f64) as usize,
        }
    }
}
