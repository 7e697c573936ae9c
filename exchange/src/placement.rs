//! Pose of a frame in another as URDF writes it: `xyz` and `rpy`.

use abbe::Pose;
use nalgebra::{Isometry3, Matrix3, Rotation3, Translation3, UnitQuaternion, Vector3};

/// A translation, then a rotation: `T(xyz) Rz(yaw) Ry(pitch) Rx(roll)`, in the unit of the file and
/// rad.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Placement {
    /// Translation along x, y and z.
    pub(crate) xyz: [f64; 3],
    /// Roll, pitch and yaw.
    pub(crate) rpy: [f64; 3],
}

impl Placement {
    /// Returns the rigid motion.
    pub(crate) fn motion(&self) -> Isometry3<f64> {
        let [roll, pitch, yaw] = self.rpy;
        let turn = |axis, angle| UnitQuaternion::from_axis_angle(&axis, angle);
        let (x, y, z) = (Vector3::x_axis(), Vector3::y_axis(), Vector3::z_axis());
        Isometry3::from_parts(self.xyz.into(), turn(z, yaw) * turn(y, pitch) * turn(x, roll))
    }

    /// Splits a rigid motion into translation, roll, pitch and yaw.
    ///
    /// At a pitch of ±90°, where roll and yaw turn about the same axis, roll is 0.
    pub(crate) fn from_motion(motion: &Isometry3<f64>) -> Self {
        let rotation: Matrix3<f64> = *motion.rotation.to_rotation_matrix().matrix();
        let level = rotation[(0, 0)].hypot(rotation[(1, 0)]);
        let pitch = (-rotation[(2, 0)]).atan2(level);
        let yaw = match level > 1e-15 {
            true => rotation[(1, 0)].atan2(rotation[(0, 0)]),
            false => (-rotation[(0, 1)]).atan2(rotation[(1, 1)]),
        };
        // Roll is what remains after yaw and pitch: the product of the three is then the rotation
        // close to ±90°, too.
        let turned = |axis, angle| Rotation3::from_axis_angle(&axis, angle);
        let left =
            (turned(Vector3::z_axis(), yaw) * turned(Vector3::y_axis(), pitch)).inverse().matrix() * rotation;
        let roll = left[(2, 1)].atan2(left[(1, 1)]);
        Self { xyz: motion.translation.vector.into(), rpy: [roll, pitch, yaw].map(|angle| angle + 0.0) }
    }

    /// Returns the product `self · next`.
    ///
    /// If one factor is the identity, the numbers of the other stay bit for bit.
    pub(crate) fn then(&self, next: &Self) -> Self {
        if *self == Self::default() {
            *next
        } else if *next == Self::default() {
            *self
        } else if self.rpy == [0.0; 3] {
            let xyz = std::array::from_fn(|i| self.xyz[i] + next.xyz[i]);
            Self { xyz, rpy: next.rpy }
        } else {
            Self::from_motion(&(self.motion() * next.motion()))
        }
    }

    /// Returns the pose of the outer frame in the inner one.
    pub(crate) fn inverse(&self) -> Self {
        match self.rpy == [0.0; 3] {
            true => Self { xyz: self.xyz.map(|x| 0.0 - x), rpy: self.rpy },
            false => Self::from_motion(&self.motion().inverse()),
        }
    }

    /// Takes a point of the inner frame to the outer one.
    pub(crate) fn point(&self, inner: [f64; 3]) -> [f64; 3] {
        match self.rpy == [0.0; 3] {
            true => std::array::from_fn(|i| self.xyz[i] + inner[i]),
            false => (self.motion() * nalgebra::Point3::from(inner)).into(),
        }
    }
}

/// Returns a pose for `T(xyz) Rz(yaw) Ry(pitch) Rx(roll)`.
pub(crate) fn placed(xyz: [f64; 3], rpy: [f64; 3]) -> Pose {
    pose(&Placement { xyz, rpy }.motion())
}

/// Returns roll, pitch and yaw of a pose, in rad.
pub(crate) fn roll_pitch_yaw(pose: &Pose) -> [f64; 3] {
    let Pose([x, y, z, _]) = *pose;
    let rotation = Rotation3::from_matrix_unchecked(Matrix3::from_columns(&[x.into(), y.into(), z.into()]));
    Placement::from_motion(&Isometry3::from_parts(Default::default(), rotation.into())).rpy
}

/// Converts a rigid motion to a [`Pose`].
pub(crate) fn pose(motion: &Isometry3<f64>) -> Pose {
    let matrix = motion.to_homogeneous();
    Pose(std::array::from_fn(|j| std::array::from_fn(|i| matrix[(i, j)])))
}

/// Returns the motion of a joint by `value`: an angle in rad about a unit vector, or a length along
/// it.
pub(crate) fn joint_motion(prismatic: bool, axis: [f64; 3], value: f64) -> Isometry3<f64> {
    let axis = Vector3::from(axis);
    match prismatic {
        true => Isometry3::from(Translation3::from(axis * value)),
        false => Isometry3::from_parts(
            Translation3::identity(),
            UnitQuaternion::from_axis_angle(&nalgebra::Unit::new_normalize(axis), value),
        ),
    }
}

#[cfg(test)]
mod tests;
