//! Configurations of the checks, numbered in order of appearance.

use std::collections::HashMap;

use abbe::VariableKind;

use crate::identify::Setup;

/// Largest difference between joints of one configuration, in rad or as a share of the arm length.
const SAME: f64 = 1e-3;

/// Largest number of configurations; each needs some hundred columns of values.
pub(super) const MOST: usize = 5_000;

/// Error for more configurations than [`MOST`].
#[derive(Debug)]
pub(super) struct TooManyConfigurations;

/// Configurations distinguished by their joint values. Inputs are ignored because the model
/// includes their effect.
pub(super) struct Configurations {
    list: Vec<Vec<f64>>,
    /// Scale of each joint: 1 rad, or the arm length.
    units: Vec<f64>,
    /// Configurations by a weighted sum of their joints, in bins wider than the largest difference
    /// between equal configurations.
    bins: HashMap<i64, Vec<u32>>,
}

impl Configurations {
    pub(super) fn new(setup: &Setup) -> Self {
        let unit = |kind: VariableKind| if kind == VariableKind::Revolute { 1.0 } else { setup.arm };
        let units = setup.description.variables.iter().map(|variable| unit(variable.kind)).collect();
        Self { list: Vec::new(), units, bins: HashMap::new() }
    }

    pub(super) fn len(&self) -> usize {
        self.list.len()
    }

    /// Returns the index of a configuration: that of the first equal one, or a new one.
    pub(super) fn find_or_insert(&mut self, q: &[f64]) -> Result<u32, TooManyConfigurations> {
        let same = |index: &&u32| {
            let joints = self.list[**index as usize].iter().zip(q).zip(&self.units);
            joints.into_iter().all(|((a, b), unit)| (a - b).abs() <= SAME * unit)
        };
        // Distinct weights of at most 1 make equal sums of different configurations unlikely.
        let factors = (0..q.len()).map(|i| 1.0 / (1.0 + 0.618 * i as f64));
        let sum: f64 =
            q.iter().zip(&self.units).zip(factors).map(|((q, unit), factor)| factor * q / unit).sum();
        let bin = (sum / (1.01 * SAME * q.len() as f64)).floor() as i64;
        let near = (bin.saturating_sub(1)..=bin.saturating_add(1)).filter_map(|bin| self.bins.get(&bin));
        if let Some(existing) = near.flatten().filter(same).min() {
            return Ok(*existing);
        }
        if self.list.len() == MOST {
            return Err(TooManyConfigurations);
        }
        let index = self.list.len() as u32;
        self.list.push(q.to_vec());
        self.bins.entry(bin).or_default().push(index);
        Ok(index)
    }
}

#[cfg(test)]
mod tests;
