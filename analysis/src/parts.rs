//! Errors that several sources are parts of: balls, discs, and the uncertainty of a calibration.
//!
//! The parts have the displacements `B = [b_1 b_2 …]` at their bounds, and the error is `B x` with
//! any `‖x‖ ≤ 1`. It is at most `√(B Bᵀ)_ii` along a row, and its norm at most the largest
//! singular value of B.
//!
//! Measurands: the position of the tool point, and the orientation of the tool.

use abbe_core::{Description, Distribution};
use abbe_kinematics::sampling::{draw, draw_parts, norm};
use rand::Rng;

use crate::normal::Principal;

/// Parts of the errors of a manipulator.
#[derive(Clone, Debug)]
pub struct ErrorParts {
    /// Sources of each error, by the index of its first one; of another source, none.
    of: Vec<Vec<usize>>,
}

impl ErrorParts {
    /// Finds the parts.
    pub fn new(description: &Description) -> Self {
        let mut of = vec![Vec::new(); description.sources.len()];
        (0..of.len()).for_each(|k| of[description.whole(k)].push(k));
        Self { of }
    }

    /// Returns the sources that are parts of the error of a source, itself first; none of a source
    /// that is a part of another's error.
    pub fn parts_of(&self, source: usize) -> &[usize] {
        &self.of[source]
    }

    /// Iterates over the errors with several parts.
    pub fn with_parts(&self) -> impl Iterator<Item = &[usize]> {
        self.of.iter().filter(|parts| parts.len() > 1).map(Vec::as_slice)
    }

    /// Draws the error of a source of magnitude 1, and passes the indices and values of its parts
    /// to `put`: all of a ball at its first part, and none at the others.
    pub fn draw(
        &self,
        source: usize,
        distribution: Distribution,
        random: &mut impl Rng,
        mut put: impl FnMut(usize, f64),
    ) {
        match distribution {
            Distribution::Ball { part: 1.., .. } => {}
            Distribution::Ball { .. } => {
                let drawn = draw_parts(distribution, random);
                self.parts_of(source).iter().zip(drawn).for_each(|(part, value)| put(*part, value));
            }
            _ => put(source, draw(distribution, random)),
        }
    }

    /// Returns the largest values along the rows of a measurand, and the largest norm, of the error
    /// of a source, given ΔX of all sources at their bounds. Rows of an error with one part keep
    /// their signs.
    pub fn largest(&self, source: usize, sources: &[[f64; 6]], measurand: Measurand) -> ([f64; 3], f64) {
        if let [own] = self.parts_of(source) {
            let rows = measurand.rows(&sources[*own]);
            return (rows, norm(rows));
        }
        let matrix = outer_sum(self.parts_of(source).iter().map(|part| measurand.rows(&sources[*part])));
        ([0, 1, 2].map(|i| matrix[i][i].sqrt()), longest(matrix))
    }
}

/// Returns `Σ b bᵀ`.
pub(crate) fn outer_sum(vectors: impl Iterator<Item = [f64; 3]>) -> [[f64; 3]; 3] {
    let mut sum = [[0.0; 3]; 3];
    for b in vectors {
        sum = core::array::from_fn(|i| core::array::from_fn(|j| sum[i][j] + b[i] * b[j]));
    }
    sum
}

/// Returns the largest singular value of B, given `B Bᵀ`.
pub(crate) fn longest(matrix: [[f64; 3]; 3]) -> f64 {
    Principal::new(matrix).deviations[0]
}

/// Half of the rows of ΔX.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Measurand {
    /// Rows 1–3: position of the tool point in `F_0`, in the length unit.
    Position,
    /// Rows 4–6: orientation as the manipulator's [`Orientation`](abbe_core::Orientation) says, in
    /// rad.
    Orientation,
}

impl Measurand {
    /// Position and orientation, in the order of the rows.
    pub const ALL: [Self; 2] = [Self::Position, Self::Orientation];

    /// Returns the index of the first row, from 0.
    pub const fn first(self) -> usize {
        match self {
            Self::Position => 0,
            Self::Orientation => 3,
        }
    }

    /// Returns the rows of a deviation.
    pub const fn rows(self, deviation: &[f64; 6]) -> [f64; 3] {
        let first = self.first();
        [deviation[first], deviation[first + 1], deviation[first + 2]]
    }
}
