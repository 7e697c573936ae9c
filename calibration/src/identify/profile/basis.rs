//! Functions of a joint of which its profile is a sum.

use core::f64::consts::PI;

use crate::identify::Unknown;

/// Highest number of periods per turn, and of half periods over a travel.
const HIGHEST: usize = 64;

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
}

impl ProfileJoint {
    /// Evaluates the functions at a joint value, or at the end of the range beyond it.
    pub(super) fn fill(&self, q: f64, values: &mut [f64]) {
        let [from, to] = self.range;
        self.basis.fill(q.max(from).min(to), values);
    }

    /// Returns the functions at a joint value, or at the end of the range beyond it.
    pub(super) fn values(&self, q: f64) -> Vec<f64> {
        let mut values = vec![0.0; self.basis.count()];
        self.fill(q, &mut values);
        values
    }
}

/// Functions of a joint.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ProfileBasis {
    /// Harmonics of a revolute joint: `cos(k q)` and `sin(k q)`, k from 1 to 64.
    Turn,
    /// Harmonics of a prismatic joint over its travel from a to b: `cos(k π (q − a)/(b − a))`, k
    /// from 1 to 64.
    Travel([f64; 2]),
}

impl ProfileBasis {
    /// Returns the number of functions.
    pub fn count(self) -> usize {
        match self {
            Self::Turn => 2 * HIGHEST,
            Self::Travel(_) => HIGHEST,
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
        for k in 0..HIGHEST {
            (c, s) = (c * cosine - s * sine, c * sine + s * cosine);
            match self {
                Self::Turn => [values[2 * k], values[2 * k + 1]] = [c, s],
                Self::Travel(_) => values[k] = c,
            }
        }
    }
}

#[cfg(test)]
mod tests;
