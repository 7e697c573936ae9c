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

/// The orders of axes, 0 = x, in which no axis follows itself.
pub(crate) const EULER_ORDERS: [(&str, [usize; 3]); 12] = [
    ("xyz", [0, 1, 2]),
    ("xzy", [0, 2, 1]),
    ("yxz", [1, 0, 2]),
    ("yzx", [1, 2, 0]),
    ("zxy", [2, 0, 1]),
    ("zyx", [2, 1, 0]),
    ("xyx", [0, 1, 0]),
    ("xzx", [0, 2, 0]),
    ("yxy", [1, 0, 1]),
    ("yzy", [1, 2, 1]),
    ("zxz", [2, 0, 2]),
    ("zyz", [2, 1, 2]),
];

/// The columns of an orientation.
#[derive(Clone, Debug)]
pub enum Turn {
    /// A quaternion.
    Quaternion(Box<[Column; 4]>, Order),
    /// A rotation matrix, row by row.
    Matrix(Box<[Column; 9]>),
    /// Angles: times the factor are rad; the axes (0 = x) in the order of the product.
    Euler(Box<[Column; 3]>, [usize; 3], f64),
    /// An axis times its angle: times the factor in rad.
    RotationVector(Box<[Column; 3]>, f64),
}

impl Turn {
    pub(super) fn columns(&self) -> &[Column] {
        match self {
            Self::Quaternion(columns, _) => &columns[..],
            Self::Matrix(columns) => &columns[..],
            Self::Euler(columns, ..) | Self::RotationVector(columns, _) => &columns[..],
        }
    }
}
