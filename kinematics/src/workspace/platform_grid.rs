//! Grids of passive variables, such as poses of a platform on legs.

use std::fmt;
use std::sync::Arc;

use super::axis::{combinations, combine};
use super::{Axis, Workspace};
use crate::Configuration;
use crate::ReachError;
use crate::configuration::in_range;
use abbe_core::{Error, Manipulator, Quantity};

type Lengths = dyn Fn(&[f64], &[f64]) -> Vec<f64> + Send + Sync;

/// Joint variables as a function of the passive variables and the parameters.
#[derive(Clone)]
pub struct Legs(pub Arc<Lengths>);

impl fmt::Debug for Legs {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("Legs")
    }
}

/// Workspace of a grid of passive variables; see [`platform_grid`].
pub struct PlatformGrid<'a> {
    manipulator: &'a dyn Manipulator,
    home: Configuration,
    /// Passive variables where the loops close at home.
    passive: Vec<f64>,
    axes: Vec<Axis>,
    legs: Legs,
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
) -> Result<PlatformGrid<'a>, Error> {
    let description = manipulator.description();
    let mut passive = vec![0.0; description.passive().count()];
    in_range(axes.iter().map(|axis| axis.index), Quantity::Passive, passive.len())?;
    let home = Configuration::home(description);
    manipulator.passive(&home.q, &home.s, &mut passive)?;
    Ok(PlatformGrid { manipulator, home, passive, axes: axes.to_vec(), legs })
}

/// Largest difference of a passive variable, relative to 1 or its size, that is a rounding error.
const SAME: f64 = 1e-6;

impl Workspace for PlatformGrid<'_> {
    fn len(&self) -> usize {
        combinations(&self.axes)
    }

    fn home(&self) -> &Configuration {
        &self.home
    }

    fn fill(&self, index: usize, configuration: &mut Configuration) -> Result<(), ReachError> {
        configuration.copy_from(&self.home);
        let mut requested = self.passive.clone();
        combine(index, &self.axes, &mut requested);
        configuration.q = self.legs.0(&requested, &configuration.s);
        let variables = &self.manipulator.description().variables;
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
        self.manipulator.passive(&configuration.q, &configuration.s, &mut reached)?;
        let differs = |(a, b): (&f64, &f64)| (a - b).abs() > SAME * a.abs().max(1.0);
        match requested.iter().zip(&reached).any(differs) {
            true => Err(ReachError::Evaluation(Error::NotClosed)),
            false => Ok(()),
        }
    }
}
