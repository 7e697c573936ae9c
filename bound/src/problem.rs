//! What is sought, and where.

use crate::affine::Affine;
use crate::corners::Corners;
use crate::tape::Tape;

/// A value whose largest size is sought over a box.
pub(crate) struct Problem {
    /// The value.
    pub(crate) value: Tape,
    /// How it is convex in the names, if it is.
    pub(crate) corners: Option<Corners>,
    /// The value, and its slope along each name.
    pub(crate) all: Tape,
    /// Where each name can be.
    pub(crate) domain: Vec<[f64; 2]>,
    /// Where the search begins.
    pub(crate) start: Vec<f64>,
}

/// A value, and where it is.
#[derive(Clone, Debug)]
pub(crate) struct Point {
    /// No more than the value.
    pub(crate) value: f64,
    pub(crate) at: Vec<f64>,
}

impl Point {
    pub(crate) const NONE: Self = Self { value: f64::NEG_INFINITY, at: Vec::new() };
}

impl Problem {
    /// The value at a point: no more, and no less, than it is.
    pub(crate) fn value_at(&self, points: &mut Vec<Affine<0>>, at: &[f64]) -> [f64; 2] {
        self.value.evaluate(points, at, &vec![0.0; at.len()]).0[0].range()
    }
}
