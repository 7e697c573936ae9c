//! A chain of lower pairs in numbers: `A_T = D_0 J_1(q_1) D_1 … J_n(q_n) D_n`, where `J_i` rotates
//! about, or translates along, z.
//!
//! The numbers follow from the manipulator's transforms at three configurations.
//! [`Frame::lower_pair`](abbe_core::Frame) promises that these determine the chain. Lengths are in
//! arm lengths.

use core::f64::consts::TAU;

use super::target_search::Problem;
use crate::{sampling, sampling::vectors::tangents};
use abbe_core::{Pose, VariableKind};

/// Rotation that reveals the axis of a revolute joint: the three configurations are equidistant,
/// and none is opposite.
const TURN: f64 = TAU / 3.0;
/// Tolerance of the third configuration, in arm lengths and rad.
const AGREEMENT: f64 = 1e-9;
/// Number of configurations at which the pose is verified.
const SAMPLES: usize = 3;

/// Joint with its constant transform.
#[derive(Clone, Debug)]
pub(super) struct Joint {
    /// Transform from the frame on its axis to that of the previous joint, or to `F_0`.
    pub(super) before: Pose,
    /// Revolute or prismatic.
    pub(super) kind: VariableKind,
}

/// Chain with some free joints; the others are fixed.
#[derive(Clone, Debug)]
pub(super) struct JointChain {
    /// Free joints, in the order of their variables.
    pub(super) joints: Vec<Joint>,
    /// Transform from the tool point's frame to that of the last free joint.
    pub(super) tool: Pose,
}

impl JointChain {
    /// Extracts the chain with the free variables of a problem. Returns `None` if it is not known
    /// to consist of lower pairs.
    pub(super) fn new(problem: &Problem<'_>) -> Option<Self> {
        let Problem { manipulator, ref s, ref free, arm, ref starts, ref sums } = *problem;
        let (description, start) = (manipulator.description(), &starts[0]);
        if !sums.followers.is_empty() || !description.frames.iter().all(|frame| frame.lower_pair) {
            return None;
        }
        let unit = |i: usize| description.variables[i].kind.either(1.0, arm);
        let transforms = |share: f64| {
            let mut q = start.clone();
            for &i in free {
                q[i] += share * unit(i) * size(description.variables[i].kind);
            }
            let mut transforms = vec![Pose::IDENTITY; description.frames.len() + 1];
            manipulator.transforms(&q, s, &mut transforms).ok()?;
            transforms.iter_mut().for_each(|transform| *transform = scaled(transform, arm));
            Some(transforms)
        };
        let (here, forth, back) = (transforms(0.0)?, transforms(1.0)?, transforms(-1.0)?);
        let mut joints = Vec::with_capacity(free.len());
        let mut behind = Pose::IDENTITY;
        for (i, frame) in description.frames.iter().enumerate() {
            let Some(variable) = frame.variable.filter(|variable| free.contains(variable)) else {
                behind = behind.then(&here[i]);
                continue;
            };
            let kind = description.variables[variable].kind;
            let axis = axis(kind, &here[i], &forth[i], &back[i])?;
            joints.push(Joint { before: behind.then(&axis), kind });
            let back_home = motion(kind, -start[variable] / unit(variable));
            behind = back_home.then(&axis.inverse()).then(&here[i]);
        }
        let chain = Self { joints, tool: behind.then(here.last()?) };
        let agrees = (0..SAMPLES).all(|index| {
            let sample = sampling::joint_sample(description, arm, free, index);
            let mut q = start.clone();
            free.iter().for_each(|&i| q[i] = sample[i]);
            let own: Vec<f64> = free.iter().map(|&i| q[i] / unit(i)).collect();
            let pose = manipulator.pose(&q, s).map(|pose| scaled(&pose, arm));
            pose.is_ok_and(|pose| near(&pose, &chain.pose(&own)))
        });
        (agrees && chain.joints.len() == free.len()).then_some(chain)
    }

    /// Returns the chain from the tool to the base: `J(q)⁻¹ = J(−q)`.
    pub(super) fn reversed(&self) -> Self {
        let mut behind = self.tool.inverse();
        let joints = self.joints.iter().rev().map(|joint| {
            let before = core::mem::replace(&mut behind, joint.before.inverse());
            Joint { before, kind: joint.kind }
        });
        Self { joints: joints.collect(), tool: behind }
    }

    /// Returns the chain with the origin on each axis moved next to that on the following axis,
    /// from the tool point on.
    pub(super) fn centred(&self) -> Self {
        let Self { mut joints, mut tool } = self.clone();
        let mut after = &mut tool;
        for joint in joints.iter_mut().rev() {
            let next = after.position();
            let centre = joint.kind.either([0.0, 0.0, next[2]], next);
            *after = shift(centre.map(|x| -x)).then(after);
            joint.before = joint.before.then(&shift(centre));
            after = &mut joint.before;
        }
        Self { joints, tool }
    }

    /// Returns the pose of the tool point.
    pub(super) fn pose(&self, q: &[f64]) -> Pose {
        let last = self.joints.iter().zip(q).fold(Pose::IDENTITY, |pose, (joint, value)| {
            pose.then(&joint.before).then(&motion(joint.kind, *value))
        });
        last.then(&self.tool)
    }
}

/// Converts the lengths of a pose to arm lengths.
pub(super) fn scaled(pose: &Pose, arm: f64) -> Pose {
    let [x, y, z, position] = pose.0;
    Pose([x, y, z, position.map(|p| p / arm)])
}

/// Returns a translation.
pub(super) fn shift(by: [f64; 3]) -> Pose {
    let Pose([x, y, z, _]) = Pose::IDENTITY;
    Pose([x, y, z, by])
}

/// Returns the displacement that reveals the axis of a joint.
fn size(kind: VariableKind) -> f64 {
    kind.either(TURN, 1.0)
}

/// Returns a rotation about z, or a translation along it.
pub(super) fn motion(kind: VariableKind, by: f64) -> Pose {
    let Pose([x, y, z, mut position]) = Pose::IDENTITY;
    match kind {
        VariableKind::Revolute => {
            let (sine, cosine) = by.sin_cos();
            Pose([[cosine, sine, 0.0], [-sine, cosine, 0.0], z, position])
        }
        VariableKind::Prismatic => {
            position[2] = by;
            Pose([x, y, z, position])
        }
    }
}

/// Returns a frame with the axis of a joint as z, relative to the previous frame, from `A_i` at the
/// current value, and displaced forwards and backwards.
fn axis(kind: VariableKind, here: &Pose, forth: &Pose, back: &Pose) -> Option<Pose> {
    let home = here.inverse();
    let (forth, back) = (forth.then(&home), back.then(&home));
    let (along, at) = match kind {
        VariableKind::Revolute => {
            let axis = sampling::JointAxis::of_motion(&forth);
            (axis.direction, axis.point?)
        }
        VariableKind::Prismatic => (forth.position(), [0.0; 3]),
    };
    let length = sampling::norm(along);
    // NaN fails, too.
    if (length - 1.0).abs().is_nan() || (length - 1.0).abs() > AGREEMENT {
        return None;
    }
    let along = along.map(|component| component / length);
    let [x, y] = tangents(along);
    let axis = Pose([x, y, along, at]);
    let moved = |by: f64| axis.then(&motion(kind, by)).then(&axis.inverse());
    (near(&moved(size(kind)), &forth) && near(&moved(-size(kind)), &back)).then_some(axis)
}

fn near(a: &Pose, b: &Pose) -> bool {
    a.0.as_flattened().iter().zip(b.0.as_flattened()).all(|(a, b)| (a - b).abs() <= AGREEMENT)
}
