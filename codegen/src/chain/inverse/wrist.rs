//! Three revolute joints that give an orientation.

use super::{Angle, Probes, Root, angle_between, are_square, reject, tilt_angles};
use crate::graph::{Graph, Vector};

/// Directions of the axes of three revolute joints.
pub(super) struct Wrist<'a> {
    axes: [Vector; 3],
    probes: &'a Probes,
}

impl<'a> Wrist<'a> {
    /// Returns `None` if consecutive axes are parallel.
    pub(super) fn new(g: &mut Graph, probes: &'a Probes, axes: [Vector; 3]) -> Option<Self> {
        let mut turns = |a: usize, b: usize| !probes.are_parallel(g, axes[a], axes[b]);
        (turns(0, 1) && turns(1, 2)).then_some(Self { axes, probes })
    }

    /// Returns the two sets of angles whose rotations give the one that `rotated` applies to a
    /// vector. Where the first and the last axis are parallel, the first angle is that of `free`.
    pub(super) fn solve(
        &self,
        g: &mut Graph,
        rotated: impl Fn(&mut Graph, Vector) -> Vector,
        [free, last]: [Angle; 2],
    ) -> [[Root; 3]; 2] {
        let [first, second, third] = self.axes;
        let image = rotated(g, third);
        let unit = across(g, self.probes, third);
        let mark = rotated(g, unit);
        let ends = |g: &mut Graph, q2: Angle| {
            let tilted = q2.turn(g, second, third);
            let q1 = angle_between(g, first, tilted, image, free, 1.0).normalized(g);
            let back = q1.signed(g, -1.0).turn(g, first, mark);
            let back = q2.signed(g, -1.0).turn(g, second, back);
            [q1, angle_between(g, third, unit, back, last, 1.0)]
        };
        let middle = tilt_angles(g, self.axes, image, self.probes);
        let [near, far] = middle.map(|q2| q2.angle);
        let near = ends(g, near);
        let far = if are_square(g, self.axes, self.probes) {
            // R_1(π) R_2(−α) = R_2(α) R_1(π)
            near.map(|angle| angle.opposite(g))
        } else {
            ends(g, far)
        };
        [0, 1].map(|i| {
            let Root { angle, exists } = middle[i];
            let [q1, q3] = [near, far][i];
            [q1, angle, q3].map(|angle| Root { angle, exists })
        })
    }
}

/// Returns a unit vector across a unit vector.
pub(super) fn across(g: &mut Graph, probes: &Probes, along: Vector) -> Vector {
    let parts = along.map(|part| probes.nominal(g, part).abs());
    let least = (0..3).min_by(|a, b| parts[*a].total_cmp(&parts[*b])).unwrap_or(0);
    let mut axis = [g.zero(); 3];
    axis[least] = g.constant(1.0);
    let flat = reject(g, along, axis);
    let (length, one) = (g.norm(flat), g.constant(1.0));
    let inverse = g.div(one, length);
    g.scale(inverse, flat)
}
