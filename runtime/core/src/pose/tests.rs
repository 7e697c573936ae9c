//! Tests of `pose.rs`.

use super::Pose;

#[test]
fn inverse_undoes() {
    let (s, c) = 0.7_f64.sin_cos();
    let pose = Pose([[c, s, 0.0], [-s, c, 0.0], [0.0, 0.0, 1.0], [3.0, -2.0, 5.0]]);
    let Pose(product) = pose.then(&pose.inverse());
    for (found, expected) in product.as_flattened().iter().zip(Pose::IDENTITY.0.as_flattened()) {
        assert!((found - expected).abs() < 1e-15);
    }
}
