//! Handwritten baseline of the benchmarks: a loop over frames, on nalgebra matrices.

use abbe::Component;
use nalgebra::{Matrix3, Vector3};

/// Rigid motion by columns: x, y, z axes and position.
pub type Columns = [[f64; 3]; 4];

/// Frame in `F_0`: axes and origin.
pub type Frame = (Matrix3<f64>, Vector3<f64>);

/// Returns the pose of the tool point, and computes the 6 × 6n columns of `J_e` with
/// rotation-vector rows, from `A_1 … A_n` and the tool.
///
/// `poses` is scratch space with one entry per transform.
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
