//! How an orientation is written.

use super::column::Column;

/// Which number of a quaternion comes first.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Order {
    /// The scalar.
    Wxyz,
    /// The vector.
    Xyzw,
}

/// The columns of an orientation.
#[derive(Clone, Debug)]
pub enum Turn {
    /// A quaternion.
    Quaternion(Box<[Column; 4]>, Order),
    /// A rotation matrix, row by row.
    Matrix(Box<[Column; 9]>),
    /// Angles: times the factor are rad; the axes (0 = x) in the order of the product.
    Euler(Box<[Column; 3]>, [usize; 3], f64),
}

impl Turn {
    pub(super) fn columns(&self) -> &[Column] {
        match self {
            Self::Quaternion(columns, _) => &columns[..],
            Self::Matrix(columns) => &columns[..],
            Self::Euler(columns, ..) => &columns[..],
        }
    }
}
