//! What one would write by hand: a loop over frames, on nalgebra's matrices. The baseline of the benchmarks.

use abbe::Component;
use nalgebra::{Matrix3, Vector3};

/// A rigid motion by columns: x, y, z axis and position.
pub type Columns = [[f64; 3]; 4];

/// A frame in `F_0`: its axes and its origin.
pub type Frame = (Matrix3<f64>, Vector3<f64>);

/// Pose of the tool point and the 6 × 6n columns of `J_e`, rotation-vector rows, from `A_1 … A_n` and the tool.
///
/// `poses` has room for as many frames as there are transforms.
pub fn error_jacobian(transforms: &[Columns], poses: &mut [Frame], columns: &mut [[f64; 6]]) -> Columns {
    let mut axes = Matrix3::identity();
    let mut position = Vector3::zeros();
    for (pose, [x, y, z, offset]) in poses.iter_mut().zip(transforms) {
        position += axes * Vector3::from(*offset);
        axes *= Matrix3::from([*x, *y, *z]);
        *pose = (axes, position);
    }
    for (columns, (axes, origin)) in columns.chunks_exact_mut(6).zip(&*poses) {
        let lever = position - origin;
        for component in Component::ALL {
            let axis: Vector3<f64> = axes.column(component.axis()).into();
            let [velocity, rotation] = match component.is_rotation() {
                true => [axis.cross(&lever), axis],
                false => [axis, Vector3::zeros()],
            };
            columns[component.index()] =
                [velocity.x, velocity.y, velocity.z, rotation.x, rotation.y, rotation.z];
        }
    }
    let [x, y, z]: [[f64; 3]; 3] = axes.into();
    [x, y, z, position.into()]
}
