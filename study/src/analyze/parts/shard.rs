//! Which share of a workspace.

use std::fmt;
use std::ops::Range;
use std::str::FromStr;

use serde::{Deserialize, Serialize};

/// Share `number` of `of`, counted from 1: `3/7`. As text it is serialized, too.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(into = "String", try_from = "String")]
pub struct Shard {
    number: u32,
    of: u32,
}

impl Shard {
    /// The most shares of one analysis.
    pub const MOST: u32 = 100_000;

    /// Share `number` of `of`; what is wrong with them otherwise.
    pub fn new(number: u32, of: u32) -> Result<Self, String> {
        match (number, of) {
            (_, 1..=Self::MOST) if (1..=of).contains(&number) => Ok(Self { number, of }),
            (_, 1..=Self::MOST) => Err(format!("shards are counted from 1: 1/{of} to {of}/{of}")),
            _ => Err(format!("from 1 to {} shards", Self::MOST)),
        }
    }

    /// Which one it is, from 1 on.
    pub fn number(self) -> u32 {
        self.number
    }

    /// Of how many.
    pub fn of(self) -> u32 {
        self.of
    }

    /// Its share of so many chunks; of few, some shards have none.
    pub(in crate::analyze) fn chunks(self, count: usize) -> Range<usize> {
        let end = |number: u32| (count as u128 * u128::from(number) / u128::from(self.of)) as usize;
        end(self.number - 1)..end(self.number)
    }
}

impl fmt::Display for Shard {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}/{}", self.number, self.of)
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
        let numbers =
            text.split_once('/').and_then(|(number, of)| Some((number.parse().ok()?, of.parse().ok()?)));
        let (number, of) = numbers.ok_or("write I/N: 3/7 is the third of seven shards")?;
        Self::new(number, of)
    }
}

#[cfg(test)]
mod tests {
    use super::Shard;

    #[test]
    fn shards_are_all_chunks_one_after_the_other() {
        for (count, of) in [(0, 3), (1, 1), (5, 7), (64, 7), (244_141, 64)] {
            let mut next = 0;
            for number in 1..=of {
                let chunks = Shard::new(number, of).unwrap().chunks(count);
                assert_eq!(chunks.start, next);
                assert!(chunks.len() <= count.div_ceil(of as usize));
                next = chunks.end;
            }
            assert_eq!(next, count);
        }
    }

    #[test]
    fn they_are_written_as_they_are_read() {
        assert_eq!("3/7".parse::<Shard>().unwrap().to_string(), "3/7");
        for text in ["0/7", "8/7", "1/0", "1/100001", "3", "a/b", "-1/3", "1/3/4"] {
            assert!(text.parse::<Shard>().is_err(), "{text}");
        }
    }
}
