//! Three parallel axes between the first joint and the last two, whose axes intersect.

use abbe_core::Pose;
use nalgebra::{Matrix3, Vector3};

use super::angles::{angle, angles_to_plane, linear};
use super::line::{Line, across, common_point, turn, turned, vector};

/// Axes of the six joints.
#[derive(Clone, Debug)]
pub(super) struct Parallel {
    axes: [Line; 6],
    /// Directions of the third and fourth axis relative to the second, 1 or −1.
    signs: [f64; 2],
    /// Point where the last two axes intersect.
    centre: Vector3<f64>,
}

impl Parallel {
    /// Returns `None` if the axes are others.
    pub(super) fn new(axes: &[Line; 6]) -> Option<Self> {
        let [first, second, third, fourth, fifth, sixth] = axes;
        let is_parallel = second.is_parallel(third) && second.is_parallel(fourth);
        if !is_parallel || first.is_parallel(second) || fourth.is_parallel(fifth) {
            return None;
        }
        let signs = [third, fourth].map(|line| second.along.dot(&line.along).signum());
        Some(Self { axes: *axes, signs, centre: common_point(fifth, sixth)? })
    }

    /// Adds the solutions for a motion from the zero position, at most eight.
    ///
    /// The parallel axes keep heights along h. That of the center gives q_1, that of the last axis
    /// q_5, and the direction of h seen from the last link q_6. What remains is a plane arm of two
    /// links with a known last angle. Joints that are free to move stay at `free`.
    pub(super) fn solve(
        &self,
        motion: &Pose,
        rotation: &Matrix3<f64>,
        free: [f64; 6],
        found: &mut Vec<[f64; 6]>,
    ) {
        let [first, second, third, fourth, fifth, sixth] = &self.axes;
        let h = second.along;
        let place = vector(motion.apply(self.centre.into()));
        let height = h.dot(&(self.centre - first.at));
        // h · R_1ᵀ v is a height of v turned by −q_1.
        for back in angles_to_plane(first.along, place - first.at, h, height, -free[0]) {
            let (q1, unturned) = (-back, turn(first.along, back));
            let seen = unturned * rotation;
            let last = h.dot(&(seen * sixth.along));
            for q5 in angles_to_plane(fifth.along, sixth.along, h, last, free[4]) {
                // R_6ᵀ R_5ᵀ h = (R_1ᵀ R)ᵀ h
                let tilted = turned(fifth.along, -q5, h);
                let q6 = angle(sixth.along, tilted, seen.transpose() * h).map_or(free[5], |angle| -angle);
                let ends = turn(fifth.along, q5) * turn(sixth.along, q6);
                let together = seen * ends.transpose();
                let unit = across(h);
                let total = angle(h, unit, together * unit).unwrap_or(0.0);
                let wrist = first.turned(back, place) - turned(h, total, self.centre - fourth.at);
                let (lower, upper) = (third.at - second.at, fourth.at - third.at);
                let flat = |v: Vector3<f64>| v - h * h.dot(&v);
                let (lower, upper, reach) = (flat(lower), flat(upper), flat(wrist - second.at));
                let lengths = reach.norm_squared() - lower.norm_squared() - upper.norm_squared();
                let bend = [-lengths / 2.0, lower.dot(&upper), lower.dot(&h.cross(&upper))];
                for q3 in linear(bend, self.signs[0] * free[2]) {
                    let q2 = angle(h, lower + turned(h, q3, upper), reach).unwrap_or(free[1]);
                    let q4 = total - q2 - q3;
                    found.push([q1, q2, self.signs[0] * q3, self.signs[1] * q4, q5, q6]);
                }
            }
        }
    }
}
