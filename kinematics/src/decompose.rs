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
mod tests {
    use nalgebra::{DMatrix, Matrix3};

    use super::{singular_values, svd3, symmetric_eigen};

    #[test]
    fn any_numbers_end() {
        let of = |scale: f64| Matrix3::new(2.0, 1.0, 0.0, 1.0, 3.0, -1.0, 0.0, -1.0, 0.5) * scale;
        for scale in [0.0, 1e-160, 1e-3, 1.0, 1e160, 1e300, 1e307] {
            let matrix = of(scale);
            let svd = svd3(matrix).unwrap();
            let back = svd.u.unwrap() * Matrix3::from_diagonal(&svd.singular_values) * svd.v_t.unwrap();
            assert!((back - matrix).amax() <= 1e-12 * matrix.amax(), "{scale:e}");
            let eigen = symmetric_eigen(matrix).unwrap();
            let back = eigen.eigenvectors
                * Matrix3::from_diagonal(&eigen.eigenvalues)
                * eigen.eigenvectors.transpose();
            assert!((back - matrix).amax() <= 1e-12 * matrix.amax(), "{scale:e}");
        }
        for wrong in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
            let mut matrix = of(1.0);
            matrix[(1, 2)] = wrong;
            assert!(svd3(matrix).is_none());
            assert!(symmetric_eigen(matrix).is_none());
            assert!(symmetric_eigen(DMatrix::from_element(4, 4, wrong)).is_none());
            assert!(singular_values(DMatrix::from_element(4, 3, wrong)).is_none());
        }
    }
}
