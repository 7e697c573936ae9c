//! Indices of elements: sums of loop counters.

use std::fmt;
use std::ops::{Add, Mul, Sub};

/// Counter of a loop, or another whole variable.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Counter(pub(super) &'static str);

/// A sum of multiples of counters and a number.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Index {
    /// Factor and counter of each term.
    terms: Vec<(usize, Counter)>,
    offset: i64,
}

impl Counter {
    /// Returns the name of the counter.
    pub const fn name(self) -> &'static str {
        self.0
    }
}

impl Index {
    /// Returns the index if it is a number.
    pub fn number(&self) -> Option<i64> {
        self.terms.is_empty().then_some(self.offset)
    }

    /// Returns the index where counters have these values.
    pub fn value(&self, counter: impl Fn(Counter) -> i64) -> i64 {
        self.terms.iter().fold(self.offset, |sum, (factor, name)| sum + *factor as i64 * counter(*name))
    }

    /// Returns the factor of a counter.
    pub fn factor(&self, counter: Counter) -> usize {
        self.terms.iter().filter(|(_, other)| *other == counter).map(|(factor, _)| factor).sum()
    }

    /// Replaces a counter by an index.
    #[must_use]
    pub fn with(&self, counter: Counter, value: &Self) -> Self {
        let factor = self.factor(counter);
        let mut index = self.clone();
        index.terms.retain(|(_, other)| *other != counter);
        index.terms.extend(value.terms.iter().map(|(other, name)| (other * factor, *name)));
        index.terms.retain(|(factor, _)| *factor > 0);
        index.offset += value.offset * factor as i64;
        index.merged()
    }

    fn merged(mut self) -> Self {
        let mut terms: Vec<(usize, Counter)> = Vec::new();
        for (factor, counter) in self.terms {
            match terms.iter_mut().find(|(_, other)| *other == counter) {
                Some((sum, _)) => *sum += factor,
                None => terms.push((factor, counter)),
            }
        }
        self.terms = terms;
        self
    }
}

/// Returns the range from 0 to the number before `end`.
pub(super) fn below(end: impl Into<Index>) -> [Index; 2] {
    [0.into(), end.into()]
}

/// Prints as `6 * j + i + 9`, which every language reads.
impl fmt::Display for Index {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (k, (factor, Counter(name))) in self.terms.iter().enumerate() {
            let plus = if k > 0 { " + " } else { "" };
            match factor {
                1 => write!(f, "{plus}{name}")?,
                factor => write!(f, "{plus}{factor} * {name}")?,
            }
        }
        match self.offset {
            offset if self.terms.is_empty() => write!(f, "{offset}"),
            0 => Ok(()),
            offset if offset < 0 => write!(f, " - {}", -offset),
            offset => write!(f, " + {offset}"),
        }
    }
}

impl From<usize> for Index {
    fn from(offset: usize) -> Self {
        Self { terms: Vec::new(), offset: offset as i64 }
    }
}

impl From<i32> for Index {
    fn from(offset: i32) -> Self {
        Self { terms: Vec::new(), offset: i64::from(offset) }
    }
}

impl From<Counter> for Index {
    fn from(counter: Counter) -> Self {
        Self { terms: vec![(1, counter)], offset: 0 }
    }
}

impl Mul<Counter> for usize {
    type Output = Index;

    fn mul(self, counter: Counter) -> Index {
        Index { terms: vec![(self, counter)], offset: 0 }
    }
}

impl<T: Into<Index>> Add<T> for Index {
    type Output = Self;

    fn add(mut self, other: T) -> Self {
        let other = other.into();
        self.terms.extend(other.terms);
        self.offset += other.offset;
        self.merged()
    }
}

impl<T: Into<Index>> Add<T> for Counter {
    type Output = Index;

    fn add(self, other: T) -> Index {
        Index::from(self) + other
    }
}

impl Add<Counter> for usize {
    type Output = Index;

    fn add(self, counter: Counter) -> Index {
        Index::from(counter) + self
    }
}

impl Sub<usize> for Index {
    type Output = Self;

    fn sub(mut self, other: usize) -> Self {
        self.offset -= other as i64;
        self
    }
}
