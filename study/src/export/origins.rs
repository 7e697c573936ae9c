//! Where the joints of the real machine stand, for formats that place each joint and let it turn about, or slide along, an axis of its
//! own frame.
//!
//! With all variables 0 let `U_k` be the frame of joint k in `F_0`, as the format has it, and `N_i`, `R_i` the nominal and the real
//! chain up to the motion of the frame i that is this joint. What is wrong before the joint moves it by `D_i = R_i N_i⁻¹`:
//!
//! ```text
//! U_k' = D_i U_k         the errors E_i behind the joint go to whatever comes next, and in the end to the tool
//! ```
//!
//! The tool is where it is if every axis is, and if the tool is with all variables 0: `A_T(q) = exp(S_1 q_1) … exp(S_n q_n) A_T(0)`. Where spec and
//! format do not place an axis alike (rounded angles, numbers of a catalogue), `U_k'` is brought to the axis of the spec by the shortest way.

use abbe::{Error, Manipulator, Pose};

use super::found::{Errors, Found, Link};

/// A joint of the format, from base to tip.
#[derive(Clone, Debug)]
pub(super) struct Joint {
    /// Its frame in the frame of the link before it, in the spec's length unit.
    pub(super) origin: Pose,
    /// The axis in it; none of a fixed one.
    pub(super) axis: Option<[f64; 3]>,
    /// How it is moved where all variables are 0.
    pub(super) at_zero: Pose,
    /// The frame of the spec that it is, if it is one; a joint that moves is one.
    pub(super) frame: Option<usize>,
}

/// The line that a joint of the spec turns about, or the direction in which it slides.
struct Axis {
    direction: [f64; 3],
    /// Of a joint that turns.
    point: Option<[f64; 3]>,
}

/// The origins of the real machine; `tool` is the spec's tool as the last link of the format sees it.
pub(super) fn origins(found: &Found, joints: &[Joint], tool: &Pose) -> Result<Vec<Pose>, Error> {
    let zero = vec![0.0; found.spec.variables.len()];
    let (nominal, _) = found.links(&zero, &Errors::none(&found.spec))?;
    let (real, real_tool) = found.links(&zero, &found.mean)?;
    let end = real.iter().fold(Pose::IDENTITY, |pose, link| behind(&pose, link)).then(&real_tool);
    // Where the last link is to be.
    let tip = end.then(&tool.inverse());
    let (mut old, mut new) = (Pose::IDENTITY, Pose::IDENTITY);
    let mut origins = Vec::with_capacity(joints.len());
    for (k, joint) in joints.iter().enumerate() {
        let frame = old.then(&joint.origin);
        let is_last = k + 1 == joints.len();
        let displaced = joint.frame.map(|i| {
            let up_to = |links: &[Link]| {
                let before = links[..i].iter().fold(Pose::IDENTITY, |pose, link| behind(&pose, link));
                before.then(&links[i].transform)
            };
            let reached = up_to(&real);
            let reached = if joint.axis.is_none() { reached.then(&real[i].error) } else { reached };
            (reached.then(&up_to(&nominal).inverse()).then(&frame), up_to(&real))
        });
        let placed = match (joint.axis, displaced, joint.frame) {
            (Some(axis), Some((displaced, reached)), Some(i)) => {
                let wanted = if is_last { tip.then(&joint.at_zero.inverse()) } else { displaced };
                let own = own_axis(found, i)?;
                aligned(&wanted, axis, &own.seen_from(&reached))
            }
            _ if is_last => tip,
            (None, Some((displaced, _)), _) => displaced,
            _ => new.then(&joint.origin),
        };
        origins.push(new.inverse().then(&placed));
        old = frame.then(&joint.at_zero);
        new = placed.then(&joint.at_zero);
    }
    Ok(origins)
}

fn behind(pose: &Pose, link: &Link) -> Pose {
    pose.then(&link.transform).then(&link.error)
}

/// The axis of a frame's joint, seen from the frame behind its motion: what `A_i(0)⁻¹ A_i(q)` turns about or moves along.
fn own_axis(found: &Found, frame: usize) -> Result<Axis, Error> {
    const SOME: f64 = 0.5;
    let variable = found.spec.variables_of_transforms()[frame].first().copied().unwrap_or_default();
    let mut q = vec![0.0; found.spec.variables.len()];
    let mut at = |value: f64| {
        let mut transforms = vec![Pose::IDENTITY; found.spec.frames.len() + 1];
        q[variable] = value;
        found.manipulator.transforms(&q, &found.s, &mut transforms).map(|()| transforms[frame])
    };
    let motion = at(0.0)?.inverse().then(&at(SOME)?);
    let Pose([x, y, z, t]) = motion;
    let v = [y[2] - z[1], z[0] - x[2], x[1] - y[0]];
    let twice_sine = norm(v);
    if twice_sine < 1e-12 {
        return Ok(Axis { direction: scaled(t, 1.0 / norm(t)), point: None });
    }
    // t = (1 − R) c has the solution c = (t + cot(φ/2) a × t) / 2 in the plane across the axis.
    let angle = twice_sine.atan2(x[0] + y[1] + z[2] - 1.0);
    let direction = scaled(v, 1.0 / twice_sine);
    let swing = scaled(cross(direction, t), 1.0 / (0.5 * angle).tan());
    Ok(Axis { direction, point: Some(scaled(add(t, swing), 0.5)) })
}

impl Axis {
    fn seen_from(&self, frame: &Pose) -> Self {
        Self { direction: frame.turn(self.direction), point: self.point.map(|point| frame.apply(point)) }
    }
}

/// A frame, brought by the shortest way to where its axis is the one that it should be.
fn aligned(frame: &Pose, axis: [f64; 3], wanted: &Axis) -> Pose {
    let from = frame.turn(axis);
    let sign = if dot(from, wanted.direction) < 0.0 { -1.0 } else { 1.0 };
    let to = scaled(wanted.direction, sign);
    // R = 1 + [v]× + [v]×² / (1 + cos): the turn that takes one direction to the other.
    let (v, c) = (cross(from, to), dot(from, to));
    let turned = |w: [f64; 3]| {
        let first = cross(v, w);
        add(add(w, first), scaled(cross(v, first), 1.0 / (1.0 + c)))
    };
    let [x, y, z, p] = frame.0;
    let origin = match wanted.point {
        Some(point) => add(point, scaled(to, dot(to, add(p, scaled(point, -1.0))))),
        None => p,
    };
    Pose([turned(x), turned(y), turned(z), origin])
}

fn add(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    std::array::from_fn(|i| a[i] + b[i])
}

fn scaled(a: [f64; 3], by: f64) -> [f64; 3] {
    a.map(|v| v * by)
}

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

fn norm(a: [f64; 3]) -> f64 {
    dot(a, a).sqrt()
}

fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}
