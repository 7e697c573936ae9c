//! Plain arrays as nalgebra types: Jacobians as views without copying, poses as isometries.

use nalgebra::{Const, Isometry3, Matrix3, MatrixView, Rotation3, SMatrixView, Translation3, UnitQuaternion};

use crate::Pose;

/// Returns a Jacobian with a constant number of columns as a 6 × N nalgebra view, without copying.
///
/// ```
/// // A 6 × 12 error Jacobian: two frames, six columns each.
/// let columns = [[1.0, 2.0, 3.0, 4.0, 5.0, 6.0]; 12];
/// let jacobian = abbe::jacobian_view(&columns);
/// assert_eq!(jacobian.shape(), (6, 12));
/// assert_eq!(jacobian[(1, 0)], 2.0);
///
/// let errors = nalgebra::SVector::<f64, 12>::repeat(0.5);
/// let deviation: nalgebra::Vector6<f64> = jacobian * errors;
/// assert_eq!(deviation[0], 6.0);
/// ```
pub fn jacobian_view<const N: usize>(columns: &[[f64; 6]; N]) -> SMatrixView<'_, f64, 6, N> {
    MatrixView::from_slice_generic(columns.as_flattened(), Const::<6>, Const::<N>)
}

impl Pose {
    /// Returns the pose as an nalgebra isometry, in the same length unit.
    ///
    /// ```
    /// let quarter = abbe::Pose([[0.0, 1.0, 0.0], [-1.0, 0.0, 0.0], [0.0, 0.0, 1.0], [5.0, 0.0, 0.0]]);
    /// let point = quarter.isometry() * nalgebra::Point3::new(1.0, 0.0, 0.0);
    /// assert!((point - nalgebra::Point3::new(5.0, 1.0, 0.0)).norm() < 1e-15);
    /// ```
    pub fn isometry(&self) -> Isometry3<f64> {
        let [x, y, z, position] = self.0;
        let rotation =
            Rotation3::from_matrix_unchecked(Matrix3::from_columns(&[x.into(), y.into(), z.into()]));
        Isometry3::from_parts(Translation3::from(position), UnitQuaternion::from_rotation_matrix(&rotation))
    }
}

impl From<&Pose> for Isometry3<f64> {
    fn from(pose: &Pose) -> Self {
        pose.isometry()
    }
}
