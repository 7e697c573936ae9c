//! Rows by the configuration that they are visits of: what is independent of each other.

use std::collections::HashMap;

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
