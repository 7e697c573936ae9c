//! A workspace repeated for combinations of input values.

use core::ops::Range;

use super::grids::{combinations, combine};
use super::{Axis, Show, Workspace};
use crate::configuration::in_range;
use crate::{Configuration, ReachError};
use abbe_core::lanes::Tiles;
use abbe_core::{Error, Manipulator, Quantity};

/// Workspace repeated for combinations of input values; see [`with_inputs`].
pub struct WithInputs<'a> {
    workspace: Box<dyn Workspace + 'a>,
    inputs: Vec<Axis>,
}

/// Repeats a workspace for every combination of the inputs' values. The last input varies faster
/// than those before it, the configurations faster than all inputs.
///
/// Returns [`Error::Count`] if an axis has an invalid index. Values outside an input's range are
/// rejected on evaluation.
pub fn with_inputs<'a>(
    manipulator: &dyn Manipulator,
    workspace: Box<dyn Workspace + 'a>,
    inputs: Vec<Axis>,
) -> Result<WithInputs<'a>, Error> {
    let indices = inputs.iter().map(|axis| axis.index);
    in_range(indices, Quantity::Inputs, manipulator.description().inputs.len())?;
    Ok(WithInputs { workspace, inputs })
}

impl WithInputs<'_> {
    /// Returns the index in the original workspace, and the number of the combination of inputs.
    fn split(&self, index: usize) -> (usize, usize) {
        let count = self.workspace.len().max(1);
        (index % count, index / count)
    }
}

impl Workspace for WithInputs<'_> {
    fn len(&self) -> usize {
        self.workspace.len().saturating_mul(combinations(&self.inputs))
    }

    fn home(&self) -> &Configuration {
        self.workspace.home()
    }

    fn fill(&self, index: usize, configuration: &mut Configuration) -> Result<(), ReachError> {
        let (place, combination) = self.split(index);
        let filled = self.workspace.fill(place, configuration);
        combine(combination, &self.inputs, &mut configuration.u);
        filled
    }

    fn fill_each(&self, indices: &[usize], show: &mut Show<'_>) {
        let places: Vec<usize> = indices.iter().map(|index| self.split(*index).0).collect();
        self.workspace.fill_each(&places, &mut |place, configuration, filled| {
            combine(self.split(indices[place]).1, &self.inputs, &mut configuration.u);
            show(place, configuration, filled);
        });
    }

    fn fill_rows(&self, range: Range<usize>, rows: &mut Tiles) -> bool {
        let ((first, combination), (last, other)) = (self.split(range.start), self.split(range.end - 1));
        if combination != other || !self.workspace.fill_rows(first..last + 1, rows) {
            return false;
        }
        let Configuration { q, s, u } = self.home();
        let mut values = u.clone();
        combine(combination, &self.inputs, &mut values);
        for (i, value) in values.into_iter().enumerate() {
            rows.fill_row(q.len() + s.len() + i, value);
        }
        true
    }

    fn point(&self, index: usize) -> Option<[f64; 3]> {
        self.workspace.point(self.split(index).0)
    }
}
