//! The models that measurements are compared with.

use std::fmt;

use abbe::analysis::sampling;
use abbe::identify::{Figures, Known, Model, Observation, Role, Seen, Unknown, register};
use abbe::{Class, Description, Manipulator, Pose};

use serde::Serialize;

use crate::data::{Data, Map};
use crate::failure::Failure;

/// A manipulator, and where the instrument sees it.
pub(crate) struct Setup<'a> {
    pub(crate) description: &'a Description,
    pub(crate) pose: bool,
    /// Whether nothing of the base is unknown.
    exact: bool,
    /// The ideal chain, without any source.
    pub(crate) ideal: Model<'a>,
    /// The chain with the repeatable sources of its spec.
    pub(crate) real: Model<'a>,
    /// The sum of the lengths of the chain.
    pub(crate) arm: f64,
    /// How many sources, the last ones, are candidates and no part of the machine.
    pub(crate) candidates: usize,
}

impl<'a> Setup<'a> {
    pub(crate) fn new(
        manipulator: &'a dyn Manipulator,
        map: &Map,
        data: &Data,
        candidates: usize,
    ) -> Result<Self, Failure> {
        let mut setup = Self::placed(manipulator, map, Pose::IDENTITY, candidates)?;
        if map.base_unknown {
            let found =
                base(&setup.ideal, &data.observations).map_err(|error| Failure::of(&data.file, error))?;
            let found = found.ok_or_else(|| {
                Failure::of(&data.file, "where the instrument stands needs three points that are not in line")
                    .help("measure more, or say `base = \"known\"` in the map if it sees in F_0")
            })?;
            setup = Self::placed(manipulator, map, found, candidates)?;
        }
        Ok(setup)
    }

    /// Seen from `F_0` itself.
    pub(crate) fn at_home(manipulator: &'a dyn Manipulator, map: &Map) -> Result<Self, Failure> {
        Self::placed(manipulator, map, Pose::IDENTITY, 0)
    }

    fn placed(
        manipulator: &'a dyn Manipulator,
        map: &Map,
        base: Pose,
        candidates: usize,
    ) -> Result<Self, Failure> {
        let description = manipulator.description();
        let ideal = Model { base, ..Model::ideal(manipulator, map.targets(), map.uncertainty) };
        let mut real = ideal.clone();
        let own = description.sources.len() - candidates;
        for (source, role) in description.sources[..own].iter().zip(&mut real.roles) {
            *role = if source.class == Class::Repeatable { Role::Known } else { Role::Off };
        }
        let arm = sampling::arm_length(manipulator, &ideal.s);
        let arm = arm.map_err(|error| Failure::of(&description.name, error))?;
        Ok(Self { description, pose: map.is_pose(), exact: map.base_exact, ideal, real, arm, candidates })
    }

    /// What is unknown of base and tool.
    pub(crate) fn base_and_tool(&self) -> Vec<Unknown> {
        self.but_exact(self.ideal.base_and_tool(self.pose))
    }

    /// What is unknown of base, frames and tool.
    pub(crate) fn constants(&self) -> Vec<Unknown> {
        self.but_exact(self.ideal.constants(self.pose))
    }

    fn but_exact(&self, mut unknowns: Vec<Unknown>) -> Vec<Unknown> {
        unknowns.retain(|unknown| !(self.exact && matches!(unknown, Unknown::Base(_))));
        unknowns
    }

    /// The values of one model's unknowns in the order of another's.
    pub(crate) fn embedded(from: &Model, x: &[f64], to: &Model) -> Vec<f64> {
        let value = |unknown| from.unknowns.iter().position(|u| u == unknown).map_or(0.0, |k| x[k]);
        to.unknowns.iter().map(value).collect()
    }

    /// The variables that the data move.
    pub(crate) fn moved(&self, data: &[Observation]) -> Vec<usize> {
        let moves = |i: &usize| {
            let values = data.iter().map(|row| row.q[*i]);
            let (least, largest) =
                values.fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), v| (a.min(v), b.max(v)));
            let unit = match self.description.variables[*i].kind {
                abbe::VariableKind::Revolute => 1.0,
                abbe::VariableKind::Prismatic => self.arm,
            };
            largest - least > 1e-4 * unit
        };
        (0..self.description.variables.len()).filter(moves).collect()
    }
}

/// How many errors of base and frames can be known, of how many.
#[derive(Clone, Copy, Debug, Serialize)]
pub(crate) struct Counts {
    rank: usize,
    unknowns: usize,
    base: bool,
}

impl Counts {
    pub(crate) fn of(model: &Model, known: &Known) -> Self {
        let machine = |unknown: &Unknown| matches!(unknown, Unknown::Base(_) | Unknown::Error(..));
        Self {
            // Those of the tool are kept last: only for what no error of a frame stands for.
            rank: known.kept.iter().filter(|k| machine(&model.unknowns[**k])).count(),
            unknowns: model.unknowns.iter().filter(|unknown| machine(unknown)).count(),
            base: model.unknowns.iter().any(|unknown| matches!(unknown, Unknown::Base(_))),
        }
    }
}

impl fmt::Display for Counts {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let of = if self.base { "frames and base" } else { "frames" };
        write!(f, "{} of the {} errors of {of}", self.rank, self.unknowns)
    }
}

/// Where `F_0` is, from all points that were seen: the rigid motion from where they should be.
pub(super) fn base(ideal: &Model, data: &[Observation]) -> Result<Option<Pose>, abbe::Error> {
    let mut room = ideal.room();
    let (mut from, mut to) = (Vec::new(), Vec::new());
    for row in data {
        let pose = ideal.pose(&mut room, row, &[])?;
        match &row.seen {
            Seen::Points(points) => {
                for (target, point) in ideal.targets.iter().zip(points) {
                    if let Some(point) = point {
                        from.push(pose.apply(*target));
                        to.push(*point);
                    }
                }
            }
            Seen::Pose(seen) => {
                from.push(pose.position());
                to.push(seen.position());
            }
        }
    }
    Ok(register(&from, &to).filter(|found| found.breadth > 1e-6).map(|found| found.pose.then(&ideal.base)))
}

/// The norms of the position errors of a model at `x`.
pub(crate) fn norms(model: &Model, data: &Data, x: &[f64]) -> Result<Vec<f64>, Failure> {
    let mut room = model.room();
    let mut norms = Vec::new();
    for (row, line) in data.observations.iter().zip(&data.lines) {
        let errors = model.deviations(&mut room, row, x);
        let errors = errors.map_err(|error| Failure::of(&data.file, format!("line {line}: {error}")))?;
        norms.extend(errors.iter().map(|e| e.iter().map(|v| v * v).sum::<f64>().sqrt()));
    }
    Ok(norms)
}

/// Their figures.
pub(super) fn figures(model: &Model, data: &Data, x: &[f64]) -> Result<Figures, Failure> {
    norms(model, data, x).map(Figures::of)
}
