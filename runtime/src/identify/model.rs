//! The real machine with unknown errors: residuals of measurements, and their exact derivatives.
//!
//! `B E_0 · A_1 E_1 … A_n E_n · T E_T`: `B` is where `F_0` stands as the instrument sees it, `E_0` what is unknown of
//! that, `E_T` what is unknown of the tool where whole poses are measured; where points are, a target is at `d_j` in
//! the frame of the tool. ε is the sum of the sources that are known, of the unknown constants, and of the sources
//! whose magnitude is unknown.

use super::columns::{Frame, turned};
use super::{Observation, Seen, Uncertainty};
use crate::analysis::sampling;
use crate::chain::rotation_vector;
use crate::{Class, Component, Error, Manipulator, Pose, Quantity};

/// A number that measurements are to tell.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Unknown {
    /// An error of the base: of a frame `E_0` at `F_0`.
    Base(Component),
    /// A constant generalized error of a frame, from 0.
    Error(usize, Component),
    /// How large a repeatable source is, 1 = as the spec has it.
    Magnitude(usize),
    /// A coordinate (0, 1, 2) of a target in the frame of the tool, less what the model says.
    Target(usize, usize),
    /// An error of the tool: where whole poses are measured.
    Tool(Component),
}

/// What part a source has in a model.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Role {
    /// It is there as the spec has it.
    Known,
    /// Its magnitude is among the unknowns.
    Unknown,
    /// It is left out.
    Off,
}

/// A manipulator with unknown errors, seen by an instrument.
#[derive(Clone)]
pub struct Model<'a> {
    /// The nominal manipulator, with all its sources.
    pub manipulator: &'a dyn Manipulator,
    /// `B`: from `F_0` to the frame of the instrument, before any unknown.
    pub base: Pose,
    /// The targets in the frame of the tool; a single one at zero is the tool point itself.
    pub targets: Vec<[f64; 3]>,
    /// What the instrument's numbers are worth.
    pub uncertainty: Uncertainty,
    /// The unknowns, in order.
    pub unknowns: Vec<Unknown>,
    /// The part of every source of the description; random ones have none.
    pub roles: Vec<Role>,
    /// The structural parameters.
    pub s: Vec<f64>,
}

impl<'a> Model<'a> {
    /// Nothing unknown: the ideal chain, equation (2), without any source.
    pub fn ideal(manipulator: &'a dyn Manipulator, targets: Vec<[f64; 3]>, uncertainty: Uncertainty) -> Self {
        let description = manipulator.description();
        Self {
            manipulator,
            base: Pose::IDENTITY,
            targets,
            uncertainty,
            unknowns: Vec::new(),
            roles: vec![Role::Off; description.sources.len()],
            s: sampling::nominal_parameters(description),
        }
    }

    /// The same with these unknowns.
    pub fn with(&self, unknowns: Vec<Unknown>) -> Self {
        let mut roles = self.roles.clone();
        roles.iter_mut().filter(|role| **role == Role::Unknown).for_each(|role| *role = Role::Off);
        for unknown in &unknowns {
            if let Unknown::Magnitude(source) = unknown {
                roles[*source] = Role::Unknown;
            }
        }
        Self { unknowns, roles, ..self.clone() }
    }

    /// The same without those sources that are there as the spec has them.
    pub(super) fn without_known_sources(&self) -> Self {
        let off = |role: &Role| if *role == Role::Known { Role::Off } else { *role };
        Self { roles: self.roles.iter().map(off).collect(), ..self.clone() }
    }

    /// The unknowns of base and tool alone; `pose` where whole poses are measured.
    pub fn base_and_tool(&self, pose: bool) -> Vec<Unknown> {
        let base = Component::ALL.map(Unknown::Base);
        base.into_iter().chain(self.tool_unknowns(pose)).collect()
    }

    /// The base, all six errors of every frame, and the tool, in this order.
    pub fn constants(&self, pose: bool) -> Vec<Unknown> {
        let frames = 0..self.manipulator.description().frames.len();
        let errors =
            frames.flat_map(|frame| Component::ALL.map(|component| Unknown::Error(frame, component)));
        Component::ALL.map(Unknown::Base).into_iter().chain(errors).chain(self.tool_unknowns(pose)).collect()
    }

    fn tool_unknowns(&self, pose: bool) -> Vec<Unknown> {
        if pose {
            return Component::ALL.map(Unknown::Tool).to_vec();
        }
        (0..self.targets.len()).flat_map(|j| [0, 1, 2].map(|axis| Unknown::Target(j, axis))).collect()
    }

    /// What is known of any machine: its errors are some `share` of its size, turns some `share` of a radian.
    ///
    /// As standard deviations about zero for [`Options::priors`](super::Options::priors); none for base, tool and
    /// magnitudes, which may be anything. What data tell weighs far more; this holds what they hardly tell.
    pub fn priors(&self, share: f64) -> Result<Vec<Option<f64>>, Error> {
        let length = sampling::arm_length(self.manipulator, &self.s)?;
        let prior = |unknown: &Unknown| match unknown {
            Unknown::Error(_, component) if component.is_rotation() => Some(share),
            Unknown::Error(..) => Some(share * length),
            _ => None,
        };
        Ok(self.unknowns.iter().map(prior).collect())
    }

    /// Repeatable sources of the manipulator.
    pub fn repeatable(&self) -> Vec<usize> {
        let description = self.manipulator.description();
        let all = description.sources.iter().enumerate();
        all.filter(|(_, source)| source.class == Class::Repeatable).map(|(i, _)| i).collect()
    }

    /// ε and the tool, at one configuration.
    fn errors(&self, room: &mut Room, seen: &Observation, x: &[f64]) -> Result<(), Error> {
        room.errors.fill([0.0; 6]);
        room.tool = [0.0; 6];
        room.base = [0.0; 6];
        room.targets.copy_from_slice(&self.targets);
        let description = self.manipulator.description();
        if self.roles.iter().any(|role| *role != Role::Off) {
            self.manipulator.effects(&seen.q, &self.s, &seen.u, &mut room.effects)?;
            for (effect, value) in description.effects.iter().zip(&room.effects) {
                if self.roles[effect.source] == Role::Known {
                    room.errors[effect.frame][effect.component.index()] += value;
                }
            }
        }
        for (unknown, value) in self.unknowns.iter().zip(x) {
            match *unknown {
                Unknown::Base(component) => room.base[component.index()] += value,
                Unknown::Error(frame, component) => room.errors[frame][component.index()] += value,
                Unknown::Tool(component) => room.tool[component.index()] += value,
                Unknown::Target(target, axis) => room.targets[target][axis] += value,
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
    fn chain(&self, room: &mut Room, seen: &Observation, x: &[f64]) -> Result<(), Error> {
        self.errors(room, seen, x)?;
        self.manipulator.transforms(&seen.q, &self.s, &mut room.transforms)?;
        room.frames.clear();
        room.frames.push(Frame::new(&self.base, &room.base));
        for i in 0..room.errors.len() {
            let before = room.frames[i].after.then(&room.transforms[i]);
            room.frames.push(Frame::new(&before, &room.errors[i]));
        }
        let tool = room.frames[room.errors.len()].after.then(&room.transforms[room.errors.len()]);
        room.frames.push(Frame::new(&tool, &room.tool));
        Ok(())
    }

    /// The pose of the tool as the instrument should see it.
    pub fn pose(&self, room: &mut Room, seen: &Observation, x: &[f64]) -> Result<Pose, Error> {
        self.chain(room, seen, x)?;
        Ok(room.frames[room.errors.len() + 1].after)
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
            targets: self.targets.clone(),
            base: [0.0; 6],
            tool: [0.0; 6],
        }
    }

    /// Model minus measurement at `x`, row by row: `row(residual, derivative of unknown k)`.
    ///
    /// Rows are divided by the uncertainty. Three for every target that was seen, or position and rotation vector of
    /// a pose: six.
    pub(super) fn rows(
        &self,
        room: &mut Room,
        seen: &Observation,
        x: &[f64],
        mut row: impl FnMut(f64, &mut dyn FnMut(usize) -> f64),
    ) -> Result<(), Error> {
        self.chain(room, seen, x)?;
        let last = room.frames[room.errors.len() + 1].after;
        let Uncertainty { length, angle } = self.uncertainty;
        match &seen.seen {
            Seen::Points(points) => {
                for (j, measured) in points.iter().enumerate() {
                    let Some(measured) = measured else { continue };
                    let target = *room.targets.get(j).ok_or(Error::Count {
                        quantity: Quantity::Pose,
                        expected: self.targets.len(),
                        found: points.len(),
                    })?;
                    let point = last.apply(target);
                    for axis in 0..3 {
                        row((point[axis] - measured[axis]) / length, &mut |k| {
                            self.point(room, k, j, point)[axis] / length
                        });
                    }
                }
            }
            Seen::Pose(measured) => {
                let point = last.position();
                for axis in 0..3 {
                    row((point[axis] - measured.0[3][axis]) / length, &mut |k| {
                        self.point(room, k, usize::MAX, point)[axis] / length
                    });
                }
                let mut difference = last.then(&measured.inverse());
                difference.0[3] = [0.0; 3];
                let turn = rotation_vector(&difference);
                for axis in 0..3 {
                    row(turn[axis] / angle, &mut |k| turned(turn, self.turn(room, k))[axis] / angle);
                }
            }
        }
        Ok(())
    }

    /// How a point of target `j` moves with unknown `k`.
    fn point(&self, room: &Room, k: usize, j: usize, point: [f64; 3]) -> [f64; 3] {
        let last = room.errors.len() + 1;
        match self.unknowns[k] {
            Unknown::Base(component) => room.frames[0].point(component, point),
            Unknown::Error(frame, component) => room.frames[frame + 1].point(component, point),
            Unknown::Tool(component) => room.frames[last].point(component, point),
            Unknown::Target(target, axis) if target == j => room.frames[last].after.0[axis],
            Unknown::Target(..) => [0.0; 3],
            Unknown::Magnitude(source) => self.caused(room, source, |frame, c| frame.point(c, point)),
        }
    }

    fn turn(&self, room: &Room, k: usize) -> [f64; 3] {
        match self.unknowns[k] {
            Unknown::Base(component) => room.frames[0].turn(component),
            Unknown::Error(frame, component) => room.frames[frame + 1].turn(component),
            Unknown::Tool(component) => room.frames[room.errors.len() + 1].turn(component),
            Unknown::Target(..) => [0.0; 3],
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

    /// Position errors, model minus measurement, one vector for every point that was seen. The length unit.
    pub fn deviations(&self, room: &mut Room, seen: &Observation, x: &[f64]) -> Result<Vec<[f64; 3]>, Error> {
        let mut values = Vec::new();
        self.rows(room, seen, x, |residual, _| values.push(residual * self.uncertainty.length))?;
        if matches!(seen.seen, Seen::Pose(_)) {
            values.truncate(3);
        }
        Ok(values.chunks_exact(3).map(|v| [v[0], v[1], v[2]]).collect())
    }

    /// The pose of the tool, and how its point moves per unit of every unknown.
    pub fn tool(
        &self,
        room: &mut Room,
        asked: &Observation,
        x: &[f64],
    ) -> Result<(Pose, Vec<[f64; 3]>), Error> {
        let pose = self.pose(room, asked, x)?;
        let moves = (0..self.unknowns.len()).map(|k| self.point(room, k, usize::MAX, pose.position()));
        Ok((pose, moves.collect()))
    }

    /// What an unknown is called: `e_x1`, of the base `e_x0`, a source by its name.
    pub fn name(&self, unknown: Unknown) -> String {
        match unknown {
            Unknown::Base(component) => format!("{}0", component.name()),
            Unknown::Error(frame, component) => format!("{}{}", component.name(), frame + 1),
            Unknown::Magnitude(source) => self.manipulator.description().sources[source].name.to_string(),
            Unknown::Target(target, axis) => {
                let axis = ["x", "y", "z"][axis];
                if self.targets.len() == 1 {
                    format!("tool_{axis}")
                } else {
                    format!("target{}_{axis}", target + 1)
                }
            }
            Unknown::Tool(component) => format!("tool_{}", component.name()),
        }
    }
}

/// Room for the numbers of one configuration, made once and used for many.
#[derive(Clone, Debug)]
pub struct Room {
    transforms: Vec<Pose>,
    errors: Vec<[f64; 6]>,
    effects: Vec<f64>,
    frames: Vec<Frame>,
    targets: Vec<[f64; 3]>,
    base: [f64; 6],
    tool: [f64; 6],
}
