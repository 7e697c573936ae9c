//! Matrix decompositions that always terminate: checked for finite input, scaled, and limited in
//! their iterations.

use nalgebra::allocator::Allocator;
use nalgebra::{DMatrix, DefaultAllocator, Dim, DimDiff, DimSub, OMatrix, SVD, SymmetricEigen, U1};
use nalgebra::{Matrix3, U3};

/// Largest number of iterations, about a hundred times what matrices of this size need.
pub const STEPS: usize = 100_000;

/// Returns `V Λ Vᵀ` of a symmetric matrix, or `None` if a number is not finite.
pub fn symmetric_eigen<D>(matrix: OMatrix<f64, D, D>) -> Option<SymmetricEigen<f64, D>>
where
    D: Dim + DimSub<U1>,
    DefaultAllocator: Allocator<D, D> + Allocator<DimDiff<D, U1>> + Allocator<D> + Allocator<DimDiff<D, U1>>,
{
    let is_finite = matrix.iter().all(|value| value.is_finite());
    is_finite.then(|| SymmetricEigen::try_new(matrix, f64::EPSILON, STEPS))?
}

/// Returns the singular values, the largest first, or `None` if a number is not finite.
pub fn singular_values(matrix: DMatrix<f64>) -> Option<Vec<f64>> {
    if matrix.is_empty() {
        return Some(Vec::new());
    }
    let is_finite = matrix.iter().all(|value| value.is_finite());
    let svd = is_finite.then(|| SVD::try_new(matrix, false, false, f64::EPSILON, STEPS))??;
    let mut values = svd.singular_values.as_slice().to_vec();
    values.sort_by(|a, b| b.total_cmp(a));
    Some(values)
}

/// Returns `U Σ Vᵀ`, or `None` if a number is not finite. Scaling prevents overflow and underflow
/// of squares.
pub fn svd3(matrix: Matrix3<f64>) -> Option<SVD<f64, U3, U3>> {
    if !matrix.iter().all(|value| value.is_finite()) {
        return None;
    }
    let largest = matrix.amax();
    let scale = if largest > 0.0 { largest } else { 1.0 };
    let mut svd = SVD::try_new(matrix / scale, true, true, f64::EPSILON, STEPS)?;
    svd.singular_values *= scale;
    Some(svd)
}

#[cfg(test)]
mod tests;
