//! The configurations over which errors are analyzed: made one by one when they are needed, never stored.

use core::ops::Range;

use super::Configuration;
use crate::ReachError;
use abbe_core::lanes::Tiles;

/// The configurations over which errors are analyzed, by index.
///
/// Each follows from its index alone, so that any part of the workspace can be made again, on any thread, and
/// none need be stored.
pub trait Workspace: Sync {
    /// How many configurations are asked for, those that cannot be reached among them.
    fn len(&self) -> usize;

    /// Whether none is asked for.
    fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// The configuration that errors relative to home are relative to; it says how long `q`, `s` and `u` are.
    fn home(&self) -> &Configuration;

    /// Writes configuration `index`, less than [`len`](Self::len), over one that is as long as that of home. If it
    /// cannot be had, that holds what was asked for.
    fn fill(&self, index: usize, configuration: &mut Configuration) -> Result<(), ReachError>;

    /// Shows those configurations one after the other, each by its place in the list, as [`fill`](Self::fill) writes it: for
    /// workspaces that make several sooner than one by one. Whoever is shown one may change it.
    #[allow(clippy::type_complexity)]
    fn fill_each(
        &self,
        indices: &[usize],
        show: &mut dyn FnMut(usize, &mut Configuration, Result<(), ReachError>),
    ) {
        let mut configuration = self.home().clone();
        for (place, index) in indices.iter().enumerate() {
            let filled = self.fill(*index, &mut configuration);
            show(place, &mut configuration, filled);
        }
    }

    /// Writes what differs from home in the configurations of a range into rows q, s, u of `rows`, which hold those of
    /// home, if all can be had and this is quicker than one by one; says whether it did.
    fn fill_rows(&self, _range: Range<usize>, _rows: &mut Tiles) -> bool {
        false
    }

    /// The point of `F_0` that the tool is brought to in configuration `index`, if that differs from one to the next.
    fn point(&self, _index: usize) -> Option<[f64; 3]> {
        None
    }

    /// Configuration `index`, or why it cannot be had.
    fn configuration(&self, index: usize) -> Result<Configuration, ReachError> {
        let mut configuration = self.home().clone();
        self.fill(index, &mut configuration)?;
        Ok(configuration)
    }

    /// All configurations that can be reached, stored: for small workspaces.
    fn reached(&self) -> Vec<Configuration> {
        let indices: Vec<usize> = (0..self.len()).collect();
        let mut reached = Vec::new();
        self.fill_each(&indices, &mut |_, configuration, filled| {
            reached.extend(filled.ok().map(|()| configuration.clone()));
        });
        reached
    }
}

/// A workspace of one configuration.
pub(crate) struct One<'a>(pub(crate) &'a Configuration);

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
