//! Tests of `curvature.rs`.

use nalgebra::{DMatrix, DVector};

use super::{Curvature, Linearization};

/// Holds that the estimate has the curvature of the last step: `S p = Σ r_i ∇²r_i p` for the
/// residual `(x + y²/2 − 1, y − x²)`, by hand at the second of two close points.
#[test]
fn it_has_the_curvature_of_the_last_step() {
    let at = |x: f64, y: f64| Linearization {
        residual: DVector::from_vec(vec![x + y * y / 2.0 - 1.0, y - x * x]),
        derivatives: DMatrix::from_row_slice(2, 2, &[1.0, y, -2.0 * x, 1.0]),
    };
    let mut curvature = Curvature::zero(2);
    let points = [(0.9, 0.1), (0.4, 0.3), (0.401, 0.298), (0.4, 0.301)];
    for pair in points.windows(2) {
        let [(x, y), (x_after, y_after)] = [pair[0], pair[1]];
        let step = DVector::from_vec(vec![x_after - x, y_after - y]);
        let after = at(x_after, y_after);
        curvature.update(&step, &at(x, y), &after);
        let hessian =
            DMatrix::from_diagonal(&DVector::from_vec(vec![-2.0 * after.residual[1], after.residual[0]]));
        let (found, expected) = (&curvature.0 * &step, hessian * &step);
        assert!((&found - &expected).norm() < 1e-12, "{found} {expected}");
    }
    let rows = curvature.rows();
    let positive = rows.tr_mul(&rows);
    let differs = (&positive - &curvature.0).symmetric_eigen().eigenvalues;
    assert!(differs.iter().all(|value| *value > -1e-12), "{differs}");
}
