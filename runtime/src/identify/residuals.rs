//! Model minus measurement, and how it moves with every unknown.

use super::columns::{Displaced, Frame, turned};
use super::gradient::Gradient;
use super::{Distances, Failure, Figures, Measurement, Model, Observation, Role, Uncertainty, Unknown};
use crate::analysis::sampling;
use crate::chain::rotation_vector;
use crate::{Component, Error, Pose, Quantity};

/// Room for the numbers of one configuration, made once and used for many.
#[derive(Clone, Debug)]
pub struct Room {
    transforms: Vec<Pose>,
    pub(super) errors: Vec<[f64; 6]>,
    effects: Vec<f64>,
    pub(super) frames: Vec<Frame>,
    /// What the errors of base, frames and tool do.
    displaced: Vec<Displaced>,
    /// How a point moves with every unknown, once somebody has asked.
    moves: Vec<[f64; 3]>,
    pub(super) targets: Vec<[f64; 3]>,
    pub(super) fixtures: Vec<[f64; 3]>,
    pub(super) zeros: Vec<f64>,
    station: usize,
    base: [f64; 6],
    tool: [f64; 6],
}

impl Model<'_> {
    /// ε and the tool, at one configuration.
    fn errors(&self, room: &mut Room, observation: &Observation, x: &[f64]) -> Result<(), Error> {
        room.errors.fill([0.0; 6]);
        room.tool = [0.0; 6];
        room.base = [0.0; 6];
        room.station = observation.station;
        room.targets.copy_from_slice(&self.targets);
        room.fixtures.fill([0.0; 3]);
        for (zero, reading) in room.zeros.iter_mut().zip(&self.readings) {
            *zero = reading.zero;
        }
        let description = self.manipulator.description();
        if self.roles.iter().any(|role| *role != Role::Off) {
            self.manipulator.effects(&observation.q, &self.s, &observation.u, &mut room.effects)?;
            for (effect, value) in description.effects.iter().zip(&room.effects) {
                if self.roles[effect.source] == Role::Known {
                    room.errors[effect.frame][effect.component.index()] += value;
                }
            }
        }
        for (unknown, value) in self.unknowns.iter().zip(x) {
            match *unknown {
                Unknown::Base(station, component) if station == observation.station => {
                    room.base[component.index()] += value;
                }
                Unknown::Base(..) => {}
                Unknown::Error(frame, component) => room.errors[frame][component.index()] += value,
                Unknown::Tool(component) => room.tool[component.index()] += value,
                Unknown::Target(target, axis) => room.targets[target][axis] += value,
                Unknown::Fixture(fixture, coordinate) => room.fixtures[fixture][coordinate] += value,
                Unknown::Zero(reading) => room.zeros[reading] += value,
                Unknown::Magnitude(source) => {
                    for (effect, size) in description.effects.iter().zip(&room.effects) {
                        if effect.source == source {
                            room.errors[effect.frame][effect.component.index()] += value * size;
                        }
                    }
                }
            }
        }
        Ok(())
    }

    /// Runs along the chain: where everything is, and how it moves.
    fn chain(&self, room: &mut Room, observation: &Observation, x: &[f64]) -> Result<(), Failure> {
        let station = self.stations.get(observation.station).ok_or(Failure::Observation {
            line: observation.line,
            error: Error::Count {
                quantity: Quantity::Pose,
                expected: self.stations.len(),
                found: observation.station + 1,
            },
        })?;
        self.errors(room, observation, x)
            .and_then(|()| self.manipulator.transforms(&observation.q, &self.s, &mut room.transforms))
            .map_err(|error| Failure::Observation { line: observation.line, error })?;
        room.frames.clear();
        let Room { displaced, frames, transforms, .. } = room;
        frames.push(Frame::new(&station.pose, displaced[0].by(&room.base)));
        for i in 0..room.errors.len() {
            let before = frames[i].after.then(&transforms[i]);
            frames.push(Frame::new(&before, displaced[i + 1].by(&room.errors[i])));
        }
        let last = room.errors.len();
        let tool = frames[last].after.then(&transforms[last]);
        frames.push(Frame::new(&tool.then(&self.mounting), displaced[last + 1].by(&room.tool)));
        Ok(())
    }

    /// The pose of the tool as the instrument should see it; what was measured does not matter.
    pub fn pose(&self, room: &mut Room, observation: &Observation, x: &[f64]) -> Result<Pose, Failure> {
        self.chain(room, observation, x)?;
        Ok(room.frames[room.errors.len() + 1].after)
    }

    /// What each of the [readings](Self::readings) should be; what was measured does not matter.
    pub fn values(&self, room: &mut Room, observation: &Observation, x: &[f64]) -> Result<Vec<f64>, Failure> {
        self.chain(room, observation, x)?;
        Ok((0..self.readings.len()).map(|i| self.gradient(room, i).value).collect())
    }

    /// Room for the numbers of one configuration.
    pub fn room(&self) -> Room {
        let description = self.manipulator.description();
        let frames = description.frames.len();
        Room {
            transforms: vec![Pose::IDENTITY; frames + 1],
            errors: vec![[0.0; 6]; frames],
            effects: vec![0.0; description.effects.len()],
            frames: Vec::with_capacity(frames + 2),
            displaced: vec![Displaced::NOTHING; frames + 2],
            moves: Vec::new(),
            targets: self.targets.clone(),
            station: 0,
            fixtures: vec![[0.0; 3]; self.fixtures.len()],
            zeros: vec![0.0; self.readings.len()],
            base: [0.0; 6],
            tool: [0.0; 6],
        }
    }

    /// Model minus measurement at `x`, number by number: `row(residual, derivative of unknown k)`.
    ///
    /// In units of the uncertainty of the observation. Three for every target that was not hidden, position and rotation
    /// vector of a pose: six, or one for every reading.
    pub(super) fn residuals(
        &self,
        room: &mut Room,
        observation: &Observation,
        x: &[f64],
        row: impl FnMut(f64, &mut dyn FnMut(usize) -> f64),
    ) -> Result<(), Failure> {
        let weight = observation.weight.sqrt();
        self.differences(room, observation, x, weight, row)
    }

    /// Model minus measurement in units of the uncertainty, times a weight.
    fn differences(
        &self,
        room: &mut Room,
        observation: &Observation,
        x: &[f64],
        weight: f64,
        mut row: impl FnMut(f64, &mut dyn FnMut(usize) -> f64),
    ) -> Result<(), Failure> {
        self.chain(room, observation, x)?;
        let [length, angle] = [self.uncertainty.length, self.uncertainty.angle].map(|sigma| sigma / weight);
        let last = room.frames[room.errors.len() + 1].after;
        let mut moves = core::mem::take(&mut room.moves);
        match &observation.measured {
            Measurement::Points(points) => {
                for (j, measured) in points.iter().enumerate() {
                    let Some(measured) = measured else { continue };
                    let target = *room.targets.get(j).ok_or(Failure::Observation {
                        line: observation.line,
                        error: Error::Count {
                            quantity: Quantity::Pose,
                            expected: self.targets.len(),
                            found: points.len(),
                        },
                    })?;
                    let point = last.apply(target);
                    moves.clear();
                    for axis in 0..3 {
                        row((point[axis] - measured[axis]) / length, &mut |k| {
                            self.moves_of(room, j, point, &mut moves)[k][axis] / length
                        });
                    }
                }
            }
            Measurement::Pose(measured) => {
                let point = last.position();
                moves.clear();
                for axis in 0..3 {
                    row((point[axis] - measured.0[3][axis]) / length, &mut |k| {
                        self.moves_of(room, usize::MAX, point, &mut moves)[k][axis] / length
                    });
                }
                let mut difference = last.then(&measured.inverse());
                difference.0[3] = [0.0; 3];
                let turn = rotation_vector(&difference);
                for axis in 0..3 {
                    row(turn[axis] / angle, &mut |k| turned(turn, self.turn(room, k))[axis] / angle);
                }
            }
            Measurement::Readings(values) => {
                for (i, measured) in values.iter().enumerate().take(self.readings.len()) {
                    let Some(measured) = measured else { continue };
                    let sigma = self.readings[i].uncertainty / weight;
                    let gradient = self.gradient(room, i);
                    row((gradient.value - measured) / sigma, &mut |k| {
                        self.moves(room, i, &gradient, k) / sigma
                    });
                }
            }
        }
        room.moves = moves;
        Ok(())
    }

    /// How a point of target `j` moves with every unknown: its three coordinates share them.
    fn moves_of<'v>(
        &self,
        room: &Room,
        j: usize,
        point: [f64; 3],
        moves: &'v mut Vec<[f64; 3]>,
    ) -> &'v [[f64; 3]] {
        if moves.is_empty() {
            moves.extend((0..self.unknowns.len()).map(|k| self.point(room, k, j, point)));
        }
        moves
    }

    /// How a point of target `j` moves with unknown `k`.
    pub(super) fn point(&self, room: &Room, k: usize, j: usize, point: [f64; 3]) -> [f64; 3] {
        let last = room.errors.len() + 1;
        match self.unknowns[k] {
            Unknown::Base(station, component) if station == room.station => {
                room.frames[0].point(component, point)
            }
            Unknown::Error(frame, component) => room.frames[frame + 1].point(component, point),
            Unknown::Tool(component) => room.frames[last].point(component, point),
            Unknown::Target(target, axis) if target == j => room.frames[last].after.0[axis],
            Unknown::Base(..) | Unknown::Target(..) | Unknown::Fixture(..) | Unknown::Zero(_) => [0.0; 3],
            Unknown::Magnitude(source) => self.caused(room, source, |frame, c| frame.point(c, point)),
        }
    }

    pub(super) fn turn(&self, room: &Room, k: usize) -> [f64; 3] {
        match self.unknowns[k] {
            Unknown::Base(station, component) if station == room.station => room.frames[0].turn(component),
            Unknown::Error(frame, component) => room.frames[frame + 1].turn(component),
            Unknown::Tool(component) => room.frames[room.errors.len() + 1].turn(component),
            Unknown::Base(..) | Unknown::Target(..) | Unknown::Fixture(..) | Unknown::Zero(_) => [0.0; 3],
            Unknown::Magnitude(source) => self.caused(room, source, Frame::turn),
        }
    }

    fn caused(&self, room: &Room, source: usize, moves: impl Fn(&Frame, Component) -> [f64; 3]) -> [f64; 3] {
        let description = self.manipulator.description();
        let mut sum = [0.0; 3];
        for (effect, size) in description.effects.iter().zip(&room.effects) {
            if effect.source == source {
                let moved = moves(&room.frames[effect.frame + 1], effect.component);
                sum = core::array::from_fn(|i| sum[i] + size * moved[i]);
            }
        }
        sum
    }

    /// Measurement minus model at `x`, and how the model moves with every unknown: of each number, in units of the uncertainty.
    pub fn linearized(
        &self,
        room: &mut Room,
        observation: &Observation,
        x: &[f64],
    ) -> Result<Vec<(f64, Vec<f64>)>, Failure> {
        let mut numbers = Vec::new();
        self.residuals(room, observation, x, |residual, derivative| {
            numbers.push((-residual, (0..x.len()).map(derivative).collect()));
        })?;
        Ok(numbers)
    }

    /// Position errors, model minus measurement, one vector for every point that was measured, in the axes of the
    /// instrument. The length unit. Of a reading of a length, that along the direction in which it changes; angles have none.
    pub fn deviations(
        &self,
        room: &mut Room,
        observation: &Observation,
        x: &[f64],
    ) -> Result<Vec<[f64; 3]>, Failure> {
        if let Measurement::Readings(readings) = &observation.measured {
            let mut values = Vec::new();
            self.chain(room, observation, x)?;
            for (i, measured) in readings.iter().enumerate().take(self.readings.len()) {
                let Some(measured) = measured.filter(|_| !self.readings[i].gauge.is_angle()) else {
                    continue;
                };
                let Gradient { value, along, .. } = self.gradient(room, i);
                values.push(along.map(|axis| (value - measured) * axis));
            }
            return Ok(values);
        }
        let Uncertainty { length, .. } = self.uncertainty;
        let mut values = Vec::new();
        self.differences(room, observation, x, 1.0, |residual, _| {
            values.push(residual * length);
        })?;
        if matches!(observation.measured, Measurement::Pose(_)) {
            values.truncate(3);
        }
        Ok(values.chunks_exact(3).map(|v| [v[0], v[1], v[2]]).collect())
    }

    /// The norms of the [deviations](Self::deviations).
    pub fn distances(
        &self,
        room: &mut Room,
        observation: &Observation,
        x: &[f64],
    ) -> Result<Vec<f64>, Failure> {
        Ok(self.deviations(room, observation, x)?.into_iter().map(sampling::norm).collect())
    }

    /// Figures of the norms of the position errors of all observations at `x`. The length unit.
    pub fn figures<'o>(
        &self,
        observations: impl IntoIterator<Item = &'o Observation>,
        x: &[f64],
    ) -> Result<Figures, Failure> {
        Ok(self.all_distances(observations, x)?.figures())
    }

    /// The norms of the position errors of all observations at `x`. The length unit.
    pub fn all_distances<'o>(
        &self,
        observations: impl IntoIterator<Item = &'o Observation>,
        x: &[f64],
    ) -> Result<Distances, Failure> {
        let mut room = self.room();
        let mut norms = Vec::new();
        for observation in observations {
            let distances = self.distances(&mut room, observation, x)?;
            norms.extend(distances.into_iter().map(|distance| (observation.configuration, distance)));
        }
        Ok(Distances(norms))
    }

    /// The pose of the tool, and how its point moves per unit of every unknown.
    pub fn tool(
        &self,
        room: &mut Room,
        observation: &Observation,
        x: &[f64],
    ) -> Result<(Pose, Vec<[f64; 3]>), Failure> {
        let pose = self.pose(room, observation, x)?;
        let moves = (0..self.unknowns.len()).map(|k| self.point(room, k, usize::MAX, pose.position()));
        Ok((pose, moves.collect()))
    }
}
