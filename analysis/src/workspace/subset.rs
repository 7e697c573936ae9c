//! A few configurations from everywhere in a workspace.

use super::{Configuration, Workspace};
use crate::ReachError;

/// `1/φ`: its multiples modulo 1 are spread evenly, and fall in step with no grid.
const GOLDEN: f64 = 0.618_033_988_749_894_9;

/// At most `count` configurations of a workspace, spread over its indices; all of a smaller one.
pub struct Subset<'a> {
    /// The workspace.
    pub workspace: &'a dyn Workspace,
    /// How many of its configurations at most.
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

    fn fill_each(
        &self,
        indices: &[usize],
        show: &mut dyn FnMut(usize, &mut Configuration, Result<(), ReachError>),
    ) {
        let places: Vec<usize> = indices.iter().map(|index| self.place(*index)).collect();
        self.workspace.fill_each(&places, show);
    }
}

impl Subset<'_> {
    /// The index in the workspace itself.
    fn place(&self, index: usize) -> usize {
        let all = self.workspace.len();
        match all <= self.count {
            true => index,
            false => ((index as f64 * GOLDEN).fract() * all as f64) as usize,
        }
    }
}
