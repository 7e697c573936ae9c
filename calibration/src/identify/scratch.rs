//! State of the chain at one configuration: poses of all frames, errors, targets, fixtures and
//! zeros.

use super::columns::{Displaced, Frame};
use super::{Camera, Failure, Model, Observation, Role, Unknown};
use abbe_core::{Error, Pose, Quantity};

/// Reusable memory for the evaluation of one configuration.
#[derive(Clone, Debug)]
pub struct Scratch {
    transforms: Vec<Pose>,
    pub(super) errors: Vec<[f64; 6]>,
    pub(super) effects: Vec<f64>,
    pub(super) frames: Vec<Frame>,
    /// Displacements by the errors of base, frames and tool.
    displaced: Vec<Displaced>,
    /// Derivatives of three numbers with respect to each unknown.
    pub(super) lines: [Vec<f64>; 3],
    pub(super) targets: Vec<[f64; 3]>,
    pub(super) fixtures: Vec<[f64; 3]>,
    pub(super) zeros: Vec<f64>,
    /// Camera with its current intrinsic parameters.
    pub(super) camera: Option<Camera>,
    pub(super) station: usize,
    /// Index of the placement on the tool.
    pub(super) placement: usize,
    /// Index of the first target of that placement.
    pub(super) first_target: usize,
    base: [f64; 6],
    tool: [f64; 6],
    /// State in the previous row, for observables that refer to it.
    pub(super) previous: Option<Box<Scratch>>,
}

impl Scratch {
    /// Returns the pose of `F_0` in the frame of the instrument.
    pub(super) fn base(&self) -> Pose {
        self.frames[0].after
    }

    /// Returns the pose of the tool in the frame of the instrument.
    pub(super) fn tool(&self) -> Pose {
        self.frames[self.errors.len() + 1].after
    }
}

impl Model<'_> {
    /// Allocates memory for the evaluation of configurations.
    pub fn scratch(&self) -> Scratch {
        let description = self.manipulator.description();
        let frames = description.frames.len();
        Scratch {
            transforms: vec![Pose::IDENTITY; frames + 1],
            errors: vec![[0.0; 6]; frames],
            effects: vec![0.0; description.effects.len()],
            frames: Vec::with_capacity(frames + 2),
            displaced: vec![Displaced::NOTHING; frames + 2],
            lines: Default::default(),
            targets: self.targets.clone(),
            station: 0,
            placement: 0,
            first_target: 0,
            fixtures: vec![[0.0; 3]; self.fixtures.len()],
            zeros: vec![0.0; self.observables.len()],
            camera: self.camera,
            base: [0.0; 6],
            tool: [0.0; 6],
            previous: None,
        }
    }

    /// Sums the errors of base, frames and tool at one configuration.
    fn errors(&self, scratch: &mut Scratch, observation: &Observation, x: &[f64]) -> Result<(), Error> {
        scratch.errors.fill([0.0; 6]);
        scratch.tool = [0.0; 6];
        scratch.base = [0.0; 6];
        scratch.station = observation.station as usize;
        scratch.placement = self.stations[scratch.station].placement;
        scratch.first_target = self.targets_of(scratch.placement).start;
        scratch.targets.copy_from_slice(&self.targets);
        scratch.fixtures.fill([0.0; 3]);
        scratch.camera = self.camera;
        for (zero, reading) in scratch.zeros.iter_mut().zip(&self.observables) {
            *zero = reading.zero;
        }
        let description = self.manipulator.description();
        if self.roles.iter().any(|role| *role != Role::Off) {
            self.manipulator.effects(&observation.q, &self.s, &observation.u, &mut scratch.effects)?;
            for (effect, value) in description.effects.iter().zip(&scratch.effects) {
                if self.roles[effect.source] == Role::Known {
                    scratch.errors[effect.frame][effect.component.index()] += value;
                }
            }
        }
        for (unknown, value) in self.unknowns.iter().zip(x) {
            match *unknown {
                Unknown::Base(station, component) if station == scratch.station => {
                    scratch.base[component.index()] += value;
                }
                Unknown::Base(..) => {}
                Unknown::Error(frame, component) => scratch.errors[frame][component.index()] += value,
                Unknown::Tool(placement, component) if placement == scratch.placement => {
                    scratch.tool[component.index()] += value;
                }
                Unknown::Tool(..) => {}
                Unknown::Target(target, axis) => scratch.targets[target][axis] += value,
                Unknown::Fixture(fixture, coordinate) => scratch.fixtures[fixture][coordinate] += value,
                Unknown::Zero(reading) => scratch.zeros[reading] += value,
                Unknown::Intrinsic(parameter) => {
                    if let Some(camera) = &mut scratch.camera {
                        camera.intrinsics[parameter] += value;
                    }
                }
                Unknown::Magnitude(source) => {
                    for (effect, size) in description.effects.iter().zip(&scratch.effects) {
                        if effect.source == source {
                            scratch.errors[effect.frame][effect.component.index()] += value * size;
                        }
                    }
                }
            }
        }
        Ok(())
    }

    /// Computes the poses of all frames at an observation, and those of the previous row if needed.
    pub(super) fn chain(
        &self,
        scratch: &mut Scratch,
        observation: &Observation,
        x: &[f64],
    ) -> Result<(), Failure> {
        let station = self.stations.get(observation.station as usize).ok_or(Failure::Observation {
            line: observation.line,
            error: Error::Count {
                quantity: Quantity::Pose,
                expected: self.stations.len(),
                found: observation.station as usize + 1,
            },
        })?;
        self.errors(scratch, observation, x)
            .and_then(|()| self.manipulator.transforms(&observation.q, &self.s, &mut scratch.transforms))
            .map_err(|error| Failure::Observation { line: observation.line, error })?;
        scratch.frames.clear();
        let Scratch { displaced, frames, transforms, .. } = scratch;
        frames.push(Frame::new(&station.pose, displaced[0].by(&scratch.base)));
        for i in 0..scratch.errors.len() {
            let before = frames[i].after.then(&transforms[i]);
            frames.push(Frame::new(&before, displaced[i + 1].by(&scratch.errors[i])));
        }
        let last = scratch.errors.len();
        let tool = frames[last].after.then(&transforms[last]);
        let mounted = tool.then(&self.mountings[scratch.placement]);
        frames.push(Frame::new(&mounted, displaced[last + 1].by(&scratch.tool)));
        if let Some(from) = observation.from() {
            let mut previous = scratch.previous.take().unwrap_or_else(|| Box::new(self.scratch()));
            self.chain(&mut previous, from, x)?;
            scratch.previous = Some(previous);
        } else {
            scratch.previous = None;
        }
        Ok(())
    }

    /// Returns the pose of the tool in the frame of the instrument; ignores the measurement.
    pub fn pose(&self, scratch: &mut Scratch, observation: &Observation, x: &[f64]) -> Result<Pose, Failure> {
        self.chain(scratch, observation, x)?;
        Ok(scratch.tool())
    }
}
