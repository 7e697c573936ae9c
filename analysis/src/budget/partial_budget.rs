//! A part of a budget: what was gathered over some chunks of a workspace, which merges with what follows.

use core::fmt;
use core::ops::Range;

use super::RemainingErrors;
use super::gathering::Gathering;
use crate::UnreachableSummary;

/// What was gathered over some consecutive chunks of a [`BudgetSweep`](super::BudgetSweep).
#[derive(Clone, Debug)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct PartialBudget {
    pub(super) chunks: Range<usize>,
    pub(super) position: Gathering,
    pub(super) orientation: Gathering,
    pub(super) compensation: Option<RemainingErrors>,
    pub(super) configurations: usize,
    pub(super) unreachable: UnreachableSummary,
}

/// A part that does not begin where the one before it ends.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Gap {
    /// The first chunk that is missing, or there twice.
    pub expected: usize,
    /// The chunk that comes instead.
    pub found: usize,
}

impl fmt::Display for Gap {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "chunk {} should come next, but it is chunk {}", self.expected, self.found)
    }
}

impl core::error::Error for Gap {}

impl PartialBudget {
    /// Returns the part of no chunks that begins at one; of so many sources, with what compensation leaves if that is gathered.
    pub(super) fn none(chunk: usize, sources: usize, compensated: bool) -> Self {
        Self {
            chunks: chunk..chunk,
            position: Gathering::new(sources),
            orientation: Gathering::new(sources),
            compensation: compensated.then(RemainingErrors::none),
            configurations: 0,
            unreachable: UnreachableSummary::default(),
        }
    }

    /// The chunks that it is of.
    pub fn chunks(&self) -> Range<usize> {
        self.chunks.clone()
    }

    /// How many configurations were reached and evaluated.
    pub fn configurations(&self) -> usize {
        self.configurations
    }

    /// How many could not be reached.
    pub fn unreachable(&self) -> usize {
        self.unreachable.count
    }

    /// Takes in the part that follows, of the same sweep. Error [`Gap`] if it begins elsewhere.
    pub fn append(&mut self, next: Self) -> Result<(), Gap> {
        if next.chunks.start != self.chunks.end {
            return Err(Gap { expected: self.chunks.end, found: next.chunks.start });
        }
        self.put(next);
        Ok(())
    }

    /// Takes in the part that follows.
    pub(super) fn put(&mut self, next: Self) {
        self.position.append(next.position);
        self.orientation.append(next.orientation);
        if let (Some(here), Some(next)) = (&mut self.compensation, &next.compensation) {
            here.merge(next);
        }
        self.configurations += next.configurations;
        self.unreachable.append(next.unreachable);
        self.chunks.end = next.chunks.end;
    }
}
