//! Representations of an orientation.

use super::column::Column;

/// Order of the numbers of a quaternion.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Order {
    /// Scalar first.
    Wxyz,
    /// Scalar last.
    Xyzw,
}

/// Orders of axes, 0 = x, without equal consecutive axes.
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

/// Columns of an orientation.
#[derive(Clone, Debug)]
pub enum Turn {
    /// A quaternion.
    Quaternion(Box<[Column; 4]>, Order),
    /// A rotation matrix, in row-major order.
    Matrix(Box<[Column; 9]>),
    /// Three angles, their axes (0 = x) in the order of the product, and the factor to rad.
    Euler(Box<[Column; 3]>, [usize; 3], f64),
    /// A rotation vector, and the factor to rad.
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
