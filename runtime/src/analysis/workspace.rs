//! The configurations over which errors are analyzed: made one by one when they are needed, never stored.

use core::ops::Range;

use super::{Unreached, sampling};
use crate::lanes::Tiles;
use crate::{Description, Error, Quantity};

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
    /// Its index in the workspace.
    pub index: usize,
    /// The point of `F_0` that the tool was to be brought to, if that differs from one to the next.
    pub point: Option<[f64; 3]>,
    /// What was asked for; the variables to be solved for are where the search began.
    pub asked: Configuration,
    /// Why it could not be had.
    pub reason: Unreached,
}

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

    /// The configuration that errors relative to home are relative to; it says how long `q` and `s` are.
    fn home(&self) -> &Configuration;

    /// Writes configuration `index`, less than [`len`](Self::len), over `q` and `s`, which are as long as those
    /// of home. If it cannot be had they hold what was asked for.
    fn fill(&self, index: usize, q: &mut [f64], s: &mut [f64]) -> Result<(), Unreached>;

    /// Writes what differs from home in the configurations of a range into rows q, s of `rows`, which hold those of
    /// home, if all can be had and this is quicker than one by one; says whether it did.
    fn fill_rows(&self, _range: Range<usize>, _rows: &mut Tiles) -> bool {
        false
    }

    /// The point of `F_0` that the tool is brought to in configuration `index`, if that differs from one to the next.
    fn point(&self, _index: usize) -> Option<[f64; 3]> {
        None
    }

    /// Configuration `index`, or why it cannot be had.
    fn configuration(&self, index: usize) -> Result<Configuration, Unreached> {
        let mut configuration = self.home().clone();
        self.fill(index, &mut configuration.q, &mut configuration.s)?;
        Ok(configuration)
    }

    /// All configurations that can be reached, stored: for small workspaces.
    fn reached(&self) -> Vec<Configuration> {
        (0..self.len()).filter_map(|index| self.configuration(index).ok()).collect()
    }
}

/// A workspace of one configuration.
pub(super) struct One<'a>(pub(super) &'a Configuration);

impl Workspace for One<'_> {
    fn len(&self) -> usize {
        1
    }

    fn home(&self) -> &Configuration {
        self.0
    }

    fn fill(&self, _: usize, q: &mut [f64], s: &mut [f64]) -> Result<(), Unreached> {
        q.copy_from_slice(&self.0.q);
        s.copy_from_slice(&self.0.s);
        Ok(())
    }
}

/// The values that one variable or one parameter goes through.
#[derive(Clone, Debug, PartialEq)]
pub struct Axis {
    /// Which of them, from 0.
    pub index: usize,
    /// The values: the length unit, or rad.
    pub values: Vec<f64>,
}

/// How many combinations the values of some axes have.
pub(super) fn combinations(axes: &[Axis]) -> usize {
    axes.iter().map(|axis| axis.values.len()).fold(1, usize::saturating_mul)
}

/// Puts combination `number` of the axes' values in, the last axis fastest. Returns what is left of the number.
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
