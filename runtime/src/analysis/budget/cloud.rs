//! The points of a cloud that may be on the smallest sphere around it, gathered in lanes.

use super::enclosing_sphere::{Enclosing, Shell};
use super::peak;
use crate::Scalar;
use crate::lanes::{Lanes, Register};

/// What was gathered of some points.
#[derive(Clone, Debug, Default)]
pub(super) struct Cloud {
    /// The points that may be on the sphere, in order.
    outside: Vec<[f64; 3]>,
    /// How far the others are from the centre that the sphere began with.
    inside: f64,
}

impl Cloud {
    /// The sphere takes them in.
    pub(super) fn enclose(&self, sphere: &mut Enclosing) {
        sphere.forget(self.inside);
        self.outside.iter().for_each(|point| sphere.add(*point));
    }
}

/// Gathers a [`Cloud`] in lanes.
pub(super) struct Lane<R: Register> {
    shell: Shell,
    inside: Lanes<R>,
    outside: Vec<[f64; 3]>,
}

impl<R: Register> Lane<R> {
    /// Beginning with the sphere of some points from everywhere.
    pub(super) fn new(shell: Shell) -> Self {
        Self { shell, inside: Lanes::constant(0.0), outside: Vec::new() }
    }

    /// Takes in the points of a tile; those of weight 0 repeat the last.
    #[inline(always)]
    pub(super) fn add(&mut self, points: [Lanes<R>; 3], weight: Lanes<R>) {
        let centre = self.shell.centre.map(Lanes::constant);
        let from = core::array::from_fn(|i| points[i] - centre[i]);
        let square = peak::square(from);
        let outside = square.more_than(Lanes::constant(self.shell.inner * self.shell.inner));
        if !outside.any() {
            self.inside = square.max(self.inside);
            return;
        }
        let [x, y, z] = points.each_ref().map(Lanes::to_slice);
        let mut inside = 0.0_f64;
        for (lane, square) in square.to_slice().iter().enumerate() {
            if *square <= self.shell.inner * self.shell.inner {
                inside = inside.max(*square);
            } else if weight.to_slice()[lane] > 0.0 {
                self.outside.push([x[lane], y[lane], z[lane]]);
            }
        }
        self.inside = Lanes::constant(inside).max(self.inside);
    }

    pub(super) fn finish(self) -> Cloud {
        Cloud { outside: self.outside, inside: peak::largest(self.inside).sqrt() }
    }
}
