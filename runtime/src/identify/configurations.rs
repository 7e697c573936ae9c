//! Rows by the configuration that they are visits of: what is independent of each other.

use std::collections::{BTreeMap, BTreeSet, HashMap};

use super::Observation;

/// Rows, those of one configuration after those of the other.
pub(super) struct Groups {
    order: Vec<usize>,
    ends: Vec<usize>,
}

impl Groups {
    /// The same, of rows that are `used`, given by their place among these.
    pub(super) fn of(mut self, used: &[usize]) -> Self {
        self.order.iter_mut().for_each(|row| *row = used[*row]);
        self
    }

    /// The rows of every configuration.
    pub(super) fn slices(&self) -> Vec<&[usize]> {
        let starts = std::iter::once(&0).chain(&self.ends);
        starts.zip(&self.ends).map(|(start, end)| &self.order[*start..*end]).collect()
    }
}

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

    /// By configuration, how many numbers were measured of it: every one once at every station, however often it was visited.
    /// `rows` are those that they were made of.
    pub(super) fn numbers<'o>(&self, rows: impl Iterator<Item = &'o Observation>) -> Vec<usize> {
        let mut visits = vec![0; self.count];
        self.number.iter().for_each(|number| visits[*number] += 1);
        let (mut numbers, mut again) = (vec![0; self.count], BTreeMap::new());
        for (row, number) in rows.zip(&self.number) {
            if visits[*number] == 1 {
                numbers[*number] = row.count();
            } else {
                let places: &mut BTreeSet<_> = again.entry(*number).or_default();
                places.extend(row.places().into_iter().map(|place| (row.station, place)));
            }
        }
        again.into_iter().for_each(|(number, places)| numbers[number] = places.len());
        numbers
    }

    /// Rows by their configuration.
    pub(super) fn rows(&self) -> Groups {
        let mut order: Vec<usize> = (0..self.number.len()).collect();
        order.sort_by_key(|row| self.number[*row]);
        let mut ends = vec![0; self.count];
        order.iter().enumerate().for_each(|(place, row)| ends[self.number[*row]] = place + 1);
        Groups { order, ends }
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
