//! The parts of a chain with separate joints.

use core::ops::Range;

/// Partition of the transforms `A_1 … A_n, T` into consecutive parts that share no joint variables.
///
/// Each transform is a part of its own if every joint moves one frame.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Parts {
    /// Ranges of `A_1 … A_n, T`, from 0, without gaps.
    pub(super) ranges: Vec<Range<usize>>,
}

impl Parts {
    /// Partitions a chain, given the joint variables on which each of `A_1 … A_n` and `T` depends.
    ///
    /// ```
    /// use abbe::analysis::Parts;
    /// // q0 moves A_1, q1 moves A_2 and A_3, nothing moves the tool.
    /// let parts = Parts::new(&[vec![0], vec![1], vec![2, 1], vec![]]);
    /// assert_eq!((parts.count(), parts.longest()), (3, 2));
    /// ```
    pub fn new(depends: &[Vec<usize>]) -> Self {
        let variables = depends.iter().flatten().max().map_or(0, |last| last + 1);
        let mut last = vec![0; variables];
        for (transform, used) in depends.iter().enumerate() {
            used.iter().for_each(|variable| last[*variable] = transform);
        }
        let mut ranges = Vec::new();
        let (mut first, mut end) = (0, 0);
        for (transform, used) in depends.iter().enumerate() {
            end = used.iter().map(|variable| last[*variable] + 1).fold(end.max(transform + 1), usize::max);
            if end == transform + 1 {
                ranges.push(first..end);
                first = end;
            }
        }
        Self { ranges }
    }

    /// Returns the number of parts.
    pub fn count(&self) -> usize {
        self.ranges.len()
    }

    /// Returns the number of transforms of the longest part.
    pub fn longest(&self) -> usize {
        self.ranges.iter().map(Range::len).max().unwrap_or(0)
    }

    /// Returns the number of transforms.
    pub(super) fn transforms(&self) -> usize {
        self.ranges.last().map_or(0, |range| range.end)
    }
}
