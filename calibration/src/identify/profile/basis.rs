//! Functions of a joint of which its profile is a sum.

use core::f64::consts::PI;

use crate::identify::{Observation, Unknown};

/// Joint that may have a profile.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ProfileJoint {
    /// Index of the joint among the variables.
    pub variable: usize,
    /// Constant error of the joint: the magnitude of a source, or an equivalent error of a frame.
    pub error: Unknown,
    /// Functions of the profile.
    pub basis: ProfileBasis,
    /// Range of the joint; beyond it the value at the end holds.
    pub range: [f64; 2],
    /// Highest number of cycles of the functions, at most [`ProfileBasis::CYCLES`].
    pub cycles: usize,
}

impl ProfileJoint {
    /// Returns the number of functions.
    pub(super) fn count(&self) -> usize {
        self.cycles * self.basis.phases()
    }

    /// Returns the functions at a joint value, or at the end of the range beyond it.
    fn values(&self, q: f64) -> Vec<f64> {
        let [from, to] = self.range;
        let mut values = vec![0.0; self.count()];
        self.basis.fill(q.max(from).min(to), &mut values);
        values
    }
}

/// Functions of a joint less their means over some rows.
///
/// Without that, functions that the rows leave free in a gap could add up to a constant elsewhere.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Centered {
    pub(super) joint: ProfileJoint,
    means: Vec<f64>,
}

impl Centered {
    pub(super) fn new(joint: ProfileJoint, data: &[Observation]) -> Self {
        let mut means = vec![0.0; joint.count()];
        for row in data {
            let values = joint.values(row.q[joint.variable]);
            means.iter_mut().zip(values).for_each(|(mean, value)| *mean += value / data.len() as f64);
        }
        Self { joint, means }
    }

    /// Returns the functions at a joint value, or at the end of the range beyond it.
    pub(super) fn values(&self, q: f64) -> impl Iterator<Item = f64> {
        self.joint.values(q).into_iter().zip(&self.means).map(|(value, mean)| value - mean)
    }
}

/// Functions of a joint.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ProfileBasis {
    /// Harmonics of a revolute joint: `cos(k q)` and `sin(k q)`, k from 1.
    Turn,
    /// Harmonics of a prismatic joint over its travel from a to b: `cos(k π (q − a)/(b − a))`, k
    /// from 1.
    Travel([f64; 2]),
}

impl ProfileBasis {
    /// Largest number of cycles per turn, and of half cycles over a travel.
    pub const CYCLES: usize = 64;

    /// Returns the number of functions of each number of cycles.
    pub(super) fn phases(self) -> usize {
        match self {
            Self::Turn => 2,
            Self::Travel(_) => 1,
        }
    }

    /// Evaluates the functions at a joint value, in rad or the length unit.
    ///
    /// `(cos kφ, sin kφ)` follow from the angle addition theorems, one multiplication of complex
    /// numbers each.
    pub(super) fn fill(self, q: f64, values: &mut [f64]) {
        let angle = match self {
            Self::Turn => q,
            Self::Travel([from, to]) => PI * (q - from) / (to - from),
        };
        let (sine, cosine) = angle.sin_cos();
        let (mut c, mut s) = (1.0, 0.0);
        for cycle in values.chunks_exact_mut(self.phases()) {
            (c, s) = (c * cosine - s * sine, c * sine + s * cosine);
            cycle.copy_from_slice(&[c, s][..cycle.len()]);
        }
    }
}

#[cfg(test)]
mod tests;
