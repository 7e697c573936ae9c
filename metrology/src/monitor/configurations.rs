//! Configurations of the checks, numbered in order of appearance.
//!
//! Rows of one check, each with its configuration.

use std::collections::HashMap;

use abbe::Pose;
use abbe::identify::{Measurement, Observation};
use abbe_study::{Result, mistake};

use super::checks::Check;
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
        let units = setup.description.variables.iter().map(|variable| variable.kind.either(1.0, setup.arm));
        Self { list: Vec::new(), units: units.collect(), bins: HashMap::new() }
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

/// Rows of one check.
pub(super) struct Visits<'c> {
    pub(super) check: &'c Check,
    /// Pose of every station's instrument in `F_0`, which converts measurements to `F_0`.
    to_base: Vec<Pose>,
    /// Configuration of every row; none if a target was hidden.
    configurations: Vec<Option<u32>>,
}

impl<'c> Visits<'c> {
    /// Assigns rows to configurations; new ones are appended. Rows with hidden targets are skipped.
    pub(super) fn new(check: &'c Check, setup: &Setup, known: &mut Configurations) -> Result<Self> {
        let configuration = |row: &Observation| match &row.measured {
            Measurement::Points(points) if !points.iter().all(Option::is_some) => Ok(None),
            Measurement::Readings(readings) if readings.iter().any(Option::is_none) => Ok(None),
            _ => known.find_or_insert(&row.q).map(Some),
        };
        let found = check.data.observations.iter().map(configuration).collect::<Result<_, _>>();
        let help = format!(
            "use the same few configurations in every check (joints within 1 mrad), at most \
             {MOST}; or identify the machine from all rows by `abbe identify`"
        );
        let many = |TooManyConfigurations| {
            let message = format!("more than {MOST} different configurations up to this check");
            mistake::with_help(&check.data.file, message, help)
        };
        let to_base = setup.real.stations.iter().map(|station| station.pose.inverse()).collect();
        Ok(Self { check, to_base, configurations: found.map_err(many)? })
    }

    /// Iterates over the used rows, each with its configuration.
    pub(super) fn rows(&self) -> impl Iterator<Item = (&'c Observation, usize)> {
        let rows = self.check.data.observations.iter().zip(&self.configurations);
        rows.filter_map(|(row, configuration)| Some((row, (*configuration)? as usize)))
    }

    /// Counts the rows of each configuration.
    pub(super) fn counts(&self, count: usize) -> Vec<u32> {
        let mut counts = vec![0; count];
        self.rows().for_each(|(_, configuration)| counts[configuration] += 1);
        counts
    }

    /// Converts a row to the frame `F_0`.
    pub(super) fn in_f0(&self, row: &Observation) -> Observation {
        let to_base = &self.to_base[row.station as usize];
        let measured = match &row.measured {
            Measurement::Points(points) => Measurement::Points(
                points.iter().map(|point| point.map(|point| to_base.apply(point))).collect(),
            ),
            Measurement::Pose(pose) => Measurement::Pose(Box::new(to_base.then(pose))),
            // The fixtures are already in F_0.
            readings @ Measurement::Readings(_) => readings.clone(),
        };
        Observation { measured, station: 0, ..row.clone() }
    }
}

#[cfg(test)]
mod tests;
