//! The columns of `J_e` from their distinct numbers: those that are neither zero nor repeated. The
//! layout is the same for every manipulator.
//!
//! The six columns of a frame with axes `x y z` have 36 numbers. Of these, 18 are distinct if rows
//! 4–6 are the small rotation, 27 if they are Euler angles (blank: zero):
//!
//! ```text
//!            e_x  e_y  e_z  e_s        e_r        e_p             numbers of a frame, three each
//! rows 1–3   x    y    z    moment     moment     moment          0 x   3 y   6 z   9, 12, 15 the moments
//! rows 4–6                  y          z          x               rotation vector: the axes again
//!                           18         21         24              Euler angles: numbers of their own
//! ```

use crate::{Component, Orientation, Scalar};

/// Returns the number of vectors of three distinct numbers in the six columns of a frame.
pub const fn vectors(orientation: Orientation) -> usize {
    match orientation {
        Orientation::RotationVector => 6,
        Orientation::EulerYzx | Orientation::Iec61217 => 9,
    }
}

/// Returns the number of vectors for a manipulator. In a tree of frames all columns are distinct:
/// each gives two vectors, rows 1–3 and rows 4–6.
pub fn vectors_of(description: &crate::Description) -> usize {
    if description.is_chain() { vectors(description.orientation) } else { VECTORS_OF_TREE }
}

/// Number of vectors for a frame of a tree.
pub const VECTORS_OF_TREE: usize = 12;

/// Returns the index, among the distinct numbers, of the entry of `J_e` in a row (0 to 5) and the
/// column of an error; `None` if the entry is zero.
///
/// ```
/// use abbe::{Component, Orientation, distinct};
///
/// // Row 4 (rotation about x) of the pitch is the x of the frame's x axis, number 0.
/// assert_eq!(distinct::number(Orientation::RotationVector, Component::Pitch, 3), Some(0));
/// assert_eq!(distinct::number(Orientation::EulerYzx, Component::Pitch, 3), Some(24));
/// assert_eq!(distinct::number(Orientation::EulerYzx, Component::X, 3), None);
/// ```
pub const fn number(orientation: Orientation, component: Component, row: usize) -> Option<usize> {
    let turn = component.index() % 3;
    match (component.is_rotation(), row < 3, orientation) {
        (false, true, _) => Some(3 * component.axis() + row),
        (false, false, _) => None,
        (true, true, _) => Some(9 + 3 * turn + row),
        (true, false, Orientation::RotationVector) => Some(3 * component.axis() + row - 3),
        (true, false, _) => Some(18 + 3 * turn + row - 3),
    }
}

/// Computes the columns of `J_e`, six per frame, from the distinct vectors of each frame. `D` is 6
/// or 9.
///
/// Frames beyond the end of either slice are left unchanged.
pub fn columns<T: Scalar, const D: usize>(distinct: &[[[T; 3]; D]], columns: &mut [[T; 6]]) {
    let orientation = const {
        match D {
            6 => Orientation::RotationVector,
            9 => Orientation::EulerYzx,
            _ => panic!("six vectors for a rotation vector, nine for Euler angles"),
        }
    };
    let zero = T::constant(0.0);
    for (numbers, six) in distinct.iter().zip(columns.chunks_exact_mut(6)) {
        for (component, column) in Component::ALL.into_iter().zip(six) {
            *column = core::array::from_fn(|row| {
                number(orientation, component, row).map_or(zero, |index| numbers[index / 3][index % 3])
            });
        }
    }
}

/// Receiver of the columns of `J_e`, one by one: stores all of their numbers, or only the distinct
/// ones.
///
/// Generated code passes every column once, in any order.
pub trait ErrorColumns<T> {
    /// Sets column `index`, the column of a translation along an axis of its frame.
    fn along(&mut self, index: usize, axis: [T; 3]);
    /// Sets rows 1–3 of column `index`, the column of a rotation: the velocity of the tool point.
    fn moment(&mut self, index: usize, moment: [T; 3]);
    /// Sets rows 4–6 of column `index`, the column of a rotation.
    fn turn(&mut self, index: usize, rows: [T; 3]);
}

impl<T: Scalar, const COLUMNS: usize> ErrorColumns<T> for [[T; 6]; COLUMNS] {
    #[inline(always)]
    fn along(&mut self, index: usize, [x, y, z]: [T; 3]) {
        let zero = T::constant(0.0);
        self[index] = [x, y, z, zero, zero, zero];
    }

    #[inline(always)]
    fn moment(&mut self, index: usize, [x, y, z]: [T; 3]) {
        self[index][..3].copy_from_slice(&[x, y, z]);
    }

    #[inline(always)]
    fn turn(&mut self, index: usize, [a, b, c]: [T; 3]) {
        self[index][3..].copy_from_slice(&[a, b, c]);
    }
}

impl<T: Scalar, const DISTINCT: usize, const FRAMES: usize> ErrorColumns<T> for [[[T; 3]; DISTINCT]; FRAMES] {
    #[inline(always)]
    fn along(&mut self, index: usize, axis: [T; 3]) {
        self[index / 6][index % 6] = axis;
    }

    #[inline(always)]
    fn moment(&mut self, index: usize, moment: [T; 3]) {
        self[index / 6][index % 6] = moment;
    }

    /// Stores Euler rows only: for rotation vectors rows 4–6 repeat an axis.
    #[inline(always)]
    fn turn(&mut self, index: usize, rows: [T; 3]) {
        if DISTINCT == 9 {
            self[index / 6][index % 6 + 3] = rows;
        }
    }
}
