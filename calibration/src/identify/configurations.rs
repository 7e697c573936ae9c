//! Grouping of rows by independent configuration; rows of one configuration are repeated visits.

use std::collections::{BTreeMap, BTreeSet, HashMap};

use rand::RngExt;

use super::Observation;
use abbe_analysis::sampling::stream;

/// Rows grouped by configuration.
pub(super) struct Groups {
    order: Vec<usize>,
    ends: Vec<usize>,
}

impl Groups {
    /// Replaces each row index by `rows[index]`.
    pub(super) fn with_indices(mut self, rows: &[usize]) -> Self {
        self.order.iter_mut().for_each(|row| *row = rows[*row]);
        self
    }

    /// Returns the rows of each configuration.
    pub(super) fn slices(&self) -> Vec<&[usize]> {
        let starts = std::iter::once(&0).chain(&self.ends);
        starts.zip(&self.ends).map(|(start, end)| &self.order[*start..*end]).collect()
    }
}

/// Assignment of rows to independent configurations.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Configurations {
    /// Number of configurations.
    pub count: usize,
    /// Configuration of each row, numbered from 0 in order of first occurrence.
    pub number: Vec<u32>,
}

/// Numbers distinct keys from 0 in order of first occurrence, in four bytes per key.
pub(super) struct Numbering {
    dense: Vec<u32>,
    sparse: HashMap<u32, u32>,
    count: u32,
}

impl Numbering {
    /// Marks a key without a number.
    const NONE: u32 = u32::MAX;

    /// Creates a numbering whose storage suits these keys.
    pub(super) fn for_keys(keys: impl Iterator<Item = u32>) -> Self {
        let (count, largest) = keys.fold((0, 0), |(count, largest), key| (count + 1, key.max(largest)));
        let dense = if largest as usize > 1024 + 4 * count { 0 } else { largest as usize + 1 };
        Self { dense: vec![Self::NONE; dense], sparse: HashMap::new(), count: 0 }
    }

    pub(super) fn number(&mut self, key: u32) -> u32 {
        let known = self.dense.get_mut(key as usize);
        let known = known.unwrap_or_else(|| self.sparse.entry(key).or_insert(Self::NONE));
        if *known == Self::NONE {
            (*known, self.count) = (self.count, self.count + 1);
        }
        *known
    }

    /// Returns the number of distinct keys.
    pub(super) fn count(&self) -> usize {
        self.count as usize
    }
}

impl Configurations {
    /// Groups rows by [`Observation::configuration`].
    pub fn new<'o>(rows: impl IntoIterator<Item = &'o Observation>) -> Self {
        Self::from_numbers(rows.into_iter().map(|row| row.configuration).collect())
    }

    /// Draws as many configurations as there are, with replacement, and returns their rows.
    ///
    /// This is one repetition of the bootstrap for dependent rows (Davison and Hinkley, 1997,
    /// section 3.8). All rows of a configuration occur together, in order, as often as it is drawn.
    /// The result depends on the seed and `number` alone.
    pub fn resampled(&self, seed: u64, number: usize) -> Vec<usize> {
        let (mut random, mut times) = (stream(seed, number), vec![0; self.count]);
        for _ in 0..self.count {
            times[random.random_range(0..self.count)] += 1;
        }
        let rows = self.number.iter().enumerate();
        rows.flat_map(|(row, configuration)| core::iter::repeat_n(row, times[*configuration as usize]))
            .collect()
    }

    /// Returns the number of distinct measured numbers of each configuration: each one counts once
    /// per station, however often it was repeated. `rows` are the rows of this assignment.
    pub(super) fn numbers<'o>(&self, rows: impl Iterator<Item = &'o Observation>) -> Vec<u32> {
        let visits = self.visits();
        let (mut numbers, mut again) = (vec![0; self.count], BTreeMap::new());
        for (row, number) in rows.zip(&self.number) {
            let number = *number as usize;
            if visits[number] == 1 {
                numbers[number] = row.count() as u32;
            } else {
                let places: &mut BTreeSet<_> = again.entry(number).or_default();
                places.extend(row.places().into_iter().map(|place| (row.station, place)));
            }
        }
        again.into_iter().for_each(|(number, places)| numbers[number] = places.len() as u32);
        numbers
    }

    /// Returns the number of independent numbers in the rows, and the number of their
    /// configurations.
    pub(super) fn independent(rows: &[Observation]) -> (usize, usize) {
        let configurations = Self::new(rows);
        let numbers = configurations.numbers(rows.iter());
        (numbers.iter().map(|count| *count as usize).sum(), configurations.count)
    }

    /// Returns the number of rows of each configuration.
    pub(super) fn visits(&self) -> Vec<u32> {
        let mut visits = vec![0; self.count];
        self.number.iter().for_each(|number| visits[*number as usize] += 1);
        visits
    }

    /// Groups the row indices by configuration.
    pub(super) fn rows(&self) -> Groups {
        let mut order: Vec<usize> = (0..self.number.len()).collect();
        order.sort_by_key(|row| self.number[*row]);
        let mut ends = vec![0; self.count];
        order.iter().enumerate().for_each(|(place, row)| ends[self.number[*row] as usize] = place + 1);
        Groups { order, ends }
    }

    /// Groups rows with equal numbers.
    fn from_numbers(mut number: Vec<u32>) -> Self {
        let mut numbering = Numbering::for_keys(number.iter().copied());
        number.iter_mut().for_each(|number| *number = numbering.number(*number));
        Self { count: numbering.count(), number }
    }

    /// Groups rows with equal keys.
    pub fn from_keys<K: std::hash::Hash + Eq>(keys: impl IntoIterator<Item = K>) -> Self {
        let mut numbers = HashMap::new();
        let number = keys
            .into_iter()
            .map(|key| {
                let next = numbers.len() as u32;
                *numbers.entry(key).or_insert(next)
            })
            .collect();
        Self { count: numbers.len(), number }
    }
}

#[cfg(test)]
mod tests;
