//! The parts of a chain that move on their own.

use core::ops::Range;

/// Consecutive transforms among `A_1 … A_n, T` that share their joint variables with no others.
///
/// Where every joint moves one frame, each transform is a part.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Parts {
    /// Of `A_1 … A_n, T`, from 0: each begins where the one before ends.
    pub(super) ranges: Vec<Range<usize>>,
}

impl Parts {
    /// From the joint variables on which each of `A_1 … A_n` and `T` depends.
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

    /// How many there are.
    pub fn count(&self) -> usize {
        self.ranges.len()
    }

    /// How many transforms the longest has.
    pub fn longest(&self) -> usize {
        self.ranges.iter().map(Range::len).max().unwrap_or(0)
    }

    /// How many transforms there are in all.
    pub(super) fn transforms(&self) -> usize {
        self.ranges.last().map_or(0, |range| range.end)
    }
}
