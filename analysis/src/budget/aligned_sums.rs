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
mod tests {
    use super::AlignedSums;

    fn over(range: core::ops::Range<usize>) -> AlignedSums {
        let mut sums = AlignedSums::default();
        for chunk in range {
            sums.append(AlignedSums::from_chunk(chunk, vec![1.0 / (chunk + 1) as f64, chunk as f64]));
        }
        sums
    }

    #[test]
    fn any_division_gives_the_same_to_the_last_bit() {
        let count = 1000;
        let all = over(0..count);
        let [harmonic, whole] = all.clone().total()[..] else { panic!("two sums") };
        assert_eq!(whole, 499_500.0);
        assert!((harmonic - 7.485_470_860_550_345).abs() < 1e-14);
        for parts in [2, 3, 7, 64, 1000] {
            let mut divided = AlignedSums::default();
            for i in 0..parts {
                divided.append(over(i * count / parts..(i + 1) * count / parts));
            }
            assert_eq!(divided, all, "{parts}");
        }
        // The order of merging does not matter as long as the parts are consecutive.
        let mut last = over(300..600);
        last.append(over(600..count));
        let mut first = over(0..300);
        first.append(last);
        assert_eq!(first, all);
        assert!(AlignedSums::default().total().is_empty());
    }
}
