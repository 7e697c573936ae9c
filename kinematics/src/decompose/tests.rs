//! Tests of `decompose.rs`.

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
        let back =
            eigen.eigenvectors * Matrix3::from_diagonal(&eigen.eigenvalues) * eigen.eigenvectors.transpose();
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
