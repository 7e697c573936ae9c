//! Grids of joint variables.

use super::axis::{combinations, combine};
use super::{Axis, Workspace};
use crate::Configuration;
use crate::ReachError;
use crate::SumLimits;
use crate::configuration::in_range;
use abbe_core::{Error, Manipulator, Quantity};

/// Workspace of a grid of joint variables; see [`joint_grid`].
#[derive(Clone, Debug)]
pub struct JointGrid {
    home: Configuration,
    axes: Vec<Axis>,
    sums: SumLimits,
}

/// Creates the workspace of every combination of the values of some variables, the last one
/// fastest. The other variables stay at home, or follow those where a sum is fixed.
///
/// Parameters and inputs are nominal; [`with_inputs`](super::with_inputs) varies the inputs.
/// Returns [`Error::Count`] if an axis has an invalid index.
pub fn joint_grid(manipulator: &dyn Manipulator, axes: &[Axis]) -> Result<JointGrid, Error> {
    let description = manipulator.description();
    let indices = axes.iter().map(|axis| axis.index);
    in_range(indices, Quantity::Variables, description.variables.len())?;
    let named = |i: &usize| axes.iter().any(|axis| axis.index == *i);
    let others: Vec<usize> = (0..description.variables.len()).rev().filter(|i| !named(i)).collect();
    let sums = SumLimits::new(description, &others);
    Ok(JointGrid { home: Configuration::home(description), axes: axes.to_vec(), sums })
}

impl Workspace for JointGrid {
    fn len(&self) -> usize {
        combinations(&self.axes)
    }

    fn home(&self) -> &Configuration {
        &self.home
    }

    fn fill(&self, index: usize, configuration: &mut Configuration) -> Result<(), ReachError> {
        configuration.copy_from(&self.home);
        combine(index, &self.axes, &mut configuration.q);
        self.sums.lead(&mut configuration.q);
        self.sums.check(&configuration.q)
    }
}
