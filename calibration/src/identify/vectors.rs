//! Products and unit vectors of three coordinates.

pub(super) fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

pub(super) fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

pub(super) fn difference(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    core::array::from_fn(|i| a[i] - b[i])
}

/// Returns `v / |v|`, or zero for a zero vector.
pub(super) fn unit(v: [f64; 3]) -> [f64; 3] {
    let length = dot(v, v).sqrt();
    if length > 0.0 { v.map(|x| x / length) } else { [0.0; 3] }
}

/// Returns the unit vector of coordinate axis 0, 1 or 2.
pub(super) fn unit_axis(axis: usize) -> [f64; 3] {
    core::array::from_fn(|i| f64::from(u8::from(i == axis)))
}
