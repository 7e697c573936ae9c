//! Histogram bins that double their width when there are too many, for data of unknown range.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize, Serializer};

/// Content of a bin.
pub trait Merge: Default {
    /// Merges the content of a neighbouring bin.
    fn merge(&mut self, other: Self);
}

/// Bins of width 2^exponent, with a limit on the number of non-empty bins.
///
/// The width is the smallest that keeps the limit. It depends on the values, not on their order.
/// Derived serialization is for reading back; reports use [`listed`].
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Bins<T> {
    finest: i32,
    pub(super) exponent: i32,
    most: usize,
    bins: BTreeMap<i64, T>,
}

impl<T: Merge> Bins<T> {
    /// Creates empty bins with the smallest width, 2^finest, and at most `most` non-empty bins.
    pub fn new(finest: i32, most: usize) -> Self {
        Self { finest, exponent: finest, most: most.max(1), bins: BTreeMap::new() }
    }

    /// Returns the bin that holds a value, and creates it if necessary.
    pub fn bin_mut(&mut self, value: f64) -> &mut T {
        while self.key(value).unsigned_abs() > 1 << 52 {
            self.double();
        }
        while self.bins.len() >= self.most && !self.bins.contains_key(&self.key(value)) {
            self.double();
        }
        let key = self.key(value);
        self.bins.entry(key).or_default()
    }

    /// Widens the bins until they span at most `most` bins, empty ones included.
    pub fn span_at_most(&mut self, most: i64) {
        while self.span() > most.max(1) {
            self.double();
        }
    }

    fn span(&self) -> i64 {
        let keys = self.bins.keys();
        keys.clone().next_back().zip(keys.clone().next()).map_or(0, |(last, first)| last - first + 1)
    }

    fn key(&self, value: f64) -> i64 {
        // Shift by half of the smallest width, so that rounding does not split 0 and other round
        // values.
        let offset = 2f64.powi(self.finest - 1);
        ((value + offset) / self.width()).floor() as i64
    }

    fn double(&mut self) {
        self.exponent += 1;
        for (key, content) in std::mem::take(&mut self.bins) {
            self.bins.entry(key.div_euclid(2)).or_default().merge(content);
        }
    }

    /// Returns true if other bins can be merged with these. Checks untrusted data from a file.
    pub fn accepts(&self, other: &Self) -> bool {
        let widest = f64::MAX_EXP + 1;
        (other.finest, other.most) == (self.finest, self.most)
            && (other.finest..=widest).contains(&other.exponent)
            && other.bins.len() <= other.most
            && other.bins.keys().all(|key| key.unsigned_abs() <= 1 << 53)
    }

    /// Merges other bins that have the same smallest width.
    pub fn merge(&mut self, mut other: Self) {
        self.widen(other.exponent);
        other.widen(self.exponent);
        for (key, content) in other.bins {
            self.bins.entry(key).or_default().merge(content);
        }
        while self.bins.len() > self.most {
            self.double();
        }
    }

    /// Widens the bins to at least this exponent.
    pub fn widen(&mut self, exponent: i32) {
        while self.exponent < exponent {
            self.double();
        }
    }

    fn width(&self) -> f64 {
        2f64.powi(self.exponent)
    }

    /// Returns the lower and upper edge of a bin.
    pub fn edges(&self, key: i64) -> [f64; 2] {
        [key, key + 1].map(|edge| edge as f64 * self.width())
    }

    /// Returns the content of a bin; `None` if it is empty.
    pub fn get(&self, key: i64) -> Option<&T> {
        self.bins.get(&key)
    }

    /// Iterates over the contents in ascending order.
    pub fn into_contents(self) -> impl Iterator<Item = T> {
        self.bins.into_values()
    }

    /// Iterates over the non-empty bins in ascending order, with their keys.
    pub fn iter(&self) -> impl DoubleEndedIterator<Item = (i64, &T)> {
        self.bins.iter().map(|(key, content)| (*key, content))
    }
}

/// Serializes bins as a list of `[edges, content]`.
pub fn listed<T: Merge + Serialize, S: Serializer>(bins: &Bins<T>, serializer: S) -> Result<S::Ok, S::Error> {
    serializer.collect_seq(bins.iter().map(|(key, content)| (bins.edges(key), content)))
}

#[cfg(test)]
mod tests;
