//! A chain of lower pairs in lanes, with the minimal number of constants.
//!
//! With z the axis of a joint, `D = R_z(θ) T(a, b, 0) R_x(α) R_z(φ)` is the transform to the next
//! one. `R_z(φ)` commutes with the motion of the next joint and merges into its transform. The
//! translation along the axis commutes with the motion of the previous joint;
//! [`JointChain::centred`] has moved it the other way.

// Loops instead of closures, which could be compiled without the instruction set.
#![allow(clippy::needless_range_loop)]

use super::joint_chain::{JointChain, motion};
use abbe_core::lanes::{Lanes, Register};
use abbe_core::{Pose, Scalar, VariableKind};

/// Distance below which numbers are rounded to 0 or 1.
const ROUNDED: f64 = 1e-15;

pub(super) type Vector<R> = [Lanes<R>; 3];

/// Chain with the same constants in every lane.
pub(super) struct LaneChain<R: Register> {
    /// Transform to the first axis.
    pub(super) base: [Vector<R>; 4],
    pub(super) joints: Vec<LaneJoint<R>>,
    /// Transform from the last joint to the tool point.
    pub(super) tool: [Vector<R>; 4],
}

/// Joint with the transform to the next one.
pub(super) struct LaneJoint<R: Register> {
    pub(super) turns: bool,
    /// θ, followed by its sine and cosine.
    angle: Lanes<R>,
    sine_cosine: [Lanes<R>; 2],
    /// a and b, unless both are zero.
    offset: Option<[Lanes<R>; 2]>,
    tilt: Tilt<R>,
}

/// Sine and cosine of α.
enum Tilt<R: Register> {
    None,
    Quarter,
    Any([Lanes<R>; 2]),
}

impl<R: Register> LaneChain<R> {
    pub(super) fn new(chain: &JointChain) -> Self {
        let JointChain { joints, tool } = chain.centred();
        let base = joints.first().map_or(Pose::IDENTITY, |joint| joint.before);
        let mut passed_on = Pose::IDENTITY;
        let mut lane_joints = Vec::with_capacity(joints.len());
        for (i, joint) in joints.iter().enumerate() {
            let Some(next) = joints.get(i + 1) else {
                lane_joints.push(LaneJoint::new(joint.kind, 0.0, [0.0; 2], 0.0));
                break;
            };
            let way = passed_on.then(&next.before);
            let [_, _, [x, y, z], at] = way.0;
            let (turn, tilt) = (x.atan2(-y), x.hypot(y).atan2(z));
            let tilted = motion(VariableKind::Revolute, turn).then(&about_x(tilt));
            let rest = tilted.inverse().then(&way).0[0];
            passed_on = motion(VariableKind::Revolute, rest[1].atan2(rest[0]));
            let (sine, cosine) = turn.sin_cos();
            let offset = [cosine * at[0] + sine * at[1], cosine * at[1] - sine * at[0]];
            lane_joints.push(LaneJoint::new(joint.kind, turn, offset, tilt));
        }
        let tool = if joints.is_empty() { tool } else { passed_on.then(&tool) };
        Self { base: everywhere(&base), joints: lane_joints, tool: everywhere(&tool) }
    }
}

impl<R: Register> LaneJoint<R> {
    fn new(kind: VariableKind, turn: f64, offset: [f64; 2], tilt: f64) -> Self {
        let numbers = |[sine, cosine]: [f64; 2]| [rounded(sine), rounded(cosine)];
        let of = |angle: f64| numbers([angle.sin(), angle.cos()]);
        let tilt = match of(tilt) {
            [0.0, 1.0] => Tilt::None,
            [1.0, 0.0] => Tilt::Quarter,
            numbers => Tilt::Any(numbers.map(Lanes::constant)),
        };
        let offset = numbers(offset);
        Self {
            turns: kind == VariableKind::Revolute,
            angle: Lanes::constant(turn),
            sine_cosine: of(turn).map(Lanes::constant),
            offset: (offset != [0.0; 2]).then(|| offset.map(Lanes::constant)),
            tilt,
        }
    }

    /// Transforms a frame on this joint's axis to that of the next joint.
    #[inline(always)]
    pub(super) fn pass(&self, frame: &mut [Vector<R>; 4], q: Lanes<R>) {
        let [sine, cosine] = if self.turns { (q + self.angle).sin_cos().into() } else { self.sine_cosine };
        for row in 0..3 {
            let (x, y) = (frame[0][row], frame[1][row]);
            frame[0][row] = x.mul_add(cosine, y * sine);
            frame[1][row] = x.neg_mul_add(sine, y * cosine);
        }
        if !self.turns {
            for row in 0..3 {
                frame[3][row] = frame[2][row].mul_add(q, frame[3][row]);
            }
        }
        if let Some([a, b]) = self.offset {
            for row in 0..3 {
                frame[3][row] = frame[1][row].mul_add(b, frame[0][row].mul_add(a, frame[3][row]));
            }
        }
        match self.tilt {
            Tilt::None => {}
            Tilt::Quarter => {
                for row in 0..3 {
                    (frame[1][row], frame[2][row]) = (frame[2][row], -frame[1][row]);
                }
            }
            Tilt::Any([sine, cosine]) => {
                for row in 0..3 {
                    let (y, z) = (frame[1][row], frame[2][row]);
                    frame[1][row] = y.mul_add(cosine, z * sine);
                    frame[2][row] = y.neg_mul_add(sine, z * cosine);
                }
            }
        }
    }
}

/// Multiplies a frame by a motion.
#[inline(always)]
pub(super) fn then<R: Register>(frame: &mut [Vector<R>; 4], motion: &[Vector<R>; 4]) {
    let position = apply(frame, &motion[3]);
    let [x, y, z, _] = *frame;
    for column in 0..3 {
        let [a, b, c] = motion[column];
        for row in 0..3 {
            frame[column][row] = z[row].mul_add(c, y[row].mul_add(b, x[row] * a));
        }
    }
    frame[3] = position;
}

/// Returns a point of a frame in the coordinates of its base.
#[inline(always)]
pub(super) fn apply<R: Register>([x, y, z, at]: &[Vector<R>; 4], point: &Vector<R>) -> Vector<R> {
    let mut applied = *at;
    for row in 0..3 {
        applied[row] = z[row].mul_add(point[2], y[row].mul_add(point[1], x[row].mul_add(point[0], at[row])));
    }
    applied
}

fn everywhere<R: Register>(pose: &Pose) -> [Vector<R>; 4] {
    pose.0.map(|column| column.map(Lanes::constant))
}

/// Returns a rotation about x.
fn about_x(angle: f64) -> Pose {
    let (sine, cosine) = angle.sin_cos();
    Pose([[1.0, 0.0, 0.0], [0.0, cosine, sine], [0.0, -sine, cosine], [0.0; 3]])
}

fn rounded(number: f64) -> f64 {
    let nearest = number.round();
    if (number - nearest).abs() < ROUNDED { nearest } else { number }
}
