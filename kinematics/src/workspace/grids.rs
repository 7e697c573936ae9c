//! Grids of joint variables.
//!
//! Axes of a grid: values of variables, parameters or inputs, and their combinations.
//!
//! Grids of passive variables, such as poses of a platform on legs.
//!
//! The paper's workspace: a volume of tool points, each presented at a fixed point of the room.
//!
//! A workspace repeated for combinations of input values.

use core::ops::Range;
use std::{fmt, sync::Arc};

use abbe_core::{Error, Manipulator, Quantity, lanes::Tiles};

use super::{Show, Workspace, configurations::Indexed};
use crate::{Configuration, ReachError, SumLimits, Target, configuration::in_range, inverse, sampling};

/// Creates the workspace of every combination of the values of some variables, the last one
/// fastest. The other variables stay at home, or follow those where a sum is fixed.
///
/// Parameters and inputs are nominal; [`with_inputs`](super::with_inputs) varies the inputs.
/// Returns [`Error::Count`] if an axis has an invalid index.
pub fn joint_grid(manipulator: &dyn Manipulator, axes: &[Axis]) -> Result<impl Workspace + use<>, Error> {
    let description = manipulator.description();
    in_range(axes.iter().map(|axis| axis.index), Quantity::Variables, description.variables.len())?;
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

/// Tool points, target point and approaches of a presented volume.
#[derive(Clone, Debug, PartialEq)]
pub struct Presentation {
    /// Target of every tool point, in `F_0`: the isocenter.
    pub point: [f64; 3],
    /// Grid of tool points: values of structural parameters.
    pub tool_points: Vec<Axis>,
    /// Grid of approaches: values of fixed variables, such as the spin.
    pub approaches: Vec<Axis>,
    /// Variables that move the tool point to the target. All others stay at home.
    pub solved: Vec<usize>,
}

/// Creates the workspace of every tool point in every approach, presented at one point of `F_0`.
/// Approaches vary fastest.
///
/// Each configuration is solved from home, independently of the others. Returns [`Error::Count`] if
/// an index of a variable or a parameter is invalid; other errors as for
/// [`Manipulator::transforms`].
pub fn presented_volume<'a>(
    manipulator: &'a dyn Manipulator,
    presentation: &Presentation,
) -> Result<impl Workspace + use<'a>, Error> {
    let description = manipulator.description();
    let Presentation { point, tool_points, approaches, solved } = presentation.clone();
    let indices = approaches.iter().map(|axis| axis.index).chain(solved.iter().copied());
    in_range(indices, Quantity::Variables, description.variables.len())?;
    let indices = tool_points.iter().map(|axis| axis.index);
    in_range(indices, Quantity::Parameters, description.parameters.len())?;

    let home = Configuration::home(description);
    sampling::arm_length(manipulator, &home.s)?;
    let count = combinations(&tool_points).saturating_mul(combinations(&approaches));
    let fill = move |index: usize, configuration: &mut Configuration| {
        combine(combine(index, &approaches, &mut configuration.q), &tool_points, &mut configuration.s);
        let Configuration { q, s, .. } = &*configuration;
        configuration.q = inverse(manipulator, s, q, &solved, &Target::Point(point))?;
        Ok(())
    };
    Ok(Indexed { home, count, fill })
}

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
    in_range(inputs.iter().map(|axis| axis.index), Quantity::Inputs, manipulator.description().inputs.len())?;
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
