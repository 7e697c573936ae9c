//! Error budgets in parts: a workspace is divided into chunks, whose partial results merge.
//!
//! Partial budgets over some chunks of a workspace, which merge.

use core::fmt;
use core::ops::{ControlFlow, Range};

use abbe_core::lanes::{InstructionSet, Kernel, Register, Sweepable};
use abbe_kinematics::one;

use super::partial_errors::{self, InitialErrors, PartialErrors, SampleErrors};
use super::sums::SourceKinds;
use super::{Budget, BudgetOptions, OrientationErrors, Watch};
use crate::sweep::{BLOCK, Block, Unevaluated, in_order_until, ready, sweep};
use crate::{Measurand, ReachError, Subset, UnreachableSummary, Workspace};

/// Smallest and largest number of configurations from which the ellipsoid is
/// initialized, about one of 256.
const SCATTERED: [usize; 2] = [512, 8192];
/// Smallest number of chunks of a large workspace, and largest number of blocks of a chunk.
const CHUNKS: usize = 64;
const LARGEST_CHUNK: usize = 256;

/// Computes the error budget of a workspace, section 5 of the paper.
///
/// Nothing is stored, and blocks are evaluated in parallel (feature `parallel`). On one instruction
/// set the result is the same to the last bit for any number of threads, and for any division of a
/// [`BudgetSweep`] into parts. Errors as for [`sweep`](crate::sweep).
pub fn error_budget(
    manipulator: &dyn Sweepable,
    workspace: &dyn Workspace,
    options: BudgetOptions,
    watch: &mut dyn Watch,
) -> Result<Budget, Unevaluated> {
    let sweep = BudgetSweep::new(manipulator, workspace, options)?;
    Ok(sweep.finish(sweep.part(0..sweep.chunks(), watch)?))
}

/// Error budget that is computed in parts, on one machine or on several.
///
/// The chunks of a workspace depend on its size alone. On one instruction set the budget is the
/// same to the last bit for any division of the chunks into parts.
///
/// ```
/// # include!(concat!(env!("CARGO_MANIFEST_DIR"), "/../tests/golden/pps.rs"));
/// # fn main() -> Result<(), Box<dyn core::error::Error>> {
/// # use pps::Pps;
/// use abbe::analysis::{BudgetOptions, BudgetSweep, error_budget, joint_samples};
///
/// let workspace = joint_samples(&Pps, &[0, 1, 2, 3], 10_000)?;
/// let sweep = BudgetSweep::new(&Pps, &workspace, BudgetOptions::default())?;
/// let mut part = sweep.part(0..20, &mut ())?;
/// part.append(sweep.part(20..sweep.chunks(), &mut ())?)?;
/// assert_eq!(sweep.finish(part), error_budget(&Pps, &workspace, BudgetOptions::default(), &mut ())?);
/// # Ok(())
/// # }
/// ```
pub struct BudgetSweep<'a> {
    manipulator: &'a dyn Sweepable,
    workspace: &'a dyn Workspace,
    sources: usize,
    position: InitialErrors,
    orientation: InitialErrors,
    oriented_at_home: bool,
    /// Number of configurations of a chunk. The last one may have fewer.
    chunk: usize,
}

impl<'a> BudgetSweep<'a> {
    /// Prepares the sweep with a sample of configurations, which initializes all parts. Errors as
    /// for [`sweep`].
    pub fn new(
        manipulator: &'a dyn Sweepable,
        workspace: &'a dyn Workspace,
        options: BudgetOptions,
    ) -> Result<Self, Unevaluated> {
        ready(manipulator, workspace)?;
        let (mut home, mut oriented_at_home) = (Vec::new(), true);
        let unreached = sweep(manipulator, &one(workspace.home()), &mut |row| {
            home.extend_from_slice(row.sources);
            oriented_at_home = row.oriented;
        });
        let unreached =
            unreached.map_err(|Unevaluated { error, .. }| Unevaluated { configuration: None, error })?;
        if let Some(&(ReachError::Evaluation(error), _)) = unreached.reasons.first() {
            return Err(Unevaluated { configuration: None, error });
        }
        // If one of these cannot be evaluated, the sweep over all of them reports it.
        let known = &manipulator.description().sources;
        let mut sample = Measurand::ALL.map(SampleErrors::new);
        let count = (workspace.len() / 256).clamp(SCATTERED[0], SCATTERED[1]);
        let _ = sweep(manipulator, &Subset { workspace, count }, &mut |row| {
            sample.iter_mut().for_each(|sample| sample.add(known, row));
        });
        let (sources, kinds) = (known.len(), SourceKinds::new(manipulator.description()));
        let [first, second] = sample;
        Ok(Self {
            manipulator,
            workspace,
            position: first.finish(&kinds, &home, options.tolerances[0]),
            orientation: second.finish(&kinds, &home, options.tolerances[1]),
            sources,
            oriented_at_home,
            chunk: (workspace.len() / (CHUNKS * BLOCK)).clamp(1, LARGEST_CHUNK) * BLOCK,
        })
    }

    /// Returns the number of chunks: about 64, or more so that none has more than
    /// 16,384 configurations.
    pub fn chunks(&self) -> usize {
        self.workspace.len().div_ceil(self.chunk)
    }

    /// Returns the indices of the configurations of some chunks.
    pub fn configurations(&self, chunks: &Range<usize>) -> Range<usize> {
        let at = |chunk: usize| self.workspace.len().min(chunk.saturating_mul(self.chunk));
        at(chunks.start)..at(chunks.end)
    }

    /// Evaluates some chunks; fewer if the watcher stops. Errors as for [`sweep`].
    pub fn part(&self, chunks: Range<usize>, watch: &mut dyn Watch) -> Result<PartialBudget, Unevaluated> {
        let chunks = chunks.start..chunks.end.min(self.chunks()).max(chunks.start);
        let mut total = PartialBudget::none(chunks.start, self.sources);
        let (rows, mut here) = (watch.rows(), self.workspace.home().clone());
        in_order_until(
            chunks.len(),
            |i| InstructionSet::best().run(Chunk { sweep: self, number: chunks.start + i, rows }),
            |(part, blocks)| {
                blocks.iter().for_each(|block| block.visit(&mut here, &mut |row| watch.row(row)));
                let done = self.configurations(&part.chunks).end;
                total.put(part);
                if watch.done(done) { ControlFlow::Continue(()) } else { ControlFlow::Break(()) }
            },
        )?;
        Ok(total)
    }

    /// Returns whether a part can belong to this sweep. It may come from a file.
    pub fn fits(&self, part: &PartialBudget) -> bool {
        let PartialBudget { chunks, position, orientation, configurations, oriented, unreachable } = part;
        let description = self.manipulator.description();
        let sources = self.sources;
        let mut indices = [position, orientation].into_iter().flat_map(PartialErrors::indices);
        chunks.start <= chunks.end
            && chunks.end <= self.chunks()
            && position.is_valid_for(sources, chunks.clone())
            && orientation.is_valid_for(sources, chunks.clone())
            && configurations.checked_add(unreachable.count) == Some(self.configurations(chunks).len())
            && oriented <= configurations
            && unreachable.is_sound(description)
            && indices.all(|index| index < self.workspace.len())
    }

    /// Returns the budget of the complete sweep.
    pub fn finish(&self, part: PartialBudget) -> Budget {
        let count = part.configurations;
        let (sources, combined, least_likely) = part.position.finish(&self.position, count);
        let (turned, turns, turn_least_likely) = part.orientation.finish(&self.orientation, part.oriented);
        let orientation = OrientationErrors {
            sources: turned,
            combined: turns,
            configurations: part.oriented,
            at_home: self.oriented_at_home,
        };
        Budget {
            sources,
            combined,
            orientation,
            least_likely: [least_likely, turn_least_likely],
            configurations: count,
            unreachable: part.unreachable.finish(),
        }
    }
}

/// Chunk: consecutive blocks of configurations.
struct Chunk<'s, 'a> {
    sweep: &'s BudgetSweep<'a>,
    number: usize,
    rows: bool,
}

impl<'a> Kernel for Chunk<'_, 'a> {
    /// Partial budget, and the blocks themselves if rows are requested.
    type Output = Result<(PartialBudget, Vec<Block<'a>>), Unevaluated>;

    #[inline(always)]
    fn run<R: Register>(self) -> Self::Output {
        let BudgetSweep { manipulator, workspace, .. } = *self.sweep;
        let (mut part, mut blocks) = (PartialBudget::none(self.number, self.sweep.sources), Vec::new());
        part.chunks.end += 1;
        let range = self.sweep.configurations(&part.chunks);
        let mut position = partial_errors::ErrorsAccumulator::<R>::new(&self.sweep.position);
        let mut orientation = partial_errors::ErrorsAccumulator::<R>::new(&self.sweep.orientation);
        let (mut indices, mut oriented) = (Vec::with_capacity(range.len()), Vec::new());
        let mut block = Block::new(manipulator, workspace, BLOCK.min(range.len()));
        for first in range.clone().step_by(BLOCK) {
            block.evaluate(first..range.end.min(first + BLOCK))?;
            let before = indices.len();
            indices.extend_from_slice(&block.indices);
            position.add(&self.sweep.position, &block.displacements, before, |place| indices[place]);
            let before = oriented.len();
            let (kept, displacements) = block.oriented();
            oriented.extend_from_slice(&kept);
            orientation.add(&self.sweep.orientation, &displacements, before, |place| oriented[place]);
            block.unreachable.drain(..).for_each(|unreachable| part.unreachable.add(unreachable));
            if self.rows {
                let size = BLOCK.min(range.len());
                blocks.push(core::mem::replace(&mut block, Block::new(manipulator, workspace, size)));
            }
        }
        let index = |place: usize| indices[place];
        part.configurations = indices.len();
        part.position = position.finish(self.number, index);
        part.oriented = oriented.len();
        part.orientation = orientation.finish(self.number, |place| oriented[place]);
        Ok((part, blocks))
    }
}

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
