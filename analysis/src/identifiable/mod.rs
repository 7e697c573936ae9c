//! The number of combinations of the generalized errors that measurements can identify.
//!
//! The parts of a chain with separate joints.

mod in_parts;

pub use in_parts::identifiable_in_parts;

use core::ops::Range;

use abbe_core::{Component, Error, Manipulator, Pose, Quantity, twist};
use abbe_kinematics::decompose::singular_values;
use nalgebra::DMatrix;

use super::{Configuration, Unevaluated, sampling};

/// Relative singular value at or below which a value counts as zero.
pub const RANK_THRESHOLD: f64 = 1e-9;

/// Largest entry, in arm lengths and rad, of a column that is zero up to rounding errors, as for a
/// rotation about the tool point.
const ROUNDING: f64 = 1e-13;

/// Quantity measured at every configuration.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Measurement {
    /// Pose of the tool point: six rows. Three targets not in line are equivalent.
    Pose,
    /// Tool point alone: three rows.
    Point,
}

impl Measurement {
    /// Returns the number of measured rows of a twist.
    fn rows(self) -> usize {
        match self {
            Self::Pose => 6,
            Self::Point => 3,
        }
    }
}

/// Rank of the stacked error Jacobians.
#[derive(Clone, Debug, PartialEq)]
pub struct Identifiability {
    /// Number of identifiable combinations of the unknowns.
    pub rank: usize,
    /// Number of unknowns: 6 per frame, and 6 for the base frame if included.
    pub unknowns: usize,
    /// Singular values, largest first, of the matrix with columns of unit length, or of the
    /// matrices of all parts. The rank is the number of values above [`RANK_THRESHOLD`] times the
    /// first.
    pub singular_values: Vec<f64>,
}

impl Identifiability {
    /// Counts singular values, in any order.
    fn new(unknowns: usize, mut singular_values: Vec<f64>) -> Self {
        singular_values.sort_by(|a, b| b.total_cmp(a));
        let threshold = singular_values.first().map_or(0.0, |largest| largest * RANK_THRESHOLD);
        let rank = singular_values.iter().filter(|&&value| value > threshold).count();
        Self { rank, unknowns, singular_values }
    }

    /// Returns the smallest singular value above the threshold and the largest below it. A gap of
    /// many orders of magnitude makes the rank certain.
    pub fn gap(&self) -> (Option<f64>, Option<f64>) {
        let last = self.rank.checked_sub(1).and_then(|i| self.singular_values.get(i));
        (last.copied(), self.singular_values.get(self.rank).copied())
    }
}

/// Computes how many of the errors `ε` are identifiable by measurements at these configurations.
/// With `base`, the errors of a frame `E_0` at `F_0` are included.
///
/// Take the configurations from [`joint_samples`](super::joint_samples) with the joints that will
/// be moved; about 50 determine the rank of any arm. Columns are normalized, so that mm and rad
/// have the same weight. Configurations where loops do not close are left out. The work is
/// proportional to the number of configurations and to the square of the number of frames; use
/// [`identifiable_in_parts`] for long chains.
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

    // Only the triangle R of the stack's QR decomposition is kept: same singular values, bounded
    // memory. At least as many rows as R has are added between two decompositions, so that R does
    // not dominate the work.
    let count = (unknowns / rows).max(super::BLOCK);
    let mut triangle = DMatrix::<f64>::zeros(0, unknowns);
    let mut columns = vec![[0.0; 6]; own];
    for (b, block) in configurations.chunks(count).enumerate() {
        let above = triangle.nrows();
        let mut stack = triangle.resize_vertically(above + rows * block.len(), 0.0);
        for (i, Configuration { q, s, .. }) in block.iter().enumerate() {
            let index = Some(b * count + i);
            let pose = match manipulator.error_jacobian(q, s, &mut columns) {
                Err(error) if error.is_open() => continue,
                pose => pose.map_err(|error| at(index, error))?,
            };
            let own = columns.iter().map(|column| twist(description.orientation, &pose, column));
            let base = Component::ALL.iter().filter(|_| base).map(|c| base_column(*c, &pose));
            for (j, column) in own.chain(base).enumerate() {
                for k in 0..rows {
                    // Lengths in arm lengths, so that position and orientation rows are comparable.
                    let value = if k < 3 { column[k] / arm } else { column[k] };
                    if !value.is_finite() {
                        return Err(at(index, Error::NotFinite { quantity: Quantity::Jacobian, index: j }));
                    }
                    stack[(above + rows * i + k, j)] = value;
                }
            }
        }
        let moving = moving(&stack);
        let reduced = stack.select_columns(&moving).qr().r();
        triangle = DMatrix::zeros(reduced.nrows(), unknowns);
        for (column, j) in reduced.column_iter().zip(moving) {
            triangle.set_column(j, &column);
        }
    }

    let noise = ROUNDING * ((rows * configurations.len()) as f64).sqrt();
    for mut column in triangle.column_iter_mut() {
        let norm = column.norm();
        if norm > noise {
            column /= norm;
        }
    }
    let columns = triangle.select_columns(&moving(&triangle));
    let mut values = singular_values(columns).ok_or_else(|| at(None, not_finite()))?;
    values.resize(unknowns, 0.0);
    Ok(Identifiability::new(unknowns, values))
}

/// Returns the indices of the columns that are not zero. Frames that do not carry the tool, such as
/// another arm, have columns of zeros, which a decomposition need not touch.
fn moving(matrix: &DMatrix<f64>) -> Vec<usize> {
    (0..matrix.ncols()).filter(|j| matrix.column(*j).iter().any(|entry| *entry != 0.0)).collect()
}

/// Returns the error of a matrix that is not finite or whose decomposition does not converge.
fn not_finite() -> Error {
    Error::NotFinite { quantity: Quantity::Jacobian, index: 0 }
}

/// Returns the column of an error of `E_0`: `(e; 0)` for a translation, `(a × p_T; a)` for a
/// rotation.
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

/// Partition of the transforms `A_1 … A_n, T` into consecutive parts that share no joint variables.
///
/// Each transform is a part of its own if every joint moves one frame.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Parts {
    /// Ranges of `A_1 … A_n, T`, from 0, without gaps.
    ranges: Vec<Range<usize>>,
}

impl Parts {
    /// Partitions a chain, given the joint variables on which each of `A_1 … A_n` and `T` depends.
    ///
    /// ```
    /// use abbe::analysis::Parts;
    /// // q0 moves A_1, q1 moves A_2 and A_3, nothing moves the tool.
    /// let parts = Parts::new(&[vec![0], vec![1], vec![2, 1], vec![]]);
    /// assert_eq!((parts.count(), parts.longest()), (3, 2));
    /// ```
    pub fn new(depends: &[Vec<usize>]) -> Self {
        let variables = depends.iter().flatten().max().map_or(0, |last| last + 1);
        let mut last = vec![0; variables];
        for (transform, used) in depends.iter().enumerate() {
            used.iter().for_each(|variable| last[*variable] = transform);
        }
        let mut ranges = Vec::new();
        let (mut first, mut end) = (0, 0);
        for (transform, used) in depends.iter().enumerate() {
            end = used.iter().map(|variable| last[*variable] + 1).fold(end.max(transform + 1), usize::max);
            if end == transform + 1 {
                ranges.push(first..end);
                first = end;
            }
        }
        Self { ranges }
    }

    /// Returns the number of parts.
    pub fn count(&self) -> usize {
        self.ranges.len()
    }

    /// Returns the number of transforms of the longest part.
    pub fn longest(&self) -> usize {
        self.ranges.iter().map(Range::len).max().unwrap_or(0)
    }

    /// Returns the number of transforms.
    fn transforms(&self) -> usize {
        self.ranges.last().map_or(0, |range| range.end)
    }
}
