//! The error budget of a workspace: every source alone and all together, in one sweep.

use core::ops::Range;

use super::combined::{self, Gathered};
use super::enclosing_sphere::{Enclosing, Shell};
use super::gains::{self, Gains};
use super::remaining_errors;
use super::source_errors::{self, Tally, position};
use super::sums::Sums;
use super::{Combined, Ellipsoid, RemainingErrors, Residual, SourceErrors, covariance};
use crate::analysis::sweep::{BLOCK, Block, Row, Sweepable, Unevaluated, in_order, ready, sweep};
use crate::analysis::workspace::One;
use crate::analysis::{Subset, Unreachable, UnreachableSummary, Workspace};
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
    /// What is left after compensation, if it was asked for.
    pub compensation: Option<RemainingErrors>,
    /// How many configurations were reached and evaluated.
    pub configurations: usize,
    /// Those that could not be reached.
    pub unreachable: UnreachableSummary,
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
/// `residuals` says what compensation leaves of each source, none of random ones. Nothing is stored, blocks are
/// evaluated in parallel (feature `parallel`), and on one instruction set the result is the same to the last bit for
/// any number of threads. Errors as for [`sweep`].
pub fn error_budget(
    manipulator: &dyn Sweepable,
    workspace: &dyn Workspace,
    residuals: Option<&[Option<Residual>]>,
    watch: &mut dyn Watch,
) -> Result<Budget, Unevaluated> {
    let description = manipulator.description();
    ready(manipulator, workspace)?;
    let mut home = Vec::new();
    sweep(manipulator, &One(workspace.home()), &mut |row| home.extend_from_slice(row.sources))
        .map_err(|Unevaluated { error, .. }| Unevaluated { configuration: None, error })?;

    // If one of these cannot be evaluated, the sweep over all of them will say which.
    let (mut points, mut ellipsoid) = (Vec::new(), Ellipsoid::default());
    let scattered = Subset { workspace, count: SCATTERED };
    let _ = sweep(manipulator, &scattered, &mut |row| {
        points.push(position(&row.repeatable));
        let other = Ellipsoid::new(covariance(&description.sources, row.sources), row.index);
        if other.principal.deviations[0] > ellipsoid.principal.deviations[0] {
            ellipsoid = other;
        }
    });
    // A little less, for the sweep to find where it is.
    let mut ellipsoid = Ellipsoid { principal: ellipsoid.principal, ..Ellipsoid::default() };
    ellipsoid.principal.deviations = ellipsoid.principal.deviations.map(|axis| axis * (1.0 - 1e-6));
    let mut sphere = Enclosing::new(points.into_iter());

    let start = Start {
        manipulator,
        workspace,
        classes: description.sources.iter().map(|source| source.class).collect(),
        home: &home,
        residuals,
        ellipsoid,
        shell: sphere.shell(),
    };
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
            total.merge(&part, &mut sphere);
            watch.done(end);
        },
    )?;
    let configurations = total.count;
    let sources = total.tallies.into_iter().zip(&start.classes).zip(&home).enumerate();
    let sources =
        sources.map(|(i, ((tally, class), home))| tally.finish(i, *class, *home, configurations)).collect();
    let combined = total.gathered.finish(configurations, sphere);
    Ok(Budget {
        sources,
        gains: total.gains.gains(combined.radius.value),
        combined,
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
    home: &'a [[f64; 6]],
    residuals: Option<&'a [Option<Residual>]>,
    ellipsoid: Ellipsoid,
    shell: Shell,
}

/// What some configurations came to.
struct Part<'a> {
    tallies: Vec<Tally>,
    gathered: Gathered,
    gains: Gains,
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
            tallies: vec![Tally::new(); start.classes.len()],
            gathered: Gathered::new(Ellipsoid::default()),
            gains: Gains::new(start.classes.len()),
            compensation: start.residuals.map(|_| RemainingErrors::none()),
            count: 0,
            unreachable: Vec::new(),
            blocks: Vec::new(),
        }
    }

    /// Takes in what follows.
    fn merge(&mut self, other: &Self, sphere: &mut Enclosing) {
        for (tally, other) in self.tallies.iter_mut().zip(&other.tallies) {
            tally.merge(other);
        }
        self.gathered.merge(&other.gathered, sphere);
        self.gains.merge(&other.gains);
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
        let Start { manipulator, workspace, ref classes, home, residuals, ellipsoid, shell } = *self.start;
        let mut part = Part::new(self.start);
        let of_sources = classes.iter().zip(home);
        let mut singles: Vec<_> =
            of_sources.map(|(class, home)| source_errors::Lane::<R>::new(*class, *home)).collect();
        let mut all = combined::Lane::<R>::new(ellipsoid, shell);
        let mut shrunk = gains::Lane::<R>::new(classes.len());
        let mut compensated = remaining_errors::Lane::<R>::new();
        let mut norm_of = vec![Lanes::constant(0.0); classes.len()];
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
            for (k, single) in singles.iter_mut().enumerate() {
                for tile in 0..tiles {
                    single.add(&displacements.tile::<R>(tile)[6 * k..][..6], place(tile), weight(tile));
                }
            }
            for tile in 0..tiles {
                let rows = displacements.tile::<R>(tile);
                let sums = Sums::new(classes, rows, &mut norm_of, place(tile), weight(tile));
                all.add(&sums, |place| indices[place]);
                shrunk.add(classes, rows, &norm_of, &sums);
                if let Some(residuals) = residuals {
                    compensated.add(residuals, &norm_of, &sums);
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
        part.tallies = singles.into_iter().map(|single| single.finish(index)).collect();
        part.gathered = all.finish(index);
        part.gains = shrunk.finish();
        part.compensation = residuals.map(|_| compensated.finish(index));
        Ok(part)
    }
}
