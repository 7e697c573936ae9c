//! Sums that do not depend on the partition of the summands.

use core::ops::Range;

/// Pairwise sums over consecutive chunks: chunks 2i and 2i + 1 are added, then pairs of pairs, and
/// so on. The additions are the same for every partition of the chunks, and so is every bit of the
/// sums.
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(super) struct AlignedSums(Vec<Node>);

/// Sums over 2^`level` chunks.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
struct Node {
    first: usize,
    level: u32,
    sums: Vec<f64>,
}

impl AlignedSums {
    /// Creates the sums of one chunk, by its number.
    pub(super) fn from_chunk(chunk: usize, sums: Vec<f64>) -> Self {
        Self(vec![Node { first: chunk, level: 0, sums }])
    }

    /// Appends the sums of the following chunks.
    pub(super) fn append(&mut self, other: Self) {
        for node in other.0 {
            self.0.push(node);
            while let [.., left, right] = &mut self.0[..]
                && left.level == right.level
                && left.first.is_multiple_of(2 << left.level)
            {
                add(&mut left.sums, &right.sums);
                left.level += 1;
                self.0.pop();
            }
        }
    }

    /// Returns whether these are sums of `count` numbers over the chunks. They may come from a
    /// file.
    pub(super) fn is_valid_for(&self, chunks: Range<usize>, count: usize) -> bool {
        let mut expected = Self::default();
        chunks.for_each(|chunk| expected.append(Self::from_chunk(chunk, Vec::new())));
        let is_alike = |(node, expected): (&Node, &Node)| {
            (node.first, node.level, node.sums.len()) == (expected.first, expected.level, count)
        };
        self.0.len() == expected.0.len() && self.0.iter().zip(&expected.0).all(is_alike)
    }

    /// Returns the total. The last nodes, which are unpaired, are added first. Empty without
    /// chunks.
    pub(super) fn total(mut self) -> Vec<f64> {
        let mut total = self.0.pop().map(|node| node.sums).unwrap_or_default();
        while let Some(mut node) = self.0.pop() {
            add(&mut node.sums, &total);
            total = node.sums;
        }
        total
    }
}

fn add(sums: &mut [f64], others: &[f64]) {
    sums.iter_mut().zip(others).for_each(|(sum, other)| *sum += other);
}

#[cfg(test)]
mod tests;
