//! Axes of joints as lines in `F_0`, with all joints at zero.

use abbe_core::Pose;
use nalgebra::{Matrix3, Vector3};

use crate::reach::joint_chain::JointChain;

/// Distance, in arm lengths, and sine below which axes intersect or are parallel.
pub(super) const TOLERANCE: f64 = 1e-9;

/// Axis: a unit vector, and a point on it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Line {
    pub(super) along: Vector3<f64>,
    pub(super) at: Vector3<f64>,
}

impl Line {
    /// Returns the vector from the line to a point, perpendicular to the line.
    pub(super) fn offset(&self, point: Vector3<f64>) -> Vector3<f64> {
        let from = point - self.at;
        from - self.along * self.along.dot(&from)
    }

    pub(super) fn distance(&self, point: Vector3<f64>) -> f64 {
        self.offset(point).norm()
    }

    pub(super) fn is_parallel(&self, other: &Self) -> bool {
        self.along.cross(&other.along).norm() < TOLERANCE
    }
}

/// Returns the axes of the joints and the pose of the tool point, with all joints at zero.
pub(super) fn axes(chain: &JointChain) -> (Vec<Line>, Pose) {
    let mut pose = Pose::IDENTITY;
    let mut axes = Vec::with_capacity(chain.joints.len());
    for joint in &chain.joints {
        pose = pose.then(&joint.before);
        axes.push(Line { along: vector(pose.0[2]), at: vector(pose.position()) });
    }
    (axes, pose.then(&chain.tool))
}

/// Returns the feet of the common perpendicular of two lines, the one on `a` first. For parallel
/// lines, it passes through the point of `b`.
pub(super) fn common_perpendicular(a: &Line, b: &Line) -> [Vector3<f64>; 2] {
    let normal = a.along.cross(&b.along);
    if normal.norm() < TOLERANCE {
        return [b.at - a.offset(b.at), b.at];
    }
    let between = b.at - a.at;
    let square = normal.norm_squared();
    let on_a = a.at + a.along * (between.cross(&b.along).dot(&normal) / square);
    let on_b = b.at + b.along * (between.cross(&a.along).dot(&normal) / square);
    [on_a, on_b]
}

/// Returns the point where two lines intersect.
pub(super) fn common_point(a: &Line, b: &Line) -> Option<Vector3<f64>> {
    let [on_a, on_b] = common_perpendicular(a, b);
    (!a.is_parallel(b) && (on_a - on_b).norm() < TOLERANCE).then_some((on_a + on_b) / 2.0)
}

/// Returns a vector turned about a unit vector, by Rodrigues' formula.
pub(super) fn turned(along: Vector3<f64>, angle: f64, v: Vector3<f64>) -> Vector3<f64> {
    let (sine, cosine) = angle.sin_cos();
    v * cosine + along.cross(&v) * sine + along * (along.dot(&v) * (1.0 - cosine))
}

/// Returns the matrix of a rotation about a unit vector.
pub(super) fn turn(along: Vector3<f64>, angle: f64) -> Matrix3<f64> {
    Matrix3::from_columns(&[Vector3::x(), Vector3::y(), Vector3::z()].map(|axis| turned(along, angle, axis)))
}

/// Returns a unit vector perpendicular to a unit vector.
pub(super) fn across(along: Vector3<f64>) -> Vector3<f64> {
    let axis = along.iamin();
    let mut unit = Vector3::zeros();
    unit[axis] = 1.0;
    along.cross(&unit).normalize()
}

pub(super) fn vector(array: [f64; 3]) -> Vector3<f64> {
    array.into()
}

/// Returns the rotation of a pose.
pub(super) fn matrix(pose: &Pose) -> Matrix3<f64> {
    Matrix3::from_columns(&[0, 1, 2].map(|column| vector(pose.0[column])))
}
