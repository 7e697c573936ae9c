//! State of the chain at one configuration: poses of all frames, errors, targets, fixtures and
//! zeros.

use super::columns::{Displaced, Frame};
use super::vectors::cross;
use super::{Camera, Failure, Model, Observation, Role, Unknown};
use abbe_core::{Component, Error, Pose, Quantity, drawn_pose, twist};

/// Reusable memory for the evaluation of one configuration.
#[derive(Clone, Debug)]
pub struct Scratch {
    transforms: Vec<Pose>,
    pub(super) errors: Vec<[f64; 6]>,
    pub(super) effects: Vec<f64>,
    /// Factor of each source, for machines with loops.
    magnitudes: Vec<f64>,
    pub(super) frames: Vec<Frame>,
    /// Columns of J_e as twists of the tool point, in the axes of the instrument. Empty without
    /// loops: the frames then have them.
    closed: Vec<[f64; 6]>,
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

    /// Returns the derivative of a point of the tool with respect to an error of a frame.
    pub(super) fn point(&self, frame: usize, component: Component, point: [f64; 3]) -> [f64; 3] {
        let Some([x, y, z, turn @ ..]) = self.closed.get(6 * frame + component.index()) else {
            return self.frames[frame + 1].point(component, point);
        };
        let origin = self.frames[self.errors.len()].after.position();
        let swing = cross(*turn, core::array::from_fn(|i| point[i] - origin[i]));
        core::array::from_fn(|i| [x, y, z][i] + swing[i])
    }

    /// Returns the rotation vector of the tool per unit of an error of a frame.
    pub(super) fn turn(&self, frame: usize, component: Component) -> [f64; 3] {
        match self.closed.get(6 * frame + component.index()) {
            Some([.., a, b, c]) => [*a, *b, *c],
            None => self.frames[frame + 1].turn(component),
        }
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
            magnitudes: vec![0.0; description.sources.len()],
            frames: Vec::with_capacity(frames + 2),
            closed: Vec::new(),
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
        let known = |role: &Role| f64::from(u8::from(*role == Role::Known));
        scratch.magnitudes.iter_mut().zip(&self.roles).for_each(|(one, role)| *one = known(role));
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
                    scratch.magnitudes[source] += value;
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
        scratch.frames.clear();
        let has_loops = self.manipulator.description().has_loops();
        let tool = self
            .errors(scratch, observation, x)
            .and_then(|()| {
                let base = Frame::new(&station.pose, scratch.displaced[0].by(&scratch.base));
                scratch.frames.push(base);
                if has_loops { self.close(scratch, observation) } else { self.branches(scratch, observation) }
            })
            .map_err(|error| Failure::Observation { line: observation.line, error })?;
        let mounted = tool.then(&self.mountings[scratch.placement]);
        let Scratch { displaced, frames, errors, .. } = scratch;
        frames.push(Frame::new(&mounted, displaced[errors.len() + 1].by(&scratch.tool)));
        if let Some(from) = observation.from() {
            let mut previous = scratch.previous.take().unwrap_or_else(|| Box::new(self.scratch()));
            self.chain(&mut previous, from, x)?;
            scratch.previous = Some(previous);
        } else {
            scratch.previous = None;
        }
        Ok(())
    }

    /// Appends the frames, each behind the one that it hangs on, and returns the pose of the tool
    /// without its mounting.
    fn branches(&self, scratch: &mut Scratch, observation: &Observation) -> Result<Pose, Error> {
        let Scratch { displaced, frames, transforms, errors, .. } = scratch;
        let description = self.manipulator.description();
        self.manipulator.transforms(&observation.q, &self.s, transforms)?;
        for (i, errors) in errors.iter().enumerate() {
            let parent = description.parent(i).map_or(0, |parent| parent + 1);
            let before = frames[parent].after.then(&transforms[i]);
            let frame = Frame::new(&before, displaced[i + 1].by(errors));
            frames.push(if description.carries_tool(i) { frame } else { Frame::at_rest(frame.after) });
        }
        let carrier = description.tool_frame().map_or(0, |frame| frame + 1);
        Ok(frames[carrier].after.then(&transforms[errors.len()]))
    }

    /// Closes the loops, and returns the pose of the tool without its mounting. The derivatives are
    /// J_e, those at ε = 0: errors change them in proportion to their size, so that steps converge
    /// linearly. Where all errors are those of sources, the pose is that of the sources themselves,
    /// such as a leg of another length.
    fn close(&self, scratch: &mut Scratch, observation: &Observation) -> Result<Pose, Error> {
        let Scratch { frames, errors, closed, magnitudes, .. } = scratch;
        let (description, base) = (self.manipulator.description(), frames[0].after);
        closed.resize(6 * errors.len(), [0.0; 6]);
        let nominal = self.manipulator.error_jacobian(&observation.q, &self.s, closed)?;
        for column in closed {
            let [x, y, z, turn @ ..] = twist(description.orientation, &nominal, column);
            let ([x, y, z], [a, b, c]) = (base.turn([x, y, z]), base.turn(turn));
            *column = [x, y, z, a, b, c];
        }
        let has_own_errors = self.unknowns.iter().any(|unknown| matches!(unknown, Unknown::Error(..)));
        let real = match has_own_errors {
            true => self.manipulator.displaced_pose(&observation.q, &self.s, errors)?,
            false => drawn_pose(self.manipulator, &observation.q, &self.s, &observation.u, magnitudes)?,
        };
        let tool = base.then(&real);
        frames.extend(errors.iter().map(|_| Frame::at_rest(tool)));
        Ok(tool)
    }

    /// Returns the pose of the tool in the frame of the instrument; ignores the measurement.
    pub fn pose(&self, scratch: &mut Scratch, observation: &Observation, x: &[f64]) -> Result<Pose, Failure> {
        self.chain(scratch, observation, x)?;
        Ok(scratch.tool())
    }
}
