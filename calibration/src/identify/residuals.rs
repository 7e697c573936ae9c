//! Model minus measurement, and how it moves with every unknown.

use core::borrow::Borrow;

use super::columns::{Displaced, Frame, turned};
use super::gradient::Gradient;
use super::linearize::by_blocks;
use super::{Distances, Failure, Figures, Measurement, Model, Observation, Role, Unknown};
use abbe_analysis::sampling;
use abbe_core::rotation_vector;
use abbe_core::{Component, Error, Pose, Quantity};

/// Room for the numbers of one configuration, made once and used for many.
#[derive(Clone, Debug)]
pub struct Room {
    transforms: Vec<Pose>,
    pub(super) errors: Vec<[f64; 6]>,
    effects: Vec<f64>,
    pub(super) frames: Vec<Frame>,
    /// What the errors of base, frames and tool do.
    displaced: Vec<Displaced>,
    /// The derivatives of three numbers by every unknown.
    lines: [Vec<f64>; 3],
    pub(super) targets: Vec<[f64; 3]>,
    pub(super) fixtures: Vec<[f64; 3]>,
    pub(super) zeros: Vec<f64>,
    station: usize,
    base: [f64; 6],
    tool: [f64; 6],
    /// The same where the machine was before, if it matters.
    pub(super) start: Option<Box<Room>>,
}

impl Model<'_> {
    /// ε and the tool, at one configuration.
    fn errors(&self, room: &mut Room, observation: &Observation, x: &[f64]) -> Result<(), Error> {
        room.errors.fill([0.0; 6]);
        room.tool = [0.0; 6];
        room.base = [0.0; 6];
        room.station = observation.station as usize;
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
                Unknown::Base(station, component) if station == room.station => {
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
        let station = self.stations.get(observation.station as usize).ok_or(Failure::Observation {
            line: observation.line,
            error: Error::Count {
                quantity: Quantity::Pose,
                expected: self.stations.len(),
                found: observation.station as usize + 1,
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
        if let Some(from) = observation.from() {
            let mut start = room.start.take().unwrap_or_else(|| Box::new(self.room()));
            self.chain(&mut start, from, x)?;
            room.start = Some(start);
        } else {
            room.start = None;
        }
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
            lines: Default::default(),
            targets: self.targets.clone(),
            station: 0,
            fixtures: vec![[0.0; 3]; self.fixtures.len()],
            zeros: vec![0.0; self.readings.len()],
            base: [0.0; 6],
            tool: [0.0; 6],
            start: None,
        }
    }

    /// Model minus measurement at `x`, number by number, in units of the uncertainty of the observation.
    ///
    /// Three for every target that was not hidden, position and rotation vector of a pose: six, or one for every reading.
    pub(super) fn residuals(
        &self,
        room: &mut Room,
        observation: &Observation,
        x: &[f64],
        mut take: impl FnMut(f64),
    ) -> Result<(), Failure> {
        self.numbers::<false>(room, observation, x, |residual, _| take(residual))
    }

    /// The same, each with its derivatives by all unknowns.
    pub(super) fn linear(
        &self,
        room: &mut Room,
        observation: &Observation,
        x: &[f64],
        row: impl FnMut(f64, &[f64]),
    ) -> Result<(), Failure> {
        self.numbers::<true>(room, observation, x, row)
    }

    /// `row(residual, derivatives)`; no derivatives unless they are asked for.
    fn numbers<const DERIVED: bool>(
        &self,
        room: &mut Room,
        observation: &Observation,
        x: &[f64],
        mut row: impl FnMut(f64, &[f64]),
    ) -> Result<(), Failure> {
        self.chain(room, observation, x)?;
        let weight = observation.weight.sqrt();
        let [length, angle] = [self.uncertainty.length, self.uncertainty.angle].map(|sigma| weight / sigma);
        let last = room.frames[room.errors.len() + 1].after;
        let mut lines = core::mem::take(&mut room.lines);
        let derived = if DERIVED { self.unknowns.len() } else { 0 };
        match &observation.measured {
            Measurement::Points(points) => {
                for (j, measured) in points.iter().enumerate() {
                    let Some(measured) = measured else { continue };
                    let point = last.apply(self.target(room, observation, j)?);
                    fill(&mut lines, derived, |k| self.point(room, k, j, point).map(|moved| moved * length));
                    for axis in 0..3 {
                        row((point[axis] - measured[axis]) * length, &lines[axis]);
                    }
                }
            }
            Measurement::Pose(measured) => {
                let point = last.position();
                let place = |k| self.point(room, k, usize::MAX, point).map(|moved| moved * length);
                fill(&mut lines, derived, place);
                for axis in 0..3 {
                    row((point[axis] - measured.0[3][axis]) * length, &lines[axis]);
                }
                let mut difference = last.then(&measured.inverse());
                difference.0[3] = [0.0; 3];
                let turn = rotation_vector(&difference);
                fill(&mut lines, derived, |k| turned(turn, self.turn(room, k)).map(|turned| turned * angle));
                for axis in 0..3 {
                    row(turn[axis] * angle, &lines[axis]);
                }
            }
            Measurement::Readings(values) => {
                for (i, measured) in values.iter().enumerate().take(self.readings.len()) {
                    let Some(measured) = measured else { continue };
                    let unit = weight / self.readings[i].uncertainty;
                    let gradient = self.gradient(room, i);
                    fill(&mut lines, derived, |k| [self.moves(room, i, &gradient, k) * unit, 0.0, 0.0]);
                    row((gradient.value - measured) * unit, &lines[0]);
                }
            }
        }
        room.lines = lines;
        Ok(())
    }

    /// Where target `j` is in the frame of the tool, the chain of `room` being where it is.
    fn target(&self, room: &Room, observation: &Observation, j: usize) -> Result<[f64; 3], Failure> {
        let found = || match &observation.measured {
            Measurement::Points(points) => points.len(),
            _ => 0,
        };
        room.targets.get(j).copied().ok_or_else(|| Failure::Observation {
            line: observation.line,
            error: Error::Count { quantity: Quantity::Pose, expected: self.targets.len(), found: found() },
        })
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
        self.linear(room, observation, x, |residual, row| numbers.push((-residual, row.to_vec())))?;
        Ok(numbers)
    }

    /// The same numbers without how they move.
    pub fn differences(
        &self,
        room: &mut Room,
        observation: &Observation,
        x: &[f64],
    ) -> Result<Vec<f64>, Failure> {
        let mut numbers = Vec::new();
        self.residuals(room, observation, x, |residual| numbers.push(-residual))?;
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
        let mut values = Vec::new();
        self.each_deviation(room, observation, x, |deviation| values.push(deviation))?;
        Ok(values)
    }

    /// The same, one after the other.
    pub(super) fn each_deviation(
        &self,
        room: &mut Room,
        observation: &Observation,
        x: &[f64],
        mut take: impl FnMut([f64; 3]),
    ) -> Result<(), Failure> {
        self.chain(room, observation, x)?;
        let last = room.frames[room.errors.len() + 1].after;
        let difference = |a: [f64; 3], b: &[f64; 3]| core::array::from_fn(|i| a[i] - b[i]);
        match &observation.measured {
            Measurement::Points(points) => {
                for (j, measured) in points.iter().enumerate() {
                    let Some(measured) = measured else { continue };
                    take(difference(last.apply(self.target(room, observation, j)?), measured));
                }
            }
            Measurement::Pose(measured) => take(difference(last.position(), &measured.position())),
            Measurement::Readings(readings) => {
                for (i, measured) in readings.iter().enumerate().take(self.readings.len()) {
                    let Some(measured) = measured.filter(|_| !self.readings[i].gauge.is_angle()) else {
                        continue;
                    };
                    let Gradient { value, along, .. } = self.gradient(room, i);
                    take(along.map(|axis| (value - measured) * axis));
                }
            }
        }
        Ok(())
    }

    /// Whether a row has any [deviations](Self::deviations).
    pub(super) fn tells_place(&self, observation: &Observation) -> bool {
        match &observation.measured {
            Measurement::Points(points) => points.iter().any(Option::is_some),
            Measurement::Pose(_) => true,
            Measurement::Readings(values) => {
                let mut values = values.iter().zip(&self.readings);
                values.any(|(value, reading)| value.is_some() && !reading.gauge.is_angle())
            }
        }
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
    pub fn figures<R: Borrow<Observation> + Sync>(&self, rows: &[R], x: &[f64]) -> Result<Figures, Failure> {
        Ok(self.all_distances(rows, x)?.into_figures())
    }

    /// The norms of the position errors of all observations at `x`. The length unit.
    pub fn all_distances<R: Borrow<Observation> + Sync>(
        &self,
        rows: &[R],
        x: &[f64],
    ) -> Result<Distances, Failure> {
        self.distances_of(rows, |_| Some(x))
    }

    /// The norms of the position errors of those rows that `x` has unknowns for, by number of the row.
    pub fn distances_of<'x, R: Borrow<Observation> + Sync>(
        &self,
        rows: &[R],
        x: impl Fn(usize) -> Option<&'x [f64]> + Sync,
    ) -> Result<Distances, Failure> {
        let block = |first: usize, rows: &[R]| {
            let mut room = self.room();
            let mut norms = Vec::with_capacity(rows.len());
            for (i, row) in rows.iter().enumerate() {
                let Some(x) = x(first + i) else { continue };
                let row = row.borrow();
                let norm = |deviation| norms.push((row.configuration, sampling::norm(deviation)));
                self.each_deviation(&mut room, row, x, norm)?;
            }
            Ok(norms)
        };
        let mut distances = Distances::default();
        by_blocks(rows, block, |part| distances.extend(part))?;
        Ok(distances)
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

/// Three numbers of each of `count` unknowns, by number.
#[inline]
fn fill(lines: &mut [Vec<f64>; 3], count: usize, three: impl Fn(usize) -> [f64; 3]) {
    lines.iter_mut().for_each(|line| line.resize(count, 0.0));
    let [a, b, c] = lines;
    for (k, ((a, b), c)) in a.iter_mut().zip(b).zip(c).enumerate() {
        [*a, *b, *c] = three(k);
    }
}
