//! `ΔX = J_e ε` of every source at every configuration, block by block.

use core::fmt;

use super::Configuration;
use crate::{Class, Error, Manipulator, Pose, Quantity};

/// How many configurations are evaluated at once: the only ones whose Jacobians are held.
pub const BLOCK: usize = 256;

/// A configuration of the workspace that could not be evaluated.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Unevaluated {
    /// Its index; none for the home configuration.
    pub configuration: Option<usize>,
    /// Why.
    pub error: Error,
}

impl fmt::Display for Unevaluated {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.configuration {
            Some(index) => write!(f, "configuration {index}: {}", self.error),
            None => write!(f, "home configuration: {}", self.error),
        }
    }
}

impl core::error::Error for Unevaluated {}

/// What the sources do at one configuration, to first order.
///
/// Deviations have rows 1–3 in the length unit and `F_0`, rows 4–6 in rad as the manipulator's orientation.
#[derive(Clone, Copy, Debug)]
pub struct Row<'a> {
    /// Index of the configuration.
    pub index: usize,
    /// The configuration.
    pub configuration: &'a Configuration,
    /// The nominal pose of the tool point in `F_0`, equation (3).
    pub pose: Pose,
    /// ΔX of each source: of a repeatable one with its sign; of a random one its bound (half-width or 3σ),
    /// whose sign as a whole is unknown.
    pub sources: &'a [[f64; 6]],
    /// The sum of the repeatable sources.
    pub repeatable: [f64; 6],
    /// The root sum of squares of the random sources, row by row.
    pub random: [f64; 6],
}

/// Evaluates all sources at all configurations and visits them in order.
///
/// The effects of one source share one magnitude, so its ΔX is their sum with signs. [`Error::Count`] before
/// anything is visited if a configuration or `u` has not as many values as the manipulator.
pub fn sweep(
    manipulator: &dyn Manipulator,
    configurations: &[Configuration],
    u: &[f64],
    visit: &mut dyn FnMut(&Row),
) -> Result<(), Unevaluated> {
    for (i, configuration) in configurations.iter().enumerate() {
        counts(manipulator, configuration, u)
            .map_err(|error| Unevaluated { configuration: Some(i), error })?;
    }
    for (i, block) in configurations.chunks(BLOCK).enumerate() {
        sweep_block(manipulator, block, u, i * BLOCK, visit)?;
    }
    Ok(())
}

fn counts(manipulator: &dyn Manipulator, configuration: &Configuration, u: &[f64]) -> Result<(), Error> {
    let description = manipulator.description();
    for (quantity, expected, found) in [
        (Quantity::Variables, description.variables.len(), configuration.q.len()),
        (Quantity::Parameters, description.parameters.len(), configuration.s.len()),
        (Quantity::Inputs, description.inputs.len(), u.len()),
    ] {
        if expected != found {
            return Err(Error::Count { quantity, expected, found });
        }
    }
    Ok(())
}

fn sweep_block(
    manipulator: &dyn Manipulator,
    block: &[Configuration],
    u: &[f64],
    first: usize,
    visit: &mut dyn FnMut(&Row),
) -> Result<(), Unevaluated> {
    let at = |i: usize, error| Unevaluated { configuration: Some(first + i), error };
    let description = manipulator.description();
    let (columns_each, effects_each) = (6 * description.frames.len(), description.effects.len());

    let q = block.iter().flat_map(|c| c.q.iter().copied()).collect::<Vec<_>>();
    let s = block.iter().flat_map(|c| c.s.iter().copied()).collect::<Vec<_>>();
    let u = u.repeat(block.len());
    let mut poses = vec![Pose::IDENTITY; block.len()];
    let mut columns = vec![[0.0; 6]; block.len() * columns_each];
    let mut effects = vec![0.0; block.len() * effects_each];
    manipulator
        .error_models(&q, &s, &u, &mut poses, &mut columns, &mut effects)
        .map_err(|(i, error)| at(i, error))?;

    let mut sources = vec![[0.0; 6]; description.sources.len()];
    for (i, configuration) in block.iter().enumerate() {
        let columns = &columns[i * columns_each..][..columns_each];
        let effects = &effects[i * effects_each..][..effects_each];
        sources.fill([0.0; 6]);
        for (effect, value) in description.effects.iter().zip(effects) {
            let column = &columns[6 * effect.frame + effect.component.index()];
            let value = value * bound(description.sources[effect.source].class);
            add_scaled(&mut sources[effect.source], column, value);
        }

        let (mut repeatable, mut squares) = ([0.0; 6], [0.0; 6]);
        for (j, (source, deviation)) in description.sources.iter().zip(&sources).enumerate() {
            if deviation.iter().any(|row| !row.is_finite()) {
                let index = description.effects.iter().position(|effect| effect.source == j).unwrap_or(0);
                let error = Error::NotFinite { quantity: Quantity::Errors, index };
                return Err(at(i, error));
            }
            match source.class {
                Class::Repeatable => add_scaled(&mut repeatable, deviation, 1.0),
                Class::Random(_) => {
                    add_scaled(&mut squares, &deviation.map(|row| row * row), 1.0);
                }
            }
        }
        visit(&Row {
            index: first + i,
            configuration,
            pose: poses[i],
            sources: &sources,
            repeatable,
            random: squares.map(f64::sqrt),
        });
    }
    Ok(())
}

/// What a source's value is multiplied with: its sign counts, or its bound.
fn bound(class: Class) -> f64 {
    match class {
        Class::Repeatable => 1.0,
        Class::Random(distribution) => distribution.bound(),
    }
}

fn add_scaled(sum: &mut [f64; 6], column: &[f64; 6], factor: f64) {
    for (sum, entry) in sum.iter_mut().zip(column) {
        *sum += entry * factor;
    }
}
