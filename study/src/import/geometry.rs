//! What stands before and behind the motion of a joint.

use abbe_spec::DhConvention;
use nalgebra::{Isometry3, Translation3, UnitQuaternion, Vector3};

use super::placement::Placement;

/// How a frame is given.
#[derive(Clone, Copy, Debug)]
pub(super) enum Geometry {
    /// As in URDF: placed, then moved.
    Origin(Placement),
    /// By four numbers; what moves is part of `theta` or of `d`, and is not in them here.
    Numbers(Numbers),
}

/// Denavit-Hartenberg numbers.
#[derive(Clone, Copy, Debug)]
pub(super) struct Numbers {
    pub(super) convention: DhConvention,
    pub(super) theta: f64,
    pub(super) d: f64,
    pub(super) a: f64,
    pub(super) alpha: f64,
}

impl Numbers {
    /// `Rz(theta) Tz(d)`, which commutes with every motion about or along z.
    fn z(&self) -> Isometry3<f64> {
        let turn = UnitQuaternion::from_axis_angle(&Vector3::z_axis(), self.theta);
        Isometry3::from_parts(Translation3::new(0.0, 0.0, self.d), turn)
    }

    /// `Tx(a) Rx(alpha)`, in either order the same.
    fn x(&self) -> Isometry3<f64> {
        let turn = UnitQuaternion::from_axis_angle(&Vector3::x_axis(), self.alpha);
        Isometry3::from_parts(Translation3::new(self.a, 0.0, 0.0), turn)
    }
}

impl Geometry {
    /// From the frame before to where the joint moves.
    pub(super) fn before(&self) -> Isometry3<f64> {
        match self {
            Self::Origin(placement) => placement.motion(),
            Self::Numbers(numbers) => match numbers.convention {
                DhConvention::Standard => numbers.z(),
                DhConvention::Modified => numbers.x() * numbers.z(),
            },
        }
    }

    /// From there to the frame.
    pub(super) fn after(&self) -> Isometry3<f64> {
        match self {
            Self::Numbers(numbers) if numbers.convention == DhConvention::Standard => numbers.x(),
            _ => Isometry3::identity(),
        }
    }

    /// The sum of its lengths, for what rounding may be.
    pub(super) fn size(&self) -> f64 {
        match self {
            Self::Origin(placement) => placement.xyz.iter().map(|x| x.abs()).sum(),
            Self::Numbers(numbers) => numbers.a.abs() + numbers.d.abs(),
        }
    }
}
