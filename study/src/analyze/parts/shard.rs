//! A share of a workspace.

use std::{fmt, ops::Range, str::FromStr};

use serde::{Deserialize, Serialize};

/// Share `number` of `count`, counted from 1. Serialized as text: `3/7`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(into = "String", try_from = "String")]
pub struct Shard {
    number: u32,
    count: u32,
}

impl Shard {
    /// Largest number of shards of one analysis.
    pub const MAX: u32 = 100_000;

    /// Creates the shard; returns a message if the numbers are out of range.
    pub fn new(number: u32, count: u32) -> Result<Self, String> {
        match (number, count) {
            (_, 1..=Self::MAX) if (1..=count).contains(&number) => Ok(Self { number, count }),
            (_, 1..=Self::MAX) => {
                Err(format!("the index of a shard counts from 1: 1/{count} to {count}/{count}"))
            }
            _ => Err(format!("the number of shards must be between 1 and {}", Self::MAX)),
        }
    }

    /// Returns the number of this shard, from 1.
    pub fn number(self) -> u32 {
        self.number
    }

    /// Returns the number of shards.
    pub fn count(self) -> u32 {
        self.count
    }

    /// Returns this shard's range of the chunks. It may be empty if there are few chunks.
    pub(in crate::analyze) fn chunks(self, chunks: usize) -> Range<usize> {
        let end = |number: u32| (chunks as u128 * u128::from(number) / u128::from(self.count)) as usize;
        end(self.number - 1)..end(self.number)
    }
}

impl fmt::Display for Shard {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}/{}", self.number, self.count)
    }
}

impl From<Shard> for String {
    fn from(shard: Shard) -> Self {
        shard.to_string()
    }
}

impl TryFrom<String> for Shard {
    type Error = String;

    fn try_from(text: String) -> Result<Self, String> {
        text.parse()
    }
}

impl FromStr for Shard {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let numbers = text
            .split_once('/')
            .and_then(|(number, count)| Some((number.parse().ok()?, count.parse().ok()?)));
        let (number, count) = numbers.ok_or("write I/N, such as 3/7 for the third of seven shards")?;
        Self::new(number, count)
    }
}

#[cfg(test)]
mod tests;
