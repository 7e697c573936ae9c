//! Rows by the configuration that they are visits of: what is independent of each other.

use std::collections::{BTreeSet, HashMap};

use super::Observation;

/// Which rows belong together.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Configurations {
    /// How many there are.
    pub count: usize,
    /// By row: its configuration, from 0 in the order in which they come first.
    pub number: Vec<usize>,
}

impl Configurations {
    /// Those of these rows.
    pub fn new<'o>(rows: impl IntoIterator<Item = &'o Observation>) -> Self {
        Self::from_keys(rows.into_iter().map(|row| row.configuration))
    }

    /// How many numbers were measured of them, every number of a configuration once at every station, however often it was
    /// visited, and at most so many of each; `rows` are those that they were made of.
    pub(super) fn numbers<'o>(&self, rows: impl Iterator<Item = &'o Observation>, most: usize) -> usize {
        let mut places = vec![BTreeSet::new(); self.count];
        for (row, number) in rows.zip(&self.number) {
            places[*number].extend(row.places().into_iter().map(|place| (row.station, place)));
        }
        places.iter().map(|places| places.len().min(most)).sum()
    }

    /// Rows by their configuration.
    pub(super) fn rows(&self) -> Vec<Vec<usize>> {
        let mut rows = vec![Vec::new(); self.count];
        self.number.iter().enumerate().for_each(|(row, number)| rows[*number].push(row));
        rows
    }

    /// Rows with the same key belong together.
    pub fn from_keys<K: std::hash::Hash + Eq>(keys: impl IntoIterator<Item = K>) -> Self {
        let mut numbers = HashMap::new();
        let number = keys
            .into_iter()
            .map(|key| {
                let next = numbers.len();
                *numbers.entry(key).or_insert(next)
            })
            .collect();
        Self { count: numbers.len(), number }
    }
}
