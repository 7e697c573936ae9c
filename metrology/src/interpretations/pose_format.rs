//! Formats in which the numbers of a row can give a position or a pose.

use abbe::Pose;
use serde::Serialize;

use crate::data::{EULER_ORDERS, Rotation, from_euler, from_quaternion, from_rotation_vector, is_rotation};

/// Tolerance of the test that numbers are a rotation matrix.
const MATRIX: f64 = 0.02;

/// Format of a pose.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum PoseFormat {
    /// Position x, y, z.
    Position,
    /// Target position followed by a position difference.
    Difference {
        /// Is true if the difference is target − actual, false for actual − target.
        target_minus_actual: bool,
    },
    /// Position and three angles.
    Euler {
        /// Axes, 0 = x, in the order of the columns.
        axes: [usize; 3],
        /// Is true for fixed axes, false for moving axes: `R = R_1 R_2 R_3`.
        fixed: bool,
        /// Is true if the angles are in degrees, false for radians.
        degrees: bool,
    },
    /// Position and a rotation vector (axis times angle).
    RotationVector {
        /// Is true if the angle is in degrees, false for radians.
        degrees: bool,
    },
    /// Position and a quaternion.
    Quaternion {
        /// Is true if the scalar is the first component, false for the last.
        scalar_first: bool,
    },
    /// Position and a rotation matrix.
    Matrix {
        /// Is true for row-major order, false for column-major.
        by_rows: bool,
    },
    /// Upper three rows, or all four, of a homogeneous matrix.
    Homogeneous {
        /// Is true for row-major order, false for column-major.
        by_rows: bool,
    },
}

impl PoseFormat {
    /// Returns all formats with `count` numbers.
    pub(crate) fn all(count: usize) -> Vec<Self> {
        match count {
            3 => vec![Self::Position],
            6 => {
                let mut all: Vec<Self> = [true, false]
                    .map(|target_minus_actual| Self::Difference { target_minus_actual })
                    .to_vec();
                for degrees in [true, false] {
                    all.push(Self::RotationVector { degrees });
                    for fixed in [false, true] {
                        all.extend(EULER_ORDERS.map(|(_, axes)| Self::Euler { axes, fixed, degrees }));
                    }
                }
                all
            }
            7 => [true, false].map(|scalar_first| Self::Quaternion { scalar_first }).to_vec(),
            12 => [true, false]
                .into_iter()
                .flat_map(|by_rows| [Self::Matrix { by_rows }, Self::Homogeneous { by_rows }])
                .collect(),
            16 => [true, false].map(|by_rows| Self::Homogeneous { by_rows }).to_vec(),
            _ => Vec::new(),
        }
    }

    /// Returns true if the format contains an orientation.
    pub(crate) fn is_oriented(self) -> bool {
        !matches!(self, Self::Position | Self::Difference { .. })
    }

    /// Returns the pose of a row, with lengths multiplied by `factor`; none if the numbers are not
    /// a rotation.
    pub(crate) fn pose(self, numbers: &[f64], factor: f64) -> Option<Pose> {
        let three = |at: usize| -> Option<[f64; 3]> { numbers.get(at..at + 3)?.try_into().ok() };
        let position = three(0)?.map(|x| x * factor);
        let [x, y, z] = match self {
            Self::Position => identity(),
            Self::Difference { target_minus_actual } => {
                let sign = if target_minus_actual { -1.0 } else { 1.0 };
                let difference = three(3)?.map(|x| x * factor * sign);
                let [x, y, z] = identity();
                return Some(Pose([x, y, z, std::array::from_fn(|i| position[i] + difference[i])]));
            }
            Self::Euler { axes: [a, b, c], fixed, degrees } => {
                let [first, second, third] = three(3)?.map(|angle| in_rad(angle, degrees));
                match fixed {
                    true => from_euler([c, b, a], [third, second, first]),
                    false => from_euler([a, b, c], [first, second, third]),
                }
            }
            Self::RotationVector { degrees } => {
                from_rotation_vector(three(3)?.map(|angle| in_rad(angle, degrees)))
            }
            Self::Quaternion { scalar_first } => {
                let four: [f64; 4] = numbers.get(3..7)?.try_into().ok()?;
                let [w, x, y, z] = if scalar_first { four } else { [four[3], four[0], four[1], four[2]] };
                from_quaternion(&[w, x, y, z]).ok()?
            }
            Self::Matrix { by_rows } => {
                let nine = [three(3)?, three(6)?, three(9)?];
                rotation(if by_rows { transposed(nine) } else { nine })?
            }
            Self::Homogeneous { by_rows } => return homogeneous(numbers, by_rows, factor),
        };
        Some(Pose([x, y, z, position]))
    }
}

fn identity() -> Rotation {
    let [x, y, z, _] = Pose::IDENTITY.0;
    [x, y, z]
}

fn in_rad(angle: f64, degrees: bool) -> f64 {
    if degrees { angle.to_radians() } else { angle }
}

pub(super) fn transposed(m: Rotation) -> Rotation {
    std::array::from_fn(|i| std::array::from_fn(|j| m[j][i]))
}

fn rotation(columns: Rotation) -> Option<Rotation> {
    is_rotation(&columns, MATRIX).then_some(columns)
}

fn homogeneous(numbers: &[f64], by_rows: bool, factor: f64) -> Option<Pose> {
    let of_four = numbers.len() == 16;
    let entry = |i: usize, j: usize| match (by_rows, of_four) {
        (true, _) => numbers[4 * i + j],
        (false, true) => numbers[4 * j + i],
        (false, false) => numbers[3 * j + i],
    };
    let column = |j: usize| [entry(0, j), entry(1, j), entry(2, j)];
    let last = |j: usize| if by_rows { numbers[12 + j] } else { numbers[4 * j + 3] };
    if of_four && [0, 1, 2, 3].iter().any(|j| (last(*j) - f64::from(u8::from(*j == 3))).abs() > 1e-9) {
        return None;
    }
    let [x, y, z] = rotation([column(0), column(1), column(2)])?;
    Some(Pose([x, y, z, column(3).map(|x| x * factor)]))
}
