//! State of the chain at one configuration: poses of all frames, errors, targets, fixtures and
//! zeros.

use super::columns::{Displaced, Frame};
use super::{Camera, Failure, Model, Observation, Result, Role, Unknown};
use abbe_analysis::sampling::vectors::cross;
use abbe_core::{Component, Error, Pose, Quantity, drawn_pose, tool_pose, twist};

/// Model at values of its unknowns, with reusable memory for the evaluation of configurations.
#[derive(Clone)]
pub struct EvaluatedModel<'m> {
    pub(super) model: &'m Model<'m>,
    /// Values of the unknowns; those that are left out are zero.
    pub(super) x: Vec<f64>,
    transforms: Vec<Pose>,
    pub(super) errors: Vec<[f64; 6]>,
    /// Errors by the known sources, to first order.
    known: Vec<[f64; 6]>,
    /// Magnitudes of the known sources alone.
    known_magnitudes: Vec<f64>,
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
    pub(super) previous: Option<Box<Self>>,
}

/// Sum of the rotations by known sources, in rad, below which terms of second order do not matter:
/// they are less than a tenth of a micrometre per metre.
const SMALL: f64 = 4e-4;

/// Returns the magnitude of a source if it is known.
fn known(role: &Role) -> f64 {
    f64::from(u8::from(*role == Role::Known))
}

impl Model<'_> {
    /// Returns the model at values of its unknowns.
    pub fn at(&self, x: &[f64]) -> EvaluatedModel<'_> {
        let description = self.manipulator.description();
        let frames = description.frames.len();
        EvaluatedModel {
            model: self,
            x: x.to_vec(),
            transforms: vec![Pose::IDENTITY; frames + 1],
            errors: vec![[0.0; 6]; frames],
            known: vec![[0.0; 6]; frames],
            known_magnitudes: self.roles.iter().map(known).collect(),
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
}

impl EvaluatedModel<'_> {
    /// Returns the pose of `F_0` in the frame of the instrument.
    pub(super) fn base_pose(&self) -> Pose {
        self.frames[0].after
    }

    /// Returns the pose of the tool in the frame of the instrument.
    pub(super) fn tool_pose(&self) -> Pose {
        self.frames[self.errors.len() + 1].after
    }

    /// Returns the derivative of a point of the tool with respect to an error of a frame.
    pub(super) fn point_by_error(&self, frame: usize, component: Component, point: [f64; 3]) -> [f64; 3] {
        let Some([x, y, z, turn @ ..]) = self.closed.get(6 * frame + component.index()) else {
            return self.frames[frame + 1].point(component, point);
        };
        let origin = self.frames[self.errors.len()].after.position();
        let swing = cross(*turn, core::array::from_fn(|i| point[i] - origin[i]));
        core::array::from_fn(|i| [x, y, z][i] + swing[i])
    }

    /// Returns the rotation vector of the tool per unit of an error of a frame.
    pub(super) fn turn_by_error(&self, frame: usize, component: Component) -> [f64; 3] {
        match self.closed.get(6 * frame + component.index()) {
            Some([.., a, b, c]) => [*a, *b, *c],
            None => self.frames[frame + 1].turn(component),
        }
    }

    /// Sums the errors of base, frames and tool at one configuration.
    fn errors(&mut self, observation: &Observation) -> Result<(), Error> {
        let model = self.model;
        self.errors.fill([0.0; 6]);
        self.tool = [0.0; 6];
        self.base = [0.0; 6];
        self.station = observation.station as usize;
        self.placement = model.stations[self.station].placement;
        self.first_target = model.targets_of(self.placement).start;
        self.targets.copy_from_slice(&model.targets);
        self.fixtures.fill([0.0; 3]);
        self.camera = model.camera;
        for (zero, reading) in self.zeros.iter_mut().zip(&model.observables) {
            *zero = reading.zero;
        }
        self.magnitudes.copy_from_slice(&self.known_magnitudes);
        let description = model.manipulator.description();
        if model.roles.iter().any(|role| *role != Role::Off) {
            model.manipulator.effects(&observation.q, &model.s, &observation.u, &mut self.effects)?;
            for (effect, value) in description.effects.iter().zip(&self.effects) {
                if model.roles[effect.source] == Role::Known {
                    self.errors[effect.frame][effect.component.index()] += value;
                }
            }
        }
        self.known.copy_from_slice(&self.errors);
        for (unknown, value) in model.unknowns.iter().zip(&self.x) {
            match *unknown {
                Unknown::Base(station, component) if station == self.station => {
                    self.base[component.index()] += value;
                }
                Unknown::Base(..) => {}
                Unknown::Error(frame, component) => self.errors[frame][component.index()] += value,
                Unknown::Tool(placement, component) if placement == self.placement => {
                    self.tool[component.index()] += value;
                }
                Unknown::Tool(..) => {}
                Unknown::Target(target, axis) => self.targets[target][axis] += value,
                Unknown::Fixture(fixture, coordinate) => self.fixtures[fixture][coordinate] += value,
                Unknown::Zero(reading) => self.zeros[reading] += value,
                Unknown::Intrinsic(parameter) => {
                    if let Some(camera) = &mut self.camera {
                        camera.intrinsics[parameter] += value;
                    }
                }
                Unknown::Magnitude(source) => {
                    self.magnitudes[source] += value;
                    for (effect, size) in description.effects.iter().zip(&self.effects) {
                        if effect.source == source {
                            self.errors[effect.frame][effect.component.index()] += value * size;
                        }
                    }
                }
            }
        }
        Ok(())
    }

    /// Computes the poses of all frames at an observation, and those of the previous row if needed.
    pub(super) fn chain(&mut self, observation: &Observation) -> Result<()> {
        let model = self.model;
        let station = model.stations.get(observation.station as usize).ok_or(Failure::Observation {
            line: observation.line,
            error: Error::Count {
                quantity: Quantity::Pose,
                expected: model.stations.len(),
                found: observation.station as usize + 1,
            },
        })?;
        self.frames.clear();
        let has_loops = model.manipulator.description().has_loops();
        let tool = self
            .errors(observation)
            .and_then(|()| {
                self.frames.push(Frame::new(&station.pose, self.displaced[0].by(&self.base)));
                if has_loops { self.close(observation) } else { self.branches(observation) }
            })
            .map_err(|error| Failure::Observation { line: observation.line, error })?;
        let mounted = tool.then(&model.mountings[self.placement]);
        let Self { displaced, frames, errors, .. } = self;
        frames.push(Frame::new(&mounted, displaced[errors.len() + 1].by(&self.tool)));
        if let Some(from) = observation.from() {
            let mut previous = self.previous.take().unwrap_or_else(|| Box::new(model.at(&self.x)));
            previous.x.clone_from(&self.x);
            previous.chain(from)?;
            self.previous = Some(previous);
        } else {
            self.previous = None;
        }
        Ok(())
    }

    /// Appends the frames, each behind the one that it hangs on, and returns the pose of the tool
    /// without its mounting.
    fn branches(&mut self, observation: &Observation) -> Result<Pose, Error> {
        let Self { model, displaced, frames, transforms, errors, known, known_magnitudes, .. } = self;
        let description = model.manipulator.description();
        model.manipulator.transforms(&observation.q, &model.s, transforms)?;
        for (i, errors) in errors.iter().enumerate() {
            let parent = description.parent(i).map_or(0, |parent| parent + 1);
            let before = frames[parent].after.then(&transforms[i]);
            let frame = Frame::new(&before, displaced[i + 1].by(errors));
            frames.push(if description.carries_tool(i) { frame } else { Frame::at_rest(frame.after) });
        }
        let carrier = description.tool_frame().map_or(0, |frame| frame + 1);
        let tool = frames[carrier].after.then(&transforms[errors.len()]);
        let turns = known.iter().flat_map(|[_, _, _, turns @ ..]| turns).map(|turn| turn.abs()).sum::<f64>();
        if turns < SMALL {
            return Ok(tool);
        }
        // Effects of sources are errors of frames to first order only. What is known moves the tool
        // exactly, as the sources themselves do.
        let Observation { q, u, .. } = observation;
        let exact = drawn_pose(model.manipulator, q, &model.s, u, known_magnitudes)?;
        let first_order = tool_pose(description, transforms, known);
        let base = frames[0].after;
        Ok(base.then(&exact).then(&first_order.inverse()).then(&base.inverse()).then(&tool))
    }

    /// Closes the loops, and returns the pose of the tool without its mounting. The derivatives are
    /// J_e, those at ε = 0: errors change them in proportion to their size, so that steps converge
    /// linearly. Where all errors are those of sources, the pose is that of the sources themselves,
    /// such as a leg of another length.
    fn close(&mut self, observation: &Observation) -> Result<Pose, Error> {
        let Self { model, frames, errors, closed, magnitudes, .. } = self;
        let (description, base) = (model.manipulator.description(), frames[0].after);
        closed.resize(6 * errors.len(), [0.0; 6]);
        let nominal = model.manipulator.error_jacobian(&observation.q, &model.s, closed)?;
        for column in closed {
            let [x, y, z, turn @ ..] = twist(description.orientation, &nominal, column);
            let ([x, y, z], [a, b, c]) = (base.turn([x, y, z]), base.turn(turn));
            *column = [x, y, z, a, b, c];
        }
        let has_own_errors = model.unknowns.iter().any(|unknown| matches!(unknown, Unknown::Error(..)));
        let real = match has_own_errors {
            true => model.manipulator.displaced_pose(&observation.q, &model.s, errors)?,
            false => drawn_pose(model.manipulator, &observation.q, &model.s, &observation.u, magnitudes)?,
        };
        let tool = base.then(&real);
        frames.extend(errors.iter().map(|_| Frame::at_rest(tool)));
        Ok(tool)
    }

    /// Returns the pose of the tool in the frame of the instrument; ignores the measurement.
    pub fn pose(&mut self, observation: &Observation) -> Result<Pose> {
        self.chain(observation)?;
        Ok(self.tool_pose())
    }
}
