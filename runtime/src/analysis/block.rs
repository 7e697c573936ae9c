//! `ΔX = J_e ε` of every source at the configurations of one block.

use core::ops::Range;

use super::{Configuration, Row, Unevaluated, Unreachable, Unreached, Workspace};
use crate::{Class, Error, Manipulator, Pose, Quantity};

/// What a block of configurations came to: everything that a [`Row`] shows, row after row.
pub(super) struct Block {
    indices: Vec<usize>,
    q: Vec<f64>,
    s: Vec<f64>,
    poses: Vec<Pose>,
    sources: Vec<[f64; 6]>,
    sums: Vec<Sums>,
    pub(super) unreachable: Vec<Unreachable>,
}

/// The repeatable sources summed, the random ones as root sum of squares.
struct Sums {
    repeatable: [f64; 6],
    random: [f64; 6],
}

impl Block {
    /// Evaluates the configurations of a range of indices.
    pub(super) fn new(
        manipulator: &dyn Manipulator,
        workspace: &dyn Workspace,
        u: &[f64],
        range: Range<usize>,
    ) -> Result<Self, Unevaluated> {
        let mut block = Self::reached(workspace, range);
        let description = manipulator.description();
        let (columns_each, effects_each) = (6 * description.frames.len(), description.effects.len());
        let (rows, columns, effects) = loop {
            let rows = block.indices.len();
            let mut columns = vec![[0.0; 6]; rows * columns_each];
            let mut effects = vec![0.0; rows * effects_each];
            block.poses.resize(rows, Pose::IDENTITY);
            let Block { q, s, poses, .. } = &mut block;
            match manipulator.error_models(q, s, &u.repeat(rows), poses, &mut columns, &mut effects) {
                Ok(()) => break (rows, columns, effects),
                // Where Euler rows do not exist there is nothing to sum up: set aside and counted, like a point
                // that cannot be reached.
                Err((i, error @ Error::EulerSingularity { .. })) if i < rows => {
                    block.set_aside(workspace, i, error);
                }
                Err((i, error)) => return Err(block.at(i, error)),
            }
        };

        block.unreachable.sort_by_key(|unreachable| unreachable.index);

        // Of every effect: its source, its column of J_e, and what its value is multiplied with.
        let parts = description.effects.iter().map(|effect| {
            let column = 6 * effect.frame + effect.component.index();
            (effect.source, column, bound(description.sources[effect.source].class))
        });
        let parts = parts.collect::<Vec<_>>();
        let sources_each = description.sources.len();
        block.sources.resize(rows * sources_each, [0.0; 6]);
        for i in 0..rows {
            let columns = &columns[i * columns_each..][..columns_each];
            let effects = &effects[i * effects_each..][..effects_each];
            let sources = &mut block.sources[i * sources_each..][..sources_each];
            for (&(source, column, bound), value) in parts.iter().zip(effects) {
                add_scaled(&mut sources[source], &columns[column], value * bound);
            }
            let (mut repeatable, mut squares) = ([0.0; 6], [0.0; 6]);
            for (source, deviation) in description.sources.iter().zip(&*sources) {
                match source.class {
                    Class::Repeatable => add_scaled(&mut repeatable, deviation, 1.0),
                    Class::Random(_) => add_scaled(&mut squares, &deviation.map(|row| row * row), 1.0),
                }
            }
            if repeatable.iter().chain(&squares).any(|row| !row.is_finite()) {
                let infinite = |sum: &[f64; 6]| sum.iter().any(|row| !row.is_finite());
                let source = sources.iter().position(infinite).unwrap_or(0);
                let index = parts.iter().position(|part| part.0 == source).unwrap_or(0);
                return Err(block.at(i, Error::NotFinite { quantity: Quantity::Errors, index }));
            }
            block.sums.push(Sums { repeatable, random: squares.map(f64::sqrt) });
        }
        Ok(block)
    }

    /// The configurations that can be reached, and why the others cannot.
    fn reached(workspace: &dyn Workspace, range: Range<usize>) -> Self {
        let home = workspace.home();
        let (mut q, mut s) = (Vec::new(), Vec::new());
        q.reserve_exact(range.len() * home.q.len());
        s.reserve_exact(range.len() * home.s.len());
        let (mut indices, mut unreachable) = (Vec::with_capacity(range.len()), Vec::new());
        for index in range {
            let (q_end, s_end) = (q.len(), s.len());
            q.resize(q_end + home.q.len(), 0.0);
            s.resize(s_end + home.s.len(), 0.0);
            match workspace.fill(index, &mut q[q_end..], &mut s[s_end..]) {
                Ok(()) => indices.push(index),
                Err(reason) => {
                    let asked = Configuration { q: q.split_off(q_end), s: s.split_off(s_end) };
                    unreachable.push(Unreachable { index, point: workspace.point(index), asked, reason });
                }
            }
        }
        Self { indices, q, s, poses: Vec::new(), sources: Vec::new(), sums: Vec::new(), unreachable }
    }

    fn set_aside(&mut self, workspace: &dyn Workspace, i: usize, error: Error) {
        let (variables, parameters) = (workspace.home().q.len(), workspace.home().s.len());
        let asked = Configuration {
            q: self.q.drain(i * variables..(i + 1) * variables).collect(),
            s: self.s.drain(i * parameters..(i + 1) * parameters).collect(),
        };
        let index = self.indices.remove(i);
        let reason = Unreached::Evaluation(error);
        self.unreachable.push(Unreachable { index, point: workspace.point(index), asked, reason });
    }

    fn at(&self, i: usize, error: Error) -> Unevaluated {
        Unevaluated { configuration: self.indices.get(i).copied(), error }
    }

    /// Visits the rows. The place holds one configuration at a time, as long as those of the workspace.
    pub(super) fn visit(&self, place: &mut Configuration, visit: &mut dyn FnMut(&Row)) {
        let (variables, parameters) = (place.q.len(), place.s.len());
        let sources = self.sources.len() / self.indices.len().max(1);
        for (i, sums) in self.sums.iter().enumerate() {
            place.q.copy_from_slice(&self.q[i * variables..][..variables]);
            place.s.copy_from_slice(&self.s[i * parameters..][..parameters]);
            visit(&Row {
                index: self.indices[i],
                configuration: place,
                pose: self.poses[i],
                sources: &self.sources[i * sources..][..sources],
                repeatable: sums.repeatable,
                random: sums.random,
            });
        }
    }
}

/// What a source's value is multiplied with: its sign counts, or its bound.
fn bound(class: Class) -> f64 {
    match class {
        Class::Repeatable => 1.0,
        Class::Random(distribution) => distribution.bound(),
    }
}

fn add_scaled(sum: &mut [f64; 6], column: &[f64; 6], factor: f64) {
    for (sum, entry) in sum.iter_mut().zip(column) {
        *sum += entry * factor;
    }
}
