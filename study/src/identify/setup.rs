//! The models that measurements are compared with.

use abbe::analysis::sampling;
use abbe::identify::{Measurement, Model, Observation, Role, Station, Unknown, register};
use abbe::{Class, Description, Manipulator, Pose, VariableKind};
use abbe_codegen::diagnostic::Diagnostics;

use crate::data::{Base, Data, Map};
use crate::mistake;

/// A manipulator, and where the instrument sees it.
pub(crate) struct Setup<'a> {
    pub(crate) description: &'a Description,
    /// Whether whole poses are measured.
    pub(crate) pose: bool,
    /// The ideal chain, without any source.
    pub(crate) ideal: Model<'a>,
    /// The chain with the repeatable sources of its spec.
    pub(crate) real: Model<'a>,
    /// The sum of the lengths of the chain.
    pub(crate) arm: f64,
}

impl<'a> Setup<'a> {
    /// Seen from where the map and the data say that the instrument stands. The last `terms` sources of the manipulator are
    /// no part of the machine: their magnitudes may become unknowns.
    pub(crate) fn new(
        manipulator: &'a dyn Manipulator,
        map: &Map,
        data: &Data,
        terms: usize,
    ) -> Result<Self, Diagnostics> {
        let ideal = Model::ideal(manipulator, map.targets(), map.uncertainty);
        let base = match map.base {
            Base::Known | Base::Exact => Pose::IDENTITY,
            Base::Unknown => station(&ideal, &data.observations)
                .map_err(|failure| mistake::whole(&data.file, failure))?
                .ok_or_else(|| {
                    let message = "where the instrument stands needs three points that are not in line";
                    let help = "measure more, or say `base = \"known\"` in the map if it sees in F_0";
                    mistake::with_help(&data.file, message, help)
                })?,
        };
        let stations = vec![Station { exact: map.base == Base::Exact, ..Station::at(base) }];
        Self::placed(Model { stations, ..ideal }, map, terms)
    }

    /// Seen from `F_0` itself.
    pub(crate) fn at_home(manipulator: &'a dyn Manipulator, map: &Map) -> Result<Self, Diagnostics> {
        let stations = vec![Station { exact: map.base == Base::Exact, ..Station::at(Pose::IDENTITY) }];
        let ideal = Model::ideal(manipulator, map.targets(), map.uncertainty);
        Self::placed(Model { stations, ..ideal }, map, 0)
    }

    fn placed(ideal: Model<'a>, map: &Map, terms: usize) -> Result<Self, Diagnostics> {
        let description = ideal.manipulator.description();
        let mut real = ideal.clone();
        let own = description.sources.len() - terms;
        for (source, role) in description.sources[..own].iter().zip(&mut real.roles) {
            *role = if source.class == Class::Repeatable { Role::Known } else { Role::Off };
        }
        let arm = sampling::arm_length(ideal.manipulator, &ideal.s);
        let arm = arm.map_err(|error| mistake::whole(&description.name, error))?;
        Ok(Self { description, pose: map.is_pose(), ideal, real, arm })
    }

    /// What is unknown of base and tool.
    pub(crate) fn base_and_tool(&self) -> Vec<Unknown> {
        self.ideal.base_and_tool(self.pose)
    }

    /// What is unknown of base, frames and tool.
    pub(crate) fn constants(&self) -> Vec<Unknown> {
        self.ideal.constants(self.pose)
    }

    /// The variables that the data move.
    pub(crate) fn moved(&self, data: &[Observation]) -> Vec<usize> {
        let moves = |i: &usize| {
            let values = data.iter().map(|row| row.q[*i]);
            let (least, largest) =
                values.fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), v| (a.min(v), b.max(v)));
            let unit = match self.description.variables[*i].kind {
                VariableKind::Revolute => 1.0,
                VariableKind::Prismatic => self.arm,
            };
            largest - least > 1e-4 * unit
        };
        (0..self.description.variables.len()).filter(moves).collect()
    }
}

/// Where `F_0` is as the instrument sees it, from all points that were measured: the rigid motion from where they should be.
/// None if they are in line.
pub(super) fn station(ideal: &Model, data: &[Observation]) -> Result<Option<Pose>, abbe::identify::Failure> {
    let mut room = ideal.room();
    let (mut from, mut to) = (Vec::new(), Vec::new());
    for observation in data {
        let pose = ideal.pose(&mut room, observation, &[])?;
        match &observation.measured {
            Measurement::Points(points) => {
                for (target, point) in ideal.targets.iter().zip(points) {
                    if let Some(point) = point {
                        from.push(pose.apply(*target));
                        to.push(*point);
                    }
                }
            }
            Measurement::Pose(measured) => {
                from.push(pose.position());
                to.push(measured.position());
            }
            Measurement::Readings(_) => {}
        }
    }
    Ok(register(&from, &to)
        .filter(|found| found.breadth > 1e-6)
        .map(|found| found.pose.then(&ideal.stations[0].pose)))
}
