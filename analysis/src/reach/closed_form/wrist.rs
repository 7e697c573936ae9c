//! Three revolute joints that give an orientation.

use nalgebra::{Matrix3, Vector3};

use super::angles::{angle, angles_to_plane};
use super::line::{TOLERANCE, across, turn, turned};

/// Axes of three revolute joints.
#[derive(Clone, Debug)]
pub(super) struct Wrist([Vector3<f64>; 3]);

impl Wrist {
    /// Returns `None` if consecutive axes are parallel.
    pub(super) fn new(axes: [Vector3<f64>; 3]) -> Option<Self> {
        let turns = |a: usize, b: usize| axes[a].cross(&axes[b]).norm() > TOLERANCE;
        (turns(0, 1) && turns(1, 2)).then_some(Self(axes))
    }

    /// Returns the angles, at most two sets, whose rotations give `rotation`. Where the first and
    /// the last axis are parallel, the first angle is `free`.
    pub(super) fn solve(&self, rotation: &Matrix3<f64>, free: f64) -> Vec<[f64; 3]> {
        let Self([first, second, third]) = *self;
        let image = rotation * third;
        let middle = angles_to_plane(second, third, first, first.dot(&image), 0.0);
        let both = middle.map(|q2| {
            let q1 = angle(first, turned(second, q2, third), image).unwrap_or(free);
            let rest = (turn(first, q1) * turn(second, q2)).transpose() * rotation;
            let unit = across(third);
            [q1, q2, angle(third, unit, rest * unit).unwrap_or(0.0)]
        });
        both.collect()
    }
}
