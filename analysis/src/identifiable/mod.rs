//! How many combinations of the generalized errors a set of measurements can tell apart.

mod in_parts;
mod parts;

use nalgebra::DMatrix;

use super::decompose::singular_values;
use super::{Configuration, Unevaluated, sampling};
use abbe_core::twist;
use abbe_core::{Component, Error, Manipulator, Pose, Quantity};

pub use in_parts::identifiable_in_parts;
pub use parts::Parts;

/// Singular values at or below this share of the largest count as zero.
pub const RANK_THRESHOLD: f64 = 1e-9;

/// A column whose entries are no larger, in arm lengths and rad, is zero but for rounding: of a rotation about the tool point.
const ROUNDING: f64 = 1e-13;

/// What is measured at every configuration.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Measurement {
    /// The pose of the tool point: six rows. Three targets that are not in line say the same.
    Pose,
    /// The tool point alone: three rows.
    Point,
}

impl Measurement {
    /// How many rows of a twist it sees.
    fn rows(self) -> usize {
        match self {
            Self::Pose => 6,
            Self::Point => 3,
        }
    }
}

/// The rank of the stacked error Jacobians.
#[derive(Clone, Debug, PartialEq)]
pub struct Identifiability {
    /// How many combinations of the unknowns the measurements determine.
    pub rank: usize,
    /// How many unknowns there are: 6 per frame, and 6 of the base frame if asked for.
    pub unknowns: usize,
    /// All singular values, largest first, of the matrix with columns of unit length, or of the matrices of all parts. The
    /// rank is theirs above [`RANK_THRESHOLD`] times the first.
    pub singular_values: Vec<f64>,
}

impl Identifiability {
    /// In any order.
    fn new(unknowns: usize, mut singular_values: Vec<f64>) -> Self {
        singular_values.sort_by(|a, b| b.total_cmp(a));
        let threshold = singular_values.first().map_or(0.0, |largest| largest * RANK_THRESHOLD);
        let rank = singular_values.iter().filter(|&&value| value > threshold).count();
        Self { rank, unknowns, singular_values }
    }

    /// The smallest singular value that counts and the largest that does not: a gap of many orders of
    /// magnitude says that the rank is certain.
    pub fn gap(&self) -> (Option<f64>, Option<f64>) {
        let last = self.rank.checked_sub(1).and_then(|i| self.singular_values.get(i));
        (last.copied(), self.singular_values.get(self.rank).copied())
    }
}

/// How many of the errors `ε` (with `base`, also those of a frame `E_0` at `F_0`) can be told apart by
/// measuring at these configurations.
///
/// Take them from [`joint_samples`](super::joint_samples) with the joints that will be moved; some 50
/// show the rank of any arm. Columns are normalized, so that mm and rad weigh the same. The work grows with the number
/// of configurations and the square of the number of frames; [`identifiable_in_parts`] counts what long chains have.
pub fn identifiable(
    manipulator: &dyn Manipulator,
    configurations: &[Configuration],
    measurement: Measurement,
    base: bool,
) -> Result<Identifiability, Unevaluated> {
    let at = |configuration, error| Unevaluated { configuration, error };
    let description = manipulator.description();
    let nominal = sampling::nominal_parameters(description);
    let arm = sampling::arm_length(manipulator, &nominal).map_err(|error| at(None, error))?;
    let own = 6 * description.frames.len();
    let unknowns = own + if base { 6 } else { 0 };
    let rows = measurement.rows();

    // Only the triangle R of the stack's QR decomposition is kept: same singular values, bounded memory. At least as many
    // rows as it has come between two decompositions: otherwise most of the work would be the triangle's own.
    let count = (unknowns / rows).max(super::BLOCK);
    let mut triangle = DMatrix::<f64>::zeros(0, unknowns);
    let mut columns = vec![[0.0; 6]; own];
    for (b, block) in configurations.chunks(count).enumerate() {
        let above = triangle.nrows();
        let mut stack = triangle.resize_vertically(above + rows * block.len(), 0.0);
        for (i, Configuration { q, s, .. }) in block.iter().enumerate() {
            let index = Some(b * count + i);
            let pose = manipulator.error_jacobian(q, s, &mut columns).map_err(|error| at(index, error))?;
            let own = columns.iter().map(|column| twist(description.orientation, &pose, column));
            let base = Component::ALL.iter().filter(|_| base).map(|c| base_column(*c, &pose));
            for (j, column) in own.chain(base).enumerate() {
                for k in 0..rows {
                    // Lengths in arm lengths, so that position and orientation rows compare.
                    let value = if k < 3 { column[k] / arm } else { column[k] };
                    if !value.is_finite() {
                        let error = Error::NotFinite { quantity: Quantity::Jacobian, index: j };
                        return Err(at(index, error));
                    }
                    stack[(above + rows * i + k, j)] = value;
                }
            }
        }
        triangle = if stack.is_empty() { stack } else { stack.qr().r() };
    }

    let noise = ROUNDING * ((rows * configurations.len()) as f64).sqrt();
    for mut column in triangle.column_iter_mut() {
        let norm = column.norm();
        if norm > noise {
            column /= norm;
        }
    }
    let values = singular_values(triangle).ok_or_else(|| at(None, not_finite()))?;
    Ok(Identifiability::new(unknowns, values))
}

/// What is not a number, or takes more steps than any matrix of numbers.
fn not_finite() -> Error {
    Error::NotFinite { quantity: Quantity::Jacobian, index: 0 }
}

/// The column of an error of `E_0`: `(e; 0)` for a translation, `(a × p_T; a)` for a rotation.
fn base_column(component: Component, pose: &Pose) -> [f64; 6] {
    let axis = component.axis();
    let mut column = [0.0; 6];
    if component.is_rotation() {
        let (next, last) = ((axis + 1) % 3, (axis + 2) % 3);
        let point = pose.position();
        column[next] = -point[last];
        column[last] = point[next];
        column[3 + axis] = 1.0;
    } else {
        column[axis] = 1.0;
    }
    column
}
