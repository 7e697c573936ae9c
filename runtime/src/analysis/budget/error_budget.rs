//! The error budget of a workspace: every source alone and all together, in one sweep.

use core::ops::Range;

use super::gathering::{self, Beginning, Gathering, Scattered};
use super::remaining_errors;
use super::{Combined, RemainingErrors, Residual, SourceErrors};
use crate::analysis::sweep::{BLOCK, Block, Row, Sweepable, Unevaluated, in_order, ready, sweep};
use crate::analysis::workspace::One;
use crate::analysis::{Measurand, Subset, Unreachable, UnreachableSummary, Workspace};
use crate::lanes::{InstructionSet, Kernel, Lanes, Register};
use crate::{Class, Scalar};

/// How many configurations the error sphere and ellipsoid begin with.
const SCATTERED: usize = 512;
/// Into how many parts a workspace is cut at least, and the most blocks of one.
const CHUNKS: usize = 64;
const LARGEST_CHUNK: usize = 64;

/// What the sources of a manipulator do over a workspace, to first order.
#[derive(Clone, Debug, PartialEq)]
pub struct Budget {
    /// Each source alone, in the order of the description.
    pub sources: Vec<SourceErrors>,
    /// All together.
    pub combined: Combined,
    /// By how much the radius shrinks if a source is made smaller by one percent, in the length unit. Less than
    /// nothing where it counteracts the others.
    pub gains: Vec<f64>,
    /// The same figures of rows 4–6.
    pub orientation: OrientationErrors,
    /// Indices of the configurations at which the tolerances of position and orientation are least likely met, by an
    /// approximation, the least first; no more than 32, and none without a tolerance.
    pub least_likely: [Vec<usize>; 2],
    /// What is left after compensation, if it was asked for.
    pub compensation: Option<RemainingErrors>,
    /// How many configurations were reached and evaluated.
    pub configurations: usize,
    /// Those that could not be reached.
    pub unreachable: UnreachableSummary,
}

impl Budget {
    /// The figures of a measurand: each source alone, all together, and the gains.
    pub fn errors(&self, measurand: Measurand) -> (&[SourceErrors], &Combined, &[f64]) {
        match measurand {
            Measurand::Position => (&self.sources, &self.combined, &self.gains),
            Measurand::Orientation => {
                let OrientationErrors { sources, combined, gains } = &self.orientation;
                (sources, combined, gains)
            }
        }
    }
}

impl Budget {
    /// Where the tolerance of a measurand is least likely met, [`least_likely`](Self::least_likely) of it.
    pub fn least_likely_of(&self, measurand: Measurand) -> &[usize] {
        &self.least_likely[measurand as usize]
    }
}

/// What a budget is asked besides.
#[derive(Clone, Copy, Debug, Default)]
pub struct Asked<'a> {
    /// What compensation leaves of each source, none of random ones; nothing if there is no compensation.
    pub residuals: Option<&'a [Option<Residual>]>,
    /// How large the norms of the errors of position (length unit) and orientation (rad) may be, if that is said.
    pub tolerances: [Option<f64>; 2],
}

/// What the sources do to the orientation of the tool over a workspace: rows 4–6, rad.
#[derive(Clone, Debug, PartialEq)]
pub struct OrientationErrors {
    /// Each source alone, in the order of the description.
    pub sources: Vec<SourceErrors>,
    /// All together.
    pub combined: Combined,
    /// By how much the radius shrinks if a source is made smaller by one percent.
    pub gains: Vec<f64>,
}

/// Who looks on while a budget is made. `()` does not.
pub trait Watch {
    /// Whether every configuration is to be shown: it takes longer than the budget itself.
    fn rows(&self) -> bool {
        false
    }
    /// A configuration that was reached; in order.
    fn row(&mut self, _row: &Row) {}
    /// All configurations before this one are done with.
    fn done(&mut self, _before: usize) {}
}

impl Watch for () {}

/// Every configuration is shown to a function.
impl<F: FnMut(&Row)> Watch for F {
    fn rows(&self) -> bool {
        true
    }

    fn row(&mut self, row: &Row) {
        self(row);
    }
}

/// What the sources do over a workspace, section 5 of the paper.
///
/// Nothing is stored, blocks are evaluated in parallel (feature `parallel`), and on one instruction set the result is the same to the last bit for
/// any number of threads. Errors as for [`sweep`].
pub fn error_budget(
    manipulator: &dyn Sweepable,
    workspace: &dyn Workspace,
    asked: Asked<'_>,
    watch: &mut dyn Watch,
) -> Result<Budget, Unevaluated> {
    let description = manipulator.description();
    ready(manipulator, workspace)?;
    let mut home = Vec::new();
    sweep(manipulator, &One(workspace.home()), &mut |row| home.extend_from_slice(row.sources))
        .map_err(|Unevaluated { error, .. }| Unevaluated { configuration: None, error })?;

    // If one of these cannot be evaluated, the sweep over all of them will say which.
    let known = &description.sources;
    let mut scattered = Measurand::ALL.map(|measurand| Scattered::new(measurand, known));
    let _ = sweep(manipulator, &Subset { workspace, count: SCATTERED }, &mut |row| {
        scattered.iter_mut().for_each(|scattered| scattered.add(known, row));
    });
    let classes = known.iter().map(|source| source.class).collect::<Vec<_>>();
    let [first, second] = scattered;
    let (position, mut around) = first.finish(&classes, &home, asked.tolerances[0]);
    let (orientation, mut about) = second.finish(&classes, &home, asked.tolerances[1]);
    let residuals = asked.residuals;
    let start = Start { manipulator, workspace, classes, residuals, position, orientation };
    let count = workspace.len();
    let blocks = (count / (CHUNKS * BLOCK)).clamp(1, LARGEST_CHUNK);
    let range = |chunk: usize| chunk * blocks * BLOCK..count.min((chunk + 1) * blocks * BLOCK);
    let mut total = Part::new(&start);
    let mut unreachables = UnreachableSummary::default();
    let (rows, mut here) = (watch.rows(), workspace.home().clone());
    in_order(
        count.div_ceil(blocks * BLOCK),
        |chunk| {
            let evaluated = Chunk { start: &start, range: range(chunk), rows };
            InstructionSet::best().run(evaluated).map(|part| (range(chunk).end, part))
        },
        |(end, mut part)| {
            part.unreachable.drain(..).for_each(|unreachable| unreachables.add(unreachable));
            part.blocks.iter().for_each(|block| block.visit(&mut here, &mut |row| watch.row(row)));
            total.position.merge(&part.position, &mut around);
            total.orientation.merge(&part.orientation, &mut about);
            total.merge(&part);
            watch.done(end);
        },
    )?;
    let configurations = total.count;
    let (sources, combined, gains, least_likely) =
        total.position.finish(&start.position, around, configurations);
    let (turned, turns, turn_gains, turn_least_likely) =
        total.orientation.finish(&start.orientation, about, configurations);
    Ok(Budget {
        sources,
        combined,
        gains,
        orientation: OrientationErrors { sources: turned, combined: turns, gains: turn_gains },
        least_likely: [least_likely, turn_least_likely],
        compensation: total.compensation,
        configurations,
        unreachable: unreachables,
    })
}

/// What every chunk begins with.
struct Start<'a> {
    manipulator: &'a dyn Sweepable,
    workspace: &'a dyn Workspace,
    classes: Vec<Class>,
    residuals: Option<&'a [Option<Residual>]>,
    position: Beginning,
    orientation: Beginning,
}

/// What some configurations came to.
struct Part<'a> {
    position: Gathering,
    orientation: Gathering,
    compensation: Option<RemainingErrors>,
    count: usize,
    unreachable: Vec<Unreachable>,
    /// The blocks themselves, if they are to be shown.
    blocks: Vec<Block<'a>>,
}

impl<'a> Part<'a> {
    /// Of no configurations.
    fn new(start: &Start<'a>) -> Self {
        Self {
            position: Gathering::new(start.classes.len()),
            orientation: Gathering::new(start.classes.len()),
            compensation: start.residuals.map(|_| RemainingErrors::none()),
            count: 0,
            unreachable: Vec::new(),
            blocks: Vec::new(),
        }
    }

    /// Takes in what follows, but for the two gatherings.
    fn merge(&mut self, other: &Self) {
        if let (Some(here), Some(other)) = (&mut self.compensation, &other.compensation) {
            here.merge(other);
        }
        self.count += other.count;
    }
}

/// Some blocks of configurations, one after the other.
struct Chunk<'s, 'a> {
    start: &'s Start<'a>,
    range: Range<usize>,
    rows: bool,
}

impl<'a> Kernel for Chunk<'_, 'a> {
    type Output = Result<Part<'a>, Unevaluated>;

    #[inline(always)]
    fn run<R: Register>(self) -> Self::Output {
        let Start { manipulator, workspace, ref classes, residuals, .. } = *self.start;
        let mut part = Part::new(self.start);
        let mut position = gathering::Lane::<R>::new(&self.start.position);
        let mut orientation = gathering::Lane::<R>::new(&self.start.orientation);
        let mut compensated = remaining_errors::Lane::<R>::new();
        let mut indices = Vec::with_capacity(self.range.len());
        let mut block = Block::new(manipulator, workspace, BLOCK.min(self.range.len()));
        for first in self.range.clone().step_by(BLOCK) {
            block.evaluate(first..self.range.end.min(first + BLOCK))?;
            let before = indices.len();
            indices.extend_from_slice(&block.indices);
            let displacements = &block.displacements;
            let (tiles, count) = (displacements.tiles(), displacements.count());
            let lane = Lanes::<R>::from_fn(|lane| lane as f64);
            let place = |tile: usize| lane + Lanes::constant((before + tile * R::WIDTH) as f64);
            let weight = |tile: usize| match count - tile * R::WIDTH {
                left if left < R::WIDTH => Lanes::from_fn(|lane| f64::from(u8::from(lane < left))),
                _ => Lanes::constant(1.0),
            };
            for k in 0..classes.len() {
                for tile in 0..tiles {
                    let rows = displacements.tile::<R>(tile);
                    position.add_source(k, rows, place(tile), weight(tile));
                    orientation.add_source(k, rows, place(tile), weight(tile));
                }
            }
            let index = |place: usize| indices[place];
            for tile in 0..tiles {
                let rows = displacements.tile::<R>(tile);
                let sums = position.add_sums(classes, rows, place(tile), weight(tile), index);
                orientation.add_sums(classes, rows, place(tile), weight(tile), index);
                if let Some(residuals) = residuals {
                    compensated.add(residuals, &position.norm_of, &sums);
                }
            }
            part.unreachable.append(&mut block.unreachable);
            if self.rows {
                let size = BLOCK.min(self.range.len());
                part.blocks.push(core::mem::replace(&mut block, Block::new(manipulator, workspace, size)));
            }
        }
        let index = |place: usize| indices[place];
        part.count = indices.len();
        part.position = position.finish(index);
        part.orientation = orientation.finish(index);
        part.compensation = residuals.map(|_| compensated.finish(index));
        Ok(part)
    }
}
