//! The configurations over which errors are analyzed.

use super::{Unreached, sampling};
use crate::{Description, Error, Manipulator, Quantity};

/// A configuration: joint variables, and the structural parameters (the tool point is one of those).
#[derive(Clone, Debug, PartialEq)]
pub struct Configuration {
    /// The joint variables.
    pub q: Vec<f64>,
    /// The structural parameters.
    pub s: Vec<f64>,
}

impl Configuration {
    /// The home configuration with nominal parameters.
    pub fn home(description: &Description) -> Self {
        Self { q: sampling::home(description), s: sampling::nominal_parameters(description) }
    }

    /// `d1 = 1128, q4 = 0.5, x = 250`: its variables, and those parameters that are not nominal.
    pub fn label(&self, description: &Description) -> String {
        let variables = description.variables.iter().zip(&self.q);
        let variables = variables.map(|(variable, value)| format!("{} = {value}", variable.name));
        let parameters = description.parameters.iter().zip(&self.s);
        let parameters = parameters
            .filter(|(parameter, value)| parameter.nominal != **value)
            .map(|(parameter, value)| format!("{} = {value}", parameter.name));
        variables.chain(parameters).collect::<Vec<_>>().join(", ")
    }
}

/// A configuration that was asked for and could not be had.
#[derive(Clone, Debug, PartialEq)]
pub struct Unreachable {
    /// What was asked for; the variables to be solved for are where the search began.
    pub asked: Configuration,
    /// Why it could not be had.
    pub reason: Unreached,
}

/// The configurations over which errors are analyzed.
#[derive(Clone, Debug, PartialEq)]
pub struct Workspace {
    /// The configurations, in the order in which they were asked for.
    pub configurations: Vec<Configuration>,
    /// The configuration that errors relative to home are relative to.
    pub home: Configuration,
    /// What was asked for and could not be had.
    pub unreachable: Vec<Unreachable>,
}

/// The values that one variable or one parameter goes through.
#[derive(Clone, Debug, PartialEq)]
pub struct Axis {
    /// Which of them, from 0.
    pub index: usize,
    /// The values: the length unit, or rad.
    pub values: Vec<f64>,
}

/// `count` samples of the joints in `moved`, spread evenly within their limits; the others stay at home.
///
/// Parameters are nominal. [`Error::Count`] if `moved` names a variable that there is not.
pub fn joint_samples(
    manipulator: &dyn Manipulator,
    moved: &[usize],
    count: usize,
) -> Result<Workspace, Error> {
    let description = manipulator.description();
    in_range(moved.iter().copied(), Quantity::Variables, description.variables.len())?;
    let home = Configuration::home(&description);
    let arm = sampling::arm_length(manipulator, &home.s)?;
    let sample = |index| Configuration {
        q: sampling::joint_sample(&description, arm, moved, index),
        s: home.s.clone(),
    };
    let configurations = (0..count).map(sample).collect();
    Ok(Workspace { configurations, home, unreachable: Vec::new() })
}

/// Every combination of the values of some variables, the last one fastest; the others stay at home.
///
/// Parameters are nominal. [`Error::Count`] if an axis names a variable that there is not.
pub fn joint_grid(manipulator: &dyn Manipulator, axes: &[Axis]) -> Result<Workspace, Error> {
    let description = manipulator.description();
    let indices = axes.iter().map(|axis| axis.index);
    in_range(indices, Quantity::Variables, description.variables.len())?;
    let home = Configuration::home(&description);
    let configuration = |q| Configuration { q, s: home.s.clone() };
    let configurations = combinations(&home.q, axes).map(configuration).collect();
    Ok(Workspace { configurations, home, unreachable: Vec::new() })
}

/// `values` with every combination of the axes' values put in, the last axis fastest.
pub(super) fn combinations(values: &[f64], axes: &[Axis]) -> impl Iterator<Item = Vec<f64>> {
    let count = axes.iter().map(|axis| axis.values.len()).product::<usize>();
    (0..count).map(move |mut number| {
        let mut combination = values.to_vec();
        for axis in axes.iter().rev() {
            combination[axis.index] = axis.values[number % axis.values.len()];
            number /= axis.values.len();
        }
        combination
    })
}

/// [`Error::Count`] if an index is `count` or more.
pub(super) fn in_range(
    indices: impl Iterator<Item = usize>,
    quantity: Quantity,
    count: usize,
) -> Result<(), Error> {
    match indices.max() {
        Some(largest) if largest >= count => {
            Err(Error::Count { quantity, expected: count, found: largest + 1 })
        }
        _ => Ok(()),
    }
}
