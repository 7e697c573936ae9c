//! Operations on vectors with an entry per value of a check.

/// Returns the Euclidean norm.
pub(super) fn norm(v: &[f64]) -> f64 {
    product(v, v).sqrt()
}

/// Returns the scalar product.
pub(super) fn product(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

/// Returns the cosine of the angle between two vectors; 0 if one of them is zero.
pub(super) fn cosine(a: &[f64], b: &[f64]) -> f64 {
    product(a, b) / (norm(a) * norm(b)).max(1e-300)
}
