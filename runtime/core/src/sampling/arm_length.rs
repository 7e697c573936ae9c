//! Size of a machine, which scales its lengths.
//!
//! The size is that of the axes as lines in space: the origin of a frame may be anywhere on the
//! axis of its joint, and a slide has a direction only. Thus it depends neither on where a table
//! places its origins, nor on the unit.

use std::{vec, vec::Vec};

use super::vectors::{add, cross, distance, dot, norm, scale, subtract};
use super::{halton, home};
use crate::{Description, Manipulator, Pose, Result, VariableKind};

/// Motion of all joints at home by which the axes are found: in rad, and in sums of the lengths of
/// the transforms.
const STEP: f64 = 1e-3;

/// Smallest sine of a rotation; a slide of measured straightness rotates by less.
const ROTATION: f64 = 1e-4;

/// Smallest size, in sums of the lengths of the transforms.
const SIZE: f64 = 1e-9;

/// Axis of a joint, as a line in space.
#[derive(Clone, Copy, Debug)]
pub struct JointAxis {
    /// Unit vector along the axis.
    pub direction: [f64; 3],
    /// Point on the axis of a rotation; none for a translation.
    pub point: Option<[f64; 3]>,
}

impl JointAxis {
    /// Returns the axis of a rigid motion. A rotation below 0.1 mrad counts as none.
    pub fn of_motion(Pose([x, y, z, t]): &Pose) -> Self {
        let v = [y[2] - z[1], z[0] - x[2], x[1] - y[0]];
        let twice_sine = norm(v);
        if twice_sine < 2.0 * ROTATION {
            return Self { direction: scale(*t, 1.0 / norm(*t)), point: None };
        }
        let (angle, a) = (twice_sine.atan2(x[0] + y[1] + z[2] - 1.0), scale(v, 1.0 / twice_sine));
        // t⊥ = (1 − R) c has the solution c = (t⊥ + cot(φ/2) a × t) / 2 in the plane across the axis.
        let across = subtract(*t, scale(a, dot(a, *t)));
        let point = scale(add(across, scale(cross(a, *t), 1.0 / (0.5 * angle).tan())), 0.5);
        Self { direction: a, point: Some(point) }
    }

    /// Takes an axis from a frame to the frame in which its pose is given.
    pub fn in_outer_frame(&self, frame: &Pose) -> Self {
        Self { direction: frame.turn(self.direction), point: self.point.map(|point| frame.apply(point)) }
    }

    /// Returns the point of the axis that is nearest to a point: that point itself for a
    /// translation, whose axis may be anywhere.
    pub fn nearest(&self, point: [f64; 3]) -> [f64; 3] {
        let along = |own| scale(self.direction, dot(self.direction, subtract(point, own)));
        self.point.map_or(point, |own| add(own, along(own)))
    }
}

/// Returns the size of a machine at home: the length of the way from the origin of `F_0` to the
/// nearest point of each axis and to the tool point, and the travel of the slides with limits.
///
/// In a tree it is the longest of the ways to its frames and to the tool. A machine with neither
/// lengths nor travel has the size 1 m. Errors as for [`Manipulator::transforms`].
pub fn arm_length(manipulator: &dyn Manipulator, s: &[f64]) -> Result<f64> {
    arm_length_within(manipulator, s, &[])
}

/// Returns the size of a machine whose joint variables move in these ranges where they have no
/// limits. Variables without a finite range have no travel.
///
/// Otherwise as [`arm_length`].
pub fn arm_length_within(manipulator: &dyn Manipulator, s: &[f64], ranges: &[[f64; 2]]) -> Result<f64> {
    let description = manipulator.description();
    let at = |q: &[f64]| {
        let mut transforms = vec![Pose::IDENTITY; description.frames.len() + 1];
        manipulator.transforms(q, s, &mut transforms).map(|()| transforms)
    };
    let home = home(description);
    let here = at(&home)?;
    let sum = here.iter().map(|transform| norm(transform.position())).sum::<f64>();
    let beside = |sign: f64| -> Vec<f64> {
        let joints = home.iter().zip(&*description.variables).enumerate();
        // Unequal steps, so that sums and differences of joints move, too.
        let step = |j: usize| sign * STEP * (1.0 + 0.5 * halton(j, 0));
        joints.map(|(j, (q, variable))| q + step(j) * variable.kind.either(1.0, sum)).collect()
    };
    // Loops may close on one side of home only.
    let there = at(&beside(1.0)).or_else(|_| at(&beside(-1.0))).unwrap_or_else(|_| here.clone());

    let start = (Pose::IDENTITY, [0.0; 3], 0.0);
    let mut ends: Vec<(Pose, [f64; 3], f64)> = Vec::with_capacity(here.len());
    for (i, (here, there)) in here.iter().zip(&there).take(description.frames.len()).enumerate() {
        let (outer, last, length) = description.parent(i).map_or(start, |parent| ends[parent]);
        let axis = JointAxis::of_motion(&there.then(&here.inverse()));
        let origin = axis.in_outer_frame(&outer).nearest(last);
        let length = length + distance(origin, last) + travel(description, i, ranges);
        ends.push((outer.then(here), origin, length));
    }
    let (outer, last, length) = description.tool_frame().map_or(start, |frame| ends[frame]);
    let tool = here.last().map_or(last, |tool| outer.apply(tool.position()));
    let longest = ends.iter().map(|end| end.2).fold(length + distance(tool, last), f64::max);
    Ok(if longest > SIZE * sum { longest } else { 1.0 / description.length.in_metres() })
}

/// Returns the travel of the slide of a frame; 0 for other joints, and without a finite range.
fn travel(description: &Description, frame: usize, ranges: &[[f64; 2]]) -> f64 {
    let frame = &description.frames[frame];
    let passive = || frame.branch.as_ref()?.passive.as_ref();
    let variable = frame.variable.and_then(|j| description.variables.get(j)).or_else(passive);
    let Some(variable) = variable.filter(|one| one.kind == VariableKind::Prismatic) else { return 0.0 };
    let range = frame.variable.and_then(|j| ranges.get(j)).unwrap_or(&variable.limits);
    let travels = [&variable.limits, range].map(|[lower, upper]| upper - lower);
    travels.into_iter().find(|travel| travel.is_finite()).unwrap_or(0.0)
}
