//! What the numbers of a file mean.

use abbe::Pose;
use serde::Serialize;

use super::change::Change;
use crate::data::EULER_ORDERS;

/// How a pose is written.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Layout {
    /// x, y and z alone.
    Position,
    /// Where the tool should be, then the difference from where it is.
    Difference {
        /// Whether the difference is target − actual; actual − target if not.
        target_minus_actual: bool,
    },
    /// x, y, z and three angles.
    Euler {
        /// The axes, 0 = x, in the order of the columns.
        axes: [usize; 3],
        /// Whether the axes stay where they are; they turn with the tool if not: `R = R_1 R_2 R_3`.
        fixed: bool,
        /// Whether the angles are in degrees.
        degrees: bool,
    },
    /// x, y, z and an axis times its angle.
    RotationVector {
        /// Whether the angle is in degrees.
        degrees: bool,
    },
    /// x, y, z and a quaternion.
    Quaternion {
        /// Whether the scalar stands first.
        scalar_first: bool,
    },
    /// x, y, z and a rotation matrix.
    Matrix {
        /// Whether it stands row by row; column by column if not.
        by_rows: bool,
    },
    /// The upper three rows, or all four, of a homogeneous matrix.
    Homogeneous {
        /// Whether it stands row by row; column by column if not.
        by_rows: bool,
    },
}

/// What the numbers of a file mean.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Reading {
    /// Whether angles of joints are in degrees; none if no joint turns.
    pub joints_in_degrees: Option<bool>,
    /// The unit of joints that slide; none if none does.
    pub slides_in: Option<&'static str>,
    /// The unit of positions.
    pub lengths_in: &'static str,
    /// How poses are written.
    pub layout: Layout,
    /// What is other than the spec has it.
    pub changes: Vec<Change>,
}

/// All layouts of so many numbers.
pub(super) fn layouts(count: usize) -> Vec<Layout> {
    match count {
        3 => vec![Layout::Position],
        6 => {
            let mut all: Vec<Layout> =
                [true, false].map(|target_minus_actual| Layout::Difference { target_minus_actual }).to_vec();
            for degrees in [true, false] {
                all.push(Layout::RotationVector { degrees });
                for fixed in [false, true] {
                    all.extend(EULER_ORDERS.map(|(_, axes)| Layout::Euler { axes, fixed, degrees }));
                }
            }
            all
        }
        7 => [true, false].map(|scalar_first| Layout::Quaternion { scalar_first }).to_vec(),
        12 => [true, false]
            .into_iter()
            .flat_map(|by_rows| [Layout::Matrix { by_rows }, Layout::Homogeneous { by_rows }])
            .collect(),
        16 => [true, false].map(|by_rows| Layout::Homogeneous { by_rows }).to_vec(),
        _ => Vec::new(),
    }
}

impl Layout {
    /// Whether it has an orientation.
    pub(super) fn is_oriented(self) -> bool {
        !matches!(self, Self::Position | Self::Difference { .. })
    }

    /// The pose of a row, lengths times a factor; none if the numbers are no rotation.
    pub(super) fn pose(self, numbers: &[f64], factor: f64) -> Option<Pose> {
        let three = |at: usize| -> Option<[f64; 3]> { numbers.get(at..at + 3)?.try_into().ok() };
        let position = three(0)?.map(|x| x * factor);
        let [x, y, z] = match self {
            Self::Position => Pose::IDENTITY.axes(),
            Self::Difference { target_minus_actual } => {
                let sign = if target_minus_actual { -1.0 } else { 1.0 };
                let difference = three(3)?.map(|x| x * factor * sign);
                let actual = std::array::from_fn(|i| position[i] + difference[i]);
                return Some(Pose([[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0], actual]));
            }
            Self::Euler { axes, fixed, degrees } => {
                let angles = three(3)?.map(|angle| in_rad(angle, degrees));
                let turns = [0, 1, 2].map(|i| about(axes[i], angles[i]));
                let [a, b, c] =
                    if fixed { [&turns[2], &turns[1], &turns[0]] } else { [&turns[0], &turns[1], &turns[2]] };
                a.then(b).then(c).axes()
            }
            Self::RotationVector { degrees } => {
                turned_by(three(3)?.map(|angle| in_rad(angle, degrees))).axes()
            }
            Self::Quaternion { scalar_first } => {
                let four: [f64; 4] = numbers.get(3..7)?.try_into().ok()?;
                let [w, x, y, z] = if scalar_first { four } else { [four[3], four[0], four[1], four[2]] };
                quaternion([w, x, y, z])?
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

/// The three columns of the rotation.
trait Axes {
    fn axes(&self) -> [[f64; 3]; 3];
}

impl Axes for Pose {
    fn axes(&self) -> [[f64; 3]; 3] {
        let [x, y, z, _] = self.0;
        [x, y, z]
    }
}

fn in_rad(angle: f64, degrees: bool) -> f64 {
    if degrees { angle.to_radians() } else { angle }
}

fn about(axis: usize, angle: f64) -> Pose {
    let (s, c) = angle.sin_cos();
    let (next, last) = ((axis + 1) % 3, (axis + 2) % 3);
    let mut columns = [[0.0; 3]; 4];
    columns[axis][axis] = 1.0;
    (columns[next][next], columns[next][last]) = (c, s);
    (columns[last][next], columns[last][last]) = (-s, c);
    Pose(columns)
}

/// By Rodrigues' formula.
fn turned_by(vector: [f64; 3]) -> Pose {
    let angle = vector.iter().map(|x| x * x).sum::<f64>().sqrt();
    if angle == 0.0 {
        return Pose::IDENTITY;
    }
    let [x, y, z] = vector.map(|v| v / angle);
    let (s, c) = angle.sin_cos();
    let v = 1.0 - c;
    Pose([
        [x * x * v + c, x * y * v + z * s, x * z * v - y * s],
        [x * y * v - z * s, y * y * v + c, y * z * v + x * s],
        [x * z * v + y * s, y * z * v - x * s, z * z * v + c],
        [0.0; 3],
    ])
}

fn quaternion(four: [f64; 4]) -> Option<[[f64; 3]; 3]> {
    let length = four.iter().map(|x| x * x).sum::<f64>().sqrt();
    if !(0.99..1.01).contains(&length) {
        return None;
    }
    let [w, x, y, z] = four.map(|v| v / length);
    Some([
        [1.0 - 2.0 * (y * y + z * z), 2.0 * (x * y + w * z), 2.0 * (x * z - w * y)],
        [2.0 * (x * y - w * z), 1.0 - 2.0 * (x * x + z * z), 2.0 * (y * z + w * x)],
        [2.0 * (x * z + w * y), 2.0 * (y * z - w * x), 1.0 - 2.0 * (x * x + y * y)],
    ])
}

fn transposed(m: [[f64; 3]; 3]) -> [[f64; 3]; 3] {
    std::array::from_fn(|i| std::array::from_fn(|j| m[j][i]))
}

/// The columns, if they are those of a rotation to the digits that files have.
fn rotation(columns: [[f64; 3]; 3]) -> Option<[[f64; 3]; 3]> {
    let dot = |a: [f64; 3], b: [f64; 3]| a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    let [a, b, c] = columns;
    let cross = [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
    let right = [dot(a, a), dot(b, b), dot(c, c), dot(cross, c)].iter().all(|x| (x - 1.0).abs() < 0.02);
    let square = [dot(a, b), dot(b, c), dot(c, a)].iter().all(|x| x.abs() < 0.02);
    (right && square).then_some(columns)
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
