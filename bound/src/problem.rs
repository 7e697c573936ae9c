//! The function to maximize and its domain.

use crate::affine::Affine;
use crate::corners::Corners;
use crate::tape::Tape;

/// A value to be maximized over a box.
pub(crate) struct Problem {
    /// The value.
    pub(crate) value: Tape,
    /// Evaluation at control points, if the value is a norm of polynomials in the names.
    pub(crate) corners: Option<Corners>,
    /// The value and its slope along each name.
    pub(crate) all: Tape,
    /// Range of each name.
    pub(crate) domain: Vec<[f64; 2]>,
    /// Start of the search.
    pub(crate) start: Vec<f64>,
}

/// A value and the point at which it is taken.
#[derive(Clone, Debug)]
pub(crate) struct Point {
    /// Lower bound of the value.
    pub(crate) value: f64,
    pub(crate) at: Vec<f64>,
}

impl Point {
    pub(crate) const NONE: Self = Self { value: f64::NEG_INFINITY, at: Vec::new() };
}

impl Problem {
    /// Returns an enclosure of the value at a point.
    pub(crate) fn value_at(&self, points: &mut Vec<Affine<0>>, at: &[f64]) -> [f64; 2] {
        self.value.evaluate(points, at, &vec![0.0; at.len()]).0[0].range()
    }
}
