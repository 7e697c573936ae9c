//! `ΔX = J_e ε` of every source at the configurations of one block.
//!
//! The sweep over the blocks of a workspace.

use core::ops::Range;
use std::borrow::Cow;

use abbe_core::lanes::{InstructionSet, Kernel, Lanes, Register, Sweepable, Tiles};
use abbe_core::{Class, Error, Function, MINIMUM_MARGIN, Orientation, Pose, Quantity, Scalar, checks};
use abbe_kinematics::STREAM;

use super::{Row, Unevaluated, in_order};
use crate::{Configuration, ErrorParts, Measurand, ReachError, Unreachable, UnreachableSummary, Workspace};

/// Block of configurations: a buffer that is evaluated repeatedly.
pub(crate) struct Block<'a> {
    manipulator: &'a dyn Sweepable,
    workspace: &'a dyn Workspace,
    /// Factors of the displacements of every source.
    bounds: Vec<f64>,
    parts: ErrorParts,
    /// Index in the workspace of every reachable configuration.
    pub(crate) indices: Vec<usize>,
    arguments: Tiles,
    /// ΔX of every source, the bound for a random one: six rows each, followed by the margin of
    /// Euler rows. Rows 4–6 are 0 where they do not exist.
    pub(crate) displacements: Tiles,
    /// Places of the configurations at which Euler rows are singular.
    singular: Vec<usize>,
    pub(crate) unreachable: Vec<Unreachable>,
}

impl<'a> Block<'a> {
    /// Creates a block for at most `size` configurations of a workspace.
    pub(crate) fn new(manipulator: &'a dyn Sweepable, workspace: &'a dyn Workspace, size: usize) -> Self {
        let description = manipulator.description();
        let signature = Function::SourceDisplacements.signature();
        let set = InstructionSet::best();
        let mut arguments = Tiles::new(set, signature.arguments_len(description), size);
        let home = workspace.home();
        for (row, value) in home.q.iter().chain(&home.s).chain(&home.u).enumerate() {
            arguments.fill_row(row, *value);
        }
        let bounds = description.sources.iter().map(|source| source.class.bound());
        Self {
            manipulator,
            workspace,
            bounds: bounds.collect(),
            parts: ErrorParts::new(description),
            indices: Vec::with_capacity(size),
            arguments,
            displacements: Tiles::new(set, signature.results_len(description), size),
            singular: Vec::new(),
            unreachable: Vec::new(),
        }
    }

    /// Evaluates the configurations of a range of indices, at most `size` of them.
    pub(crate) fn evaluate(&mut self, range: Range<usize>) -> Result<(), Unevaluated> {
        self.fill(range)?;
        self.singular.clear();
        loop {
            let evaluated = self.manipulator.source_displacements(&self.arguments, &mut self.displacements);
            evaluated.map_err(|error| self.at(0, error))?;
            let euler = self.manipulator.description().orientation != Orientation::RotationVector;
            let sound = self.displacements.instruction_set().run(Scaled {
                displacements: &mut self.displacements,
                bounds: &self.bounds,
                euler,
            });
            let reached = self.indices.len();
            if sound || reached == 0 {
                break;
            }
            self.find_singular()?;
            if self.indices.len() == reached {
                break;
            }
        }
        self.unreachable.sort_by_key(|unreachable| unreachable.index);
        Ok(())
    }

    /// Returns the indices and the displacements of the configurations at which rows 4–6 exist.
    pub(crate) fn oriented(&self) -> (Cow<'_, [usize]>, Cow<'_, Tiles>) {
        if self.singular.is_empty() {
            return (Cow::Borrowed(&self.indices), Cow::Borrowed(&self.displacements));
        }
        let kept: Vec<usize> = (0..self.indices.len()).filter(|place| self.is_oriented(*place)).collect();
        let rows = self.displacements.rows();
        let mut displacements = Tiles::new(self.displacements.instruction_set(), rows, kept.len());
        for (to, from) in kept.iter().enumerate() {
            for row in 0..rows {
                displacements.set_value(row, to, self.displacements.get(row, *from));
            }
        }
        displacements.pad();
        (kept.iter().map(|place| self.indices[*place]).collect(), Cow::Owned(displacements))
    }

    fn is_oriented(&self, place: usize) -> bool {
        self.singular.binary_search(&place).is_err()
    }

    /// Writes the reachable configurations of a range to the arguments.
    fn fill(&mut self, range: Range<usize>) -> Result<(), Unevaluated> {
        self.indices.clear();
        self.arguments.resize(range.len());
        if self.workspace.fill_rows(range.clone(), &mut self.arguments) {
            self.indices.extend(range);
        } else {
            let indices: Vec<usize> = range.collect();
            let mut refused = None;
            let workspace = self.workspace;
            workspace.fill_each(&indices, &mut |place, configuration, filled| {
                let index = indices[place];
                match filled {
                    Ok(()) => {
                        let inputs = checks::inputs(&self.manipulator.description().inputs, &configuration.u);
                        if let (None, Err(error)) = (refused, inputs) {
                            refused = Some(Unevaluated { configuration: Some(index), error });
                        }
                        self.write(self.indices.len(), configuration);
                        self.indices.push(index);
                    }
                    Err(reason) => {
                        let (point, requested) = (workspace.point(index), configuration.clone());
                        self.unreachable.push(Unreachable { index, point, requested, reason });
                    }
                }
            });
            refused.map_or(Ok(()), Err)?;
        }
        self.finish_filling();
        Ok(())
    }

    fn finish_filling(&mut self) {
        self.arguments.resize(self.indices.len());
        self.arguments.pad();
        self.displacements.resize(self.indices.len());
    }

    fn write(&mut self, place: usize, configuration: &Configuration) {
        let Configuration { q, s, u } = configuration;
        for (row, value) in q.iter().chain(s).chain(u).enumerate() {
            self.arguments.set_value(row, place, *value);
        }
    }

    /// Reads a configuration back. `configuration` must have the lengths of those of the workspace.
    pub(crate) fn configuration(&self, place: usize, configuration: &mut Configuration) {
        let Configuration { q, s, u } = configuration;
        let (first_s, first_u) = (q.len(), q.len() + s.len());
        self.arguments.copy_rows(0..first_s, place, q);
        self.arguments.copy_rows(first_s..first_u, place, s);
        self.arguments.copy_rows(first_u..first_u + u.len(), place, u);
    }

    /// Finds the configurations whose Euler rows are singular: their rows 4–6 become 0. Returns an
    /// error for other values that are not finite.
    ///
    /// Configurations that scalar code accepts stay, although lanes are below the margin by a
    /// rounding error. A manipulator written by hand may have no position rows there, either: such
    /// configurations are removed and count as unreachable. So do those where loops do not close.
    fn find_singular(&mut self) -> Result<(), Unevaluated> {
        let description = self.manipulator.description();
        let sources = description.sources.len();
        let mut here = self.workspace.home().clone();
        let mut columns = vec![[0.0; 6]; 6 * description.frames.len()];
        let mut effects = vec![0.0; description.effects.len()];
        self.singular.clear();
        let mut kept = 0;
        for place in 0..self.indices.len() {
            self.configuration(place, &mut here);
            let index = self.indices[place];
            let jacobian = self.manipulator.error_jacobian(&here.q, &here.s, &mut columns);
            let effects = self.manipulator.effects(&here.q, &here.s, &here.u, &mut effects);
            if !jacobian.is_err_and(|error| error.is_open()) {
                effects.map_err(|error| self.at(place, error))?;
            }
            let infinite = |rows: usize| {
                (0..sources).find(|source| {
                    (0..rows).any(|row| !self.displacements.get(6 * source + row, place).is_finite())
                })
            };
            match jacobian {
                Ok(_) => {
                    if let Some(source) = infinite(6) {
                        let effect = description.effects.iter().position(|effect| effect.source == source);
                        let index = effect.unwrap_or(0);
                        return Err(self.at(place, Error::NotFinite { quantity: Quantity::Effects, index }));
                    }
                }
                // Lanes may close where a single configuration barely does not.
                Err(error)
                    if error.is_open()
                        || matches!(error, Error::EulerSingularity { .. }) && infinite(3).is_some() =>
                {
                    let (point, reason) = (self.workspace.point(index), ReachError::Evaluation(error));
                    self.unreachable.push(Unreachable { index, point, requested: here.clone(), reason });
                    continue;
                }
                Err(Error::EulerSingularity { .. }) => {
                    for row in (0..sources).flat_map(|source| 6 * source + 3..6 * source + 6) {
                        self.displacements.set_value(row, place, 0.0);
                    }
                    self.singular.push(place);
                }
                Err(error) => return Err(self.at(place, error)),
            }
            self.indices[kept] = index;
            self.write(kept, &here);
            kept += 1;
        }
        if kept < self.indices.len() {
            self.indices.truncate(kept);
            self.finish_filling();
        } else {
            self.displacements.pad();
        }
        Ok(())
    }

    fn at(&self, place: usize, error: Error) -> Unevaluated {
        Unevaluated { configuration: self.indices.get(place).copied(), error }
    }

    /// Visits the rows in order. `here` is a buffer with the lengths of the configurations of the
    /// workspace.
    pub(crate) fn visit(&self, here: &mut Configuration, visit: &mut dyn FnMut(&Row)) {
        let description = self.manipulator.description();
        let signature = Function::Pose.signature();
        let arguments = self.arguments.first_rows(signature.arguments_len(description));
        let rows = signature.results_len(description);
        let mut poses = Tiles::new(arguments.instruction_set(), rows, arguments.count());
        let evaluated = self.manipulator.poses(&arguments, &mut poses);
        debug_assert!(evaluated.is_ok(), "the same arguments served before");
        let mut sources = vec![[0.0; 6]; description.sources.len()];
        for (place, &index) in self.indices.iter().enumerate() {
            self.configuration(place, here);
            let mut pose = Pose::IDENTITY;
            poses.copy_rows(0..rows, place, pose.0.as_flattened_mut());
            self.displacements.copy_rows(0..6 * sources.len(), place, sources.as_flattened_mut());
            let (mut repeatable, mut squares) = ([0.0; 6], [0.0; 6]);
            for (source, deviation) in description.sources.iter().zip(&sources) {
                for (row, entry) in deviation.iter().enumerate() {
                    match source.class {
                        Class::Repeatable => repeatable[row] += entry,
                        Class::Tolerance(_) | Class::Random(_) => squares[row] += entry * entry,
                    }
                }
            }
            let random_norms = Measurand::ALL.map(|measurand| {
                let excess = |parts: &[usize]| {
                    let ([x, y, z], norm) = self.parts.largest(parts[0], &sources, measurand);
                    x * x + y * y + z * z - norm * norm
                };
                let rows = measurand.rows(&squares).iter().sum::<f64>();
                (rows - self.parts.with_parts().map(excess).sum::<f64>()).max(0.0).sqrt()
            });
            let (random, oriented) = (squares.map(f64::sqrt), self.is_oriented(place));
            let sources = &sources[..];
            visit(&Row {
                index,
                configuration: here,
                pose,
                oriented,
                sources,
                repeatable,
                random,
                random_norms,
            });
        }
    }
}

/// Scales the displacements of every source by its bound. Returns whether all are finite and Euler
/// margins are large enough.
struct Scaled<'a> {
    displacements: &'a mut Tiles,
    bounds: &'a [f64],
    euler: bool,
}

impl Kernel for Scaled<'_> {
    type Output = bool;

    #[inline(always)]
    fn run<R: Register>(self) -> bool {
        let zero = Lanes::<R>::constant(0.0);
        // A finite number times 0 is 0, all others are NaN.
        let (mut nothing, mut margin) = (zero, Lanes::constant(f64::INFINITY));
        for tile in 0..self.displacements.tiles() {
            let rows = self.displacements.tile_mut::<R>(tile);
            for (bound, rows) in self.bounds.iter().zip(rows.chunks_exact_mut(6)) {
                let bound = Lanes::constant(*bound);
                for row in rows {
                    *row = *row * bound;
                    nothing = row.mul_add(zero, nothing);
                }
            }
            if self.euler {
                margin = margin.min(rows[6 * self.bounds.len()]);
                nothing = rows[6 * self.bounds.len()].mul_add(zero, nothing);
            }
        }
        nothing.as_slice().iter().all(|value| *value == 0.0)
            && margin.as_slice().iter().all(|margin| *margin >= MINIMUM_MARGIN)
    }
}

/// Number of configurations evaluated at once: few enough for the displacements to stay in the
/// cache, and as many as share one stream of random numbers.
pub const BLOCK: usize = STREAM;

/// Evaluates all sources at all reachable configurations and visits them in order. Returns a
/// summary of the unreachable ones.
///
/// The effects of one source share one magnitude, so its ΔX is their sum with signs. Blocks are
/// evaluated in parallel (feature `parallel`), with the same results for any number of threads.
/// Returns [`Error::Count`] before the first visit if the workspace belongs to another manipulator,
/// and [`Error::OutOfRange`] if an input is outside its range.
///
/// [`Error::Count`]: abbe_core::Error::Count
/// [`Error::OutOfRange`]: abbe_core::Error::OutOfRange
pub fn sweep(
    manipulator: &dyn Sweepable,
    workspace: &dyn Workspace,
    visit: &mut dyn FnMut(&Row),
) -> Result<UnreachableSummary, Unevaluated> {
    ready(manipulator, workspace)?;
    let mut here = workspace.home().clone();
    let mut unreachables = UnreachableSummary::default();
    let count = workspace.len();
    in_order(
        count.div_ceil(BLOCK),
        |block| {
            let range = block * BLOCK..count.min((block + 1) * BLOCK);
            let mut block = Block::new(manipulator, workspace, range.len());
            block.evaluate(range)?;
            Ok(block)
        },
        |mut block| {
            block.unreachable.drain(..).for_each(|unreachable| unreachables.add(unreachable));
            block.visit(&mut here, visit);
        },
    )?;
    Ok(unreachables.finish())
}

/// Checks that a workspace belongs to a manipulator.
pub(crate) fn ready(manipulator: &dyn Sweepable, workspace: &dyn Workspace) -> Result<(), Unevaluated> {
    let description = manipulator.description();
    let Configuration { q, s, u } = workspace.home();
    let fits = || {
        checks::length(Quantity::Variables, [description.variables.len(), 1], q.len())?;
        checks::length(Quantity::Parameters, [description.parameters.len(), 1], s.len())?;
        checks::length(Quantity::Inputs, [description.inputs.len(), 1], u.len())?;
        checks::finite(Quantity::Inputs, u)?;
        checks::inputs(&description.inputs, u)
    };
    fits().map_err(|error| Unevaluated { configuration: None, error })
}
