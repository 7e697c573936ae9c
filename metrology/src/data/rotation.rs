//! Conversion between rotations and their representations in files.

use super::turn::{Order, Turn};

/// Columns of a rotation matrix.
pub(crate) type Rotation = [[f64; 3]; 3];

/// Converts numbers to a rotation, or returns the reason of the failure.
pub(super) fn from_numbers(turn: &Turn, numbers: &[f64]) -> Result<Rotation, String> {
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
        Turn::RotationVector(_, factor) => from_rotation_vector([0, 1, 2].map(|i| numbers[i] * factor)),
    }
}

/// Returns whether columns are orthonormal to a tolerance, and right-handed.
pub(crate) fn is_rotation(r: &Rotation, tolerance: f64) -> bool {
    let dot = |a: [f64; 3], b: [f64; 3]| a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    let [x, y, z] = *r;
    let cross = [x[1] * y[2] - x[2] * y[1], x[2] * y[0] - x[0] * y[2], x[0] * y[1] - x[1] * y[0]];
    (0..3).all(|i| (dot(r[i], r[i]) - 1.0).abs() < tolerance)
        && (0..3).all(|i| dot(r[i], r[(i + 1) % 3]).abs() < tolerance)
        && dot(cross, z) > 0.0
}

/// Returns `R_a R_b R_c` for three angles in rad about these axes, 0 = x.
pub(crate) fn from_euler(axes: [usize; 3], angles: [f64; 3]) -> Rotation {
    let turns = axes.into_iter().zip(angles).map(|(axis, angle)| about(axis, angle));
    turns.fold(about(0, 0.0), |product, turn| times(&product, &turn))
}

/// Returns the rotation of a rotation vector in rad, or the reason of the failure.
pub(crate) fn from_rotation_vector(vector: [f64; 3]) -> Result<Rotation, String> {
    let angle = length(vector);
    // sin(a/2) / a.
    let share = if angle > 0.0 { (0.5 * angle).sin() / angle } else { 0.5 };
    let [x, y, z] = vector.map(|v| v * share);
    from_quaternion(&[(0.5 * angle).cos(), x, y, z])
}

/// Returns the rotation of a quaternion w x y z, or the reason of the failure.
pub(crate) fn from_quaternion(numbers: &[f64]) -> Result<Rotation, String> {
    let [w, x, y, z] = numbers.try_into().unwrap_or([0.0; 4]);
    let length = (w * w + x * x + y * y + z * z).sqrt();
    if !(0.99..1.01).contains(&length) {
        return Err(format!("the quaternion has length {length:.3}, not 1"));
    }
    let [w, x, y, z] = [w, x, y, z].map(|v: f64| v / length);
    Ok([
        [1.0 - 2.0 * (y * y + z * z), 2.0 * (x * y + w * z), 2.0 * (x * z - w * y)],
        [2.0 * (x * y - w * z), 1.0 - 2.0 * (x * x + z * z), 2.0 * (y * z + w * x)],
        [2.0 * (x * z + w * y), 2.0 * (y * z - w * x), 1.0 - 2.0 * (x * x + y * y)],
    ])
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
        Turn::RotationVector(_, factor) => rotation_vector(r).map(|v| v / factor).to_vec(),
    }
}

fn about(axis: usize, angle: f64) -> Rotation {
    let (s, c) = angle.sin_cos();
    let (next, last) = ((axis + 1) % 3, (axis + 2) % 3);
    let mut r = [[0.0; 3]; 3];
    r[axis][axis] = 1.0;
    (r[next][next], r[next][last], r[last][next], r[last][last]) = (c, s, -s, c);
    r
}

fn times(a: &Rotation, b: &Rotation) -> Rotation {
    b.map(|column| std::array::from_fn(|i| (0..3).map(|k| a[k][i] * column[k]).sum()))
}

/// Returns the quaternion w x y z of a rotation.
pub(crate) fn quaternion(r: &Rotation) -> [f64; 4] {
    let trace = r[0][0] + r[1][1] + r[2][2];
    let largest = [trace, r[0][0], r[1][1], r[2][2]];
    let k = (0..4).max_by(|a, b| largest[*a].total_cmp(&largest[*b])).unwrap_or(0);
    let mut q = [0.0; 4];
    if k == 0 {
        let s = 2.0 * (1.0 + trace).sqrt();
        q = [s / 4.0, (r[1][2] - r[2][1]) / s, (r[2][0] - r[0][2]) / s, (r[0][1] - r[1][0]) / s];
    } else {
        let (i, j, l) = (k - 1, k % 3, (k + 1) % 3);
        let s = 2.0 * (1.0 + r[i][i] - r[j][j] - r[l][l]).sqrt();
        q[0] = (r[j][l] - r[l][j]) / s;
        q[1 + i] = s / 4.0;
        q[1 + j] = (r[i][j] + r[j][i]) / s;
        q[1 + l] = (r[i][l] + r[l][i]) / s;
    }
    q
}

/// Returns the rotation vector, with an angle of at most π.
fn rotation_vector(r: &Rotation) -> [f64; 3] {
    let [w, x, y, z] = quaternion(r);
    let sine = length([x, y, z]);
    let angle = 2.0 * sine.atan2(w.abs());
    let share = if sine > 0.0 { angle / sine } else { 2.0 };
    [x, y, z].map(|v| v * share * w.signum())
}

fn length([x, y, z]: [f64; 3]) -> f64 {
    x.hypot(y).hypot(z)
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
mod tests {
    use super::*;

    #[test]
    fn numbers_and_back() {
        let column = || super::super::column::Column { name: String::new(), span: None };
        let four = || Box::new([column(), column(), column(), column()]);
        let r = times(&times(&about(2, 0.7), &about(1, -0.4)), &about(0, 2.9));
        let nine = Box::new(std::array::from_fn(|_| column()));
        let three = || Box::new(std::array::from_fn(|_| column()));
        let turns = [
            Turn::Quaternion(four(), Order::Wxyz),
            Turn::Quaternion(four(), Order::Xyzw),
            Turn::Matrix(nine),
            Turn::Euler(three(), [2, 1, 0], 1.0),
            Turn::Euler(three(), [0, 1, 2], 0.5),
            Turn::Euler(three(), [1, 2, 0], 1.0),
            Turn::Euler(three(), [2, 1, 2], 1.0),
            Turn::Euler(three(), [2, 0, 2], 1.0),
            Turn::Euler(three(), [0, 1, 0], 1.0),
            Turn::Euler(three(), [1, 0, 1], 1.0),
            Turn::RotationVector(three(), 0.5),
        ];
        for turn in turns {
            let back = from_numbers(&turn, &to_numbers(&turn, &r)).unwrap();
            for (a, b) in back.as_flattened().iter().zip(r.as_flattened()) {
                assert!((a - b).abs() < 1e-12, "{turn:?}");
            }
        }
        let numbers = to_numbers(&Turn::Euler(three(), [2, 1, 0], 1.0), &r);
        assert!((numbers[0] - 0.7).abs() < 1e-12 && (numbers[1] + 0.4).abs() < 1e-12);
    }
}
