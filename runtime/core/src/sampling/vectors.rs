//! Vectors of three numbers.

/// Returns `a + b`.
pub fn add(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    core::array::from_fn(|i| a[i] + b[i])
}

/// Returns `a − b`.
pub fn subtract(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    core::array::from_fn(|i| a[i] - b[i])
}

/// Returns `a` times a number.
pub fn scale(a: [f64; 3], by: f64) -> [f64; 3] {
    a.map(|v| v * by)
}

/// Returns the scalar product.
pub fn dot<const N: usize>(a: [f64; N], b: [f64; N]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

/// Returns the Euclidean norm.
pub fn norm(a: [f64; 3]) -> f64 {
    dot(a, a).sqrt()
}

/// Returns the distance of two points.
pub fn distance(a: [f64; 3], b: [f64; 3]) -> f64 {
    norm(subtract(a, b))
}

/// Returns `v / |v|`, or zero for a zero vector.
pub fn unit(v: [f64; 3]) -> [f64; 3] {
    let length = norm(v);
    if length > 0.0 { v.map(|x| x / length) } else { [0.0; 3] }
}

/// Returns the vector product.
pub fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

/// Returns two unit vectors perpendicular to `n` and to each other.
///
/// The first leans towards the coordinate axis with the smallest component of `n`.
pub fn tangents(n: [f64; 3]) -> [[f64; 3]; 2] {
    let n = unit(n);
    let least = (0..3).min_by(|i, j| n[*i].abs().total_cmp(&n[*j].abs())).unwrap_or(0);
    let first = unit(core::array::from_fn(|i| f64::from(u8::from(i == least)) - n[least] * n[i]));
    [first, cross(n, first)]
}
