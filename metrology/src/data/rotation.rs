//! Conversion between rotations and their representations in files.

use nalgebra::{Matrix3, Quaternion, Rotation3, UnitQuaternion, Vector3};

use super::turn::{Order, Turn};

/// Columns of a rotation matrix.
pub(crate) type Rotation = [[f64; 3]; 3];

/// Converts numbers to a rotation, or returns the reason of the failure.
pub(crate) fn from_numbers(turn: &Turn, numbers: &[f64]) -> Result<Rotation, String> {
    match turn {
        Turn::Quaternion(_, order) => {
            let [a, b, c, d] = numbers.try_into().unwrap_or([0.0; 4]);
            match order {
                Order::Wxyz => from_quaternion(&[a, b, c, d]),
                Order::Xyzw => from_quaternion(&[d, a, b, c]),
            }
        }
        Turn::Matrix(_) => {
            let column = |j: usize| [numbers[j], numbers[3 + j], numbers[6 + j]];
            let r = [column(0), column(1), column(2)];
            if is_rotation(&r, 0.01) { Ok(r) } else { Err("the matrix is not a rotation".to_owned()) }
        }
        Turn::Euler(_, axes, factor) => Ok(from_euler(*axes, [0, 1, 2].map(|i| numbers[i] * factor))),
        Turn::RotationVector(_, factor) => Ok(from_rotation_vector([0, 1, 2].map(|i| numbers[i] * factor))),
    }
}

/// Returns whether columns are orthonormal to a tolerance, and right-handed.
pub(crate) fn is_rotation(r: &Rotation, tolerance: f64) -> bool {
    let r = Matrix3::from(*r);
    (r.transpose() * r - Matrix3::identity()).amax() < tolerance && r.determinant() > 0.0
}

/// Returns `R_a R_b R_c` for three angles in rad about these axes, 0 = x.
pub(crate) fn from_euler(axes: [usize; 3], angles: [f64; 3]) -> Rotation {
    let turns = axes.into_iter().zip(angles);
    let turns = turns.map(|(axis, angle)| Rotation3::from_axis_angle(&Vector3::ith_axis(axis), angle));
    turns.fold(Rotation3::identity(), |product, turn| product * turn).into_inner().into()
}

/// Returns the rotation of a rotation vector in rad.
pub(crate) fn from_rotation_vector(vector: [f64; 3]) -> Rotation {
    Rotation3::new(Vector3::from(vector)).into_inner().into()
}

/// Returns the rotation of a quaternion w x y z, or the reason of the failure.
pub(crate) fn from_quaternion(numbers: &[f64]) -> Result<Rotation, String> {
    let [w, x, y, z] = numbers.try_into().unwrap_or([0.0; 4]);
    let quaternion = Quaternion::new(w, x, y, z);
    let length = quaternion.norm();
    match (0.99..1.01).contains(&length) {
        true => Ok(UnitQuaternion::new_normalize(quaternion).to_rotation_matrix().into_inner().into()),
        false => Err(format!("the quaternion has length {length:.3}, not 1")),
    }
}

/// Converts a rotation to the numbers of its representation.
pub(crate) fn to_numbers(turn: &Turn, r: &Rotation) -> Vec<f64> {
    match turn {
        Turn::Quaternion(_, order) => {
            let [w, x, y, z] = quaternion(r);
            match order {
                Order::Wxyz => vec![w, x, y, z],
                Order::Xyzw => vec![x, y, z, w],
            }
        }
        Turn::Matrix(_) => (0..9).map(|k| r[k % 3][k / 3]).collect(),
        Turn::Euler(_, axes, factor) => euler(r, *axes).map(|angle| angle / factor).to_vec(),
        Turn::RotationVector(_, factor) => {
            unit_quaternion(r).scaled_axis().iter().map(|v| v / factor).collect()
        }
    }
}

/// Returns the quaternion w x y z of a rotation.
pub(crate) fn quaternion(r: &Rotation) -> [f64; 4] {
    let [x, y, z, w] = unit_quaternion(r).coords.into();
    [w, x, y, z]
}

fn unit_quaternion(r: &Rotation) -> UnitQuaternion<f64> {
    UnitQuaternion::from_rotation_matrix(&Rotation3::from_matrix_unchecked(Matrix3::from(*r)))
}

/// Returns the angles of `R_a R_b R_c`; consecutive axes differ.
fn euler(r: &Rotation, [a, b, c]: [usize; 3]) -> [f64; 3] {
    let sign = if (a + 1) % 3 == b { 1.0 } else { -1.0 };
    // Entries are r[column][row].
    if a == c {
        let other = 3 - a - b;
        // R_aa = cos of the middle angle.
        let middle = r[a][b].hypot(r[a][other]).atan2(r[a][a]);
        return [r[a][b].atan2(-sign * r[a][other]), middle, r[b][a].atan2(sign * r[other][a])];
    }
    // R_ac = ± sin of the middle angle.
    let middle = (sign * r[c][a]).clamp(-1.0, 1.0).asin();
    [(-sign * r[c][b]).atan2(r[c][c]), middle, (-sign * r[b][a]).atan2(r[a][a])]
}

#[cfg(test)]
mod tests;
