//! Tests of `calibration.rs`.

use super::independent_parts;

/// Holds that the parts have the covariance, for quantities of different units and a singular
/// matrix.
#[test]
fn parts_have_the_covariance() {
    let columns = [[0.1, 2e-6, 0.0, 0.5], [0.03, -5e-7, 0.0, 0.5]];
    let covariance: Vec<Vec<f64>> =
        (0..4).map(|i| (0..4).map(|j| columns.iter().map(|c| c[i] * c[j]).sum()).collect()).collect();
    let parts = independent_parts(&covariance);
    assert_eq!(parts.len(), 2);
    for i in 0..4 {
        for j in 0..4 {
            let sum: f64 = parts.iter().map(|part| part[i] * part[j]).sum();
            let scale = (covariance[i][i] * covariance[j][j]).sqrt();
            assert!((sum - covariance[i][j]).abs() <= 1e-12 * scale, "{i} {j}");
        }
    }
}
