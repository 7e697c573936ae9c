//! Partial budgets over some chunks of a workspace, which merge.

use core::fmt;
use core::ops::Range;

use super::partial_errors::PartialErrors;
use crate::UnreachableSummary;

/// Partial result over consecutive chunks of a [`BudgetSweep`](super::BudgetSweep).
#[derive(Clone, Debug)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct PartialBudget {
    pub(super) chunks: Range<usize>,
    pub(super) position: PartialErrors,
    pub(super) orientation: PartialErrors,
    pub(super) configurations: usize,
    /// Number of configurations at which rows 4–6 exist.
    pub(super) oriented: usize,
    pub(super) unreachable: UnreachableSummary,
}

/// Error of appending a part that does not begin where the previous one ends.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Gap {
    /// Chunk at which the part should begin.
    pub expected: usize,
    /// Chunk at which it begins.
    pub found: usize,
}

impl fmt::Display for Gap {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "chunk {} should come next, but it is chunk {}", self.expected, self.found)
    }
}

impl core::error::Error for Gap {}

impl PartialBudget {
    /// Creates the empty part that begins at a chunk.
    pub(super) fn none(chunk: usize, sources: usize) -> Self {
        Self {
            chunks: chunk..chunk,
            position: PartialErrors::new(sources),
            orientation: PartialErrors::new(sources),
            configurations: 0,
            oriented: 0,
            unreachable: UnreachableSummary::default(),
        }
    }

    /// Returns the chunks of the part.
    pub fn chunks(&self) -> Range<usize> {
        self.chunks.clone()
    }

    /// Returns the number of configurations reached and evaluated.
    pub fn configurations(&self) -> usize {
        self.configurations
    }

    /// Returns the number of unreachable configurations.
    pub fn unreachable(&self) -> usize {
        self.unreachable.count
    }

    /// Appends the following part of the same sweep. Returns [`Gap`] if it begins elsewhere.
    pub fn append(&mut self, next: Self) -> Result<(), Gap> {
        if next.chunks.start != self.chunks.end {
            return Err(Gap { expected: self.chunks.end, found: next.chunks.start });
        }
        self.put(next);
        Ok(())
    }

    /// Appends the following part.
    pub(super) fn put(&mut self, next: Self) {
        self.position.append(next.position);
        self.orientation.append(next.orientation);
        self.configurations += next.configurations;
        self.oriented += next.oriented;
        self.unreachable.append(next.unreachable);
        self.chunks.end = next.chunks.end;
    }
}
