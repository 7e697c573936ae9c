//! Sets of configurations over which errors are analyzed: generated on demand, never stored.

use core::ops::Range;

use crate::Configuration;
use crate::ReachError;
use abbe_core::lanes::Tiles;

/// Function that is shown configurations: the position of one in a list, the configuration, and
/// whether it is reachable.
pub type Show<'a> = dyn FnMut(usize, &mut Configuration, Result<(), ReachError>) + 'a;

/// Set of configurations over which errors are analyzed, by index.
///
/// Each configuration depends on its index alone, so that any part of the workspace can be
/// regenerated, on any thread, and none is stored.
pub trait Workspace: Sync {
    /// Returns the number of configurations, including unreachable ones.
    fn len(&self) -> usize;

    /// Returns whether there are no configurations.
    fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Returns the home configuration: the reference of errors relative to home. Its `q`, `s` and
    /// `u` have the lengths of all configurations.
    fn home(&self) -> &Configuration;

    /// Overwrites `configuration`, which must have the lengths of home, with configuration `index`,
    /// less than [`len`](Self::len). If it is unreachable, `configuration` holds the requested
    /// values.
    fn fill(&self, index: usize, configuration: &mut Configuration) -> Result<(), ReachError>;

    /// Calls `show` with each of the configurations in turn, by its position in the list, as
    /// [`fill`](Self::fill) writes it. Overridden by workspaces that generate several faster than
    /// one by one. `show` may modify the configuration.
    fn fill_each(&self, indices: &[usize], show: &mut Show<'_>) {
        let mut configuration = self.home().clone();
        for (place, index) in indices.iter().enumerate() {
            let filled = self.fill(*index, &mut configuration);
            show(place, &mut configuration, filled);
        }
    }

    /// Writes what differs from home in a range of configurations to the rows q, s, u of `rows`,
    /// which hold those of home. Returns `false`, without effect, if some are unreachable or one by
    /// one is as fast.
    fn fill_rows(&self, _range: Range<usize>, _rows: &mut Tiles) -> bool {
        false
    }

    /// Returns the target point in `F_0` of configuration `index`, if targets vary.
    fn point(&self, _index: usize) -> Option<[f64; 3]> {
        None
    }

    /// Returns configuration `index`, or the reason why it is unreachable.
    fn configuration(&self, index: usize) -> Result<Configuration, ReachError> {
        let mut configuration = self.home().clone();
        self.fill(index, &mut configuration)?;
        Ok(configuration)
    }

    /// Returns all reachable configurations, for small workspaces.
    fn reached(&self) -> Vec<Configuration> {
        let indices: Vec<usize> = (0..self.len()).collect();
        let mut reached = Vec::new();
        self.fill_each(&indices, &mut |_, configuration, filled| {
            reached.extend(filled.ok().map(|()| configuration.clone()));
        });
        reached
    }
}

/// Workspace of a single configuration.
#[derive(Debug)]
pub struct One<'a>(pub &'a Configuration);

impl Workspace for One<'_> {
    fn len(&self) -> usize {
        1
    }

    fn home(&self) -> &Configuration {
        self.0
    }

    fn fill(&self, _: usize, configuration: &mut Configuration) -> Result<(), ReachError> {
        configuration.copy_from(self.0);
        Ok(())
    }
}
