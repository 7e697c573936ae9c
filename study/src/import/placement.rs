//! Where a frame stands in another, as URDF writes it.

use nalgebra::{Isometry3, Matrix3, Rotation3, Translation3, UnitQuaternion, Vector3};

/// A translation, then a rotation: `T(xyz) Rz(yaw) Ry(pitch) Rx(roll)`, in m and rad.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Placement {
    /// Along x, y and z.
    pub(super) xyz: [f64; 3],
    /// Roll, pitch and yaw.
    pub(super) rpy: [f64; 3],
}

impl Placement {
    /// The same as a rigid motion.
    pub(super) fn motion(&self) -> Isometry3<f64> {
        let [roll, pitch, yaw] = self.rpy;
        let turn = |axis, angle| UnitQuaternion::from_axis_angle(&axis, angle);
        let (x, y, z) = (Vector3::x_axis(), Vector3::y_axis(), Vector3::z_axis());
        Isometry3::from_parts(self.xyz.into(), turn(z, yaw) * turn(y, pitch) * turn(x, roll))
    }

    /// A rigid motion as roll, pitch and yaw. At pitch ±90°, where roll and yaw turn about one axis, all is yaw.
    pub(super) fn from_motion(motion: &Isometry3<f64>) -> Self {
        let rotation: Matrix3<f64> = *motion.rotation.to_rotation_matrix().matrix();
        let level = rotation[(0, 0)].hypot(rotation[(1, 0)]);
        let pitch = (-rotation[(2, 0)]).atan2(level);
        let yaw = match level > 1e-15 {
            true => rotation[(1, 0)].atan2(rotation[(0, 0)]),
            false => (-rotation[(0, 1)]).atan2(rotation[(1, 1)]),
        };
        // What is left after yaw and pitch, so that the three together are the rotation also close to ±90°.
        let turned = |axis, angle| Rotation3::from_axis_angle(&axis, angle);
        let left =
            (turned(Vector3::z_axis(), yaw) * turned(Vector3::y_axis(), pitch)).inverse().matrix() * rotation;
        let roll = left[(2, 1)].atan2(left[(1, 1)]);
        Self { xyz: motion.translation.vector.into(), rpy: [roll, pitch, yaw].map(|angle| angle + 0.0) }
    }

    /// `self`, then `next` within it. Where one of them is no motion at all, the numbers of the other stay as they are.
    pub(super) fn then(&self, next: &Self) -> Self {
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

    /// Where a point of the inner frame stands in the outer one.
    pub(super) fn point(&self, inner: [f64; 3]) -> [f64; 3] {
        match self.rpy == [0.0; 3] {
            true => std::array::from_fn(|i| self.xyz[i] + inner[i]),
            false => (self.motion() * nalgebra::Point3::from(inner)).into(),
        }
    }
}

/// A joint's motion: by `value` rad about, or m along, a unit vector.
pub(super) fn moved(prismatic: bool, axis: [f64; 3], value: f64) -> Isometry3<f64> {
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
mod tests {
    use super::*;

    /// Roll, pitch and yaw come back as the same rotation everywhere, at ±90° and next to it too.
    #[test]
    fn angles_of_any_rotation_give_it_back() {
        let quarter = std::f64::consts::FRAC_PI_2;
        let pitches =
            [0.0, 0.3, -1.2, quarter, -quarter, quarter - 1e-12, quarter - 1e-9, 1.57, -quarter + 1e-7];
        for pitch in pitches {
            for roll in [0.0, 0.4, -2.5, quarter] {
                for yaw in [0.0, 1.1, -3.0, quarter] {
                    let placed = Placement { xyz: [1.0, -2.0, 3.0], rpy: [roll, pitch, yaw] };
                    let again = Placement::from_motion(&placed.motion());
                    let (a, b) = (placed.motion().to_homogeneous(), again.motion().to_homogeneous());
                    assert!((a - b).abs().max() < 2e-15, "{placed:?}: {again:?}, {}", (a - b).abs().max());
                }
            }
        }
    }
}
