//! Grids of joint variables.
//!
//! Axes of a grid: values of variables, parameters or inputs, and their combinations.
//!
//! Grids of passive variables, such as poses of a platform on legs.

use std::fmt;
use std::sync::Arc;

use abbe_core::{Error, Manipulator, Quantity};

use super::Workspace;
use super::configurations::Indexed;
use crate::configuration::in_range;
use crate::{Configuration, ReachError, SumLimits};

/// Creates the workspace of every combination of the values of some variables, the last one
/// fastest. The other variables stay at home, or follow those where a sum is fixed.
///
/// Parameters and inputs are nominal; [`with_inputs`](super::with_inputs) varies the inputs.
/// Returns [`Error::Count`] if an axis has an invalid index.
pub fn joint_grid(manipulator: &dyn Manipulator, axes: &[Axis]) -> Result<impl Workspace + use<>, Error> {
    let description = manipulator.description();
    let indices = axes.iter().map(|axis| axis.index);
    in_range(indices, Quantity::Variables, description.variables.len())?;
    let named = |i: &usize| axes.iter().any(|axis| axis.index == *i);
    let others: Vec<usize> = (0..description.variables.len()).rev().filter(|i| !named(i)).collect();
    let (axes, sums) = (axes.to_vec(), SumLimits::new(description, &others));
    let count = combinations(&axes);
    let fill = move |index: usize, configuration: &mut Configuration| {
        combine(index, &axes, &mut configuration.q);
        sums.lead(&mut configuration.q);
        sums.check(&configuration.q)
    };
    Ok(Indexed { home: Configuration::home(description), count, fill })
}

/// Values of one variable, parameter or input along an axis of a grid.
#[derive(Clone, Debug, PartialEq)]
pub struct Axis {
    /// Index of the variable, parameter or input, from 0.
    pub index: usize,
    /// Values in the length unit, rad, or coherent units.
    pub values: Vec<f64>,
}

/// Returns the number of combinations of the values of some axes.
pub(super) fn combinations(axes: &[Axis]) -> usize {
    axes.iter().map(|axis| axis.values.len()).fold(1, usize::saturating_mul)
}

/// Writes combination `number` of the axes' values to `values`, the last axis fastest. Returns the
/// quotient of the number by the number of combinations.
pub(super) fn combine(mut number: usize, axes: &[Axis], values: &mut [f64]) -> usize {
    for axis in axes.iter().rev() {
        let count = axis.values.len().max(1);
        if let Some(value) = axis.values.get(number % count) {
            values[axis.index] = *value;
        }
        number /= count;
    }
    number
}

type Lengths = dyn Fn(&[f64], &[f64]) -> Vec<f64> + Send + Sync;

/// Joint variables as a function of the passive variables and the parameters.
#[derive(Clone)]
pub struct Legs(pub Arc<Lengths>);

impl fmt::Debug for Legs {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("Legs")
    }
}

/// Creates the workspace of every combination of the values of some passive variables, the last one
/// fastest. The others stay where they are at home, and `legs` gives the joint variables.
///
/// A combination is unreachable if a joint variable is outside its limits, or if the machine has
/// other values of the passive variables there: those that it reaches continuously from home.
/// Returns [`Error::Count`] if an axis has an invalid index, [`Error::NotClosed`] if the loops do
/// not close at home.
pub fn platform_grid<'a>(
    manipulator: &'a dyn Manipulator,
    axes: &[Axis],
    legs: Legs,
) -> Result<impl Workspace + use<'a>, Error> {
    let description = manipulator.description();
    // Passive variables where the loops close at home.
    let mut passive = vec![0.0; description.passive().count()];
    in_range(axes.iter().map(|axis| axis.index), Quantity::Passive, passive.len())?;
    let home = Configuration::home(description);
    manipulator.passive(&home.q, &home.s, &mut passive)?;
    let axes = axes.to_vec();
    let count = combinations(&axes);
    let fill = move |index: usize, configuration: &mut Configuration| {
        let mut requested = passive.clone();
        combine(index, &axes, &mut requested);
        configuration.q = legs.0(&requested, &configuration.s);
        let variables = &manipulator.description().variables;
        let beyond = |(variable, value): (usize, &f64)| {
            let [lower, upper] = variables[variable].limits;
            let by = (lower - value).max(value - upper);
            (by > 0.0).then_some((by, variable, *value))
        };
        let farthest = configuration.q.iter().enumerate().filter_map(beyond);
        if let Some((_, variable, value)) = farthest.max_by(|a, b| a.0.total_cmp(&b.0)) {
            return Err(ReachError::OutsideLimits { variable, value, limits: variables[variable].limits });
        }
        let mut reached = requested.clone();
        manipulator.passive(&configuration.q, &configuration.s, &mut reached)?;
        let differs = |(a, b): (&f64, &f64)| (a - b).abs() > SAME * a.abs().max(1.0);
        match requested.iter().zip(&reached).any(differs) {
            true => Err(ReachError::Evaluation(Error::NotClosed)),
            false => Ok(()),
        }
    };
    Ok(Indexed { home, count, fill })
}

/// Largest difference of a passive variable, relative to 1 or its size, that is a rounding error.
const SAME: f64 = 1e-6;
