//! Constant transforms before and after the motion of a joint.

use abbe_spec::DhConvention;
use nalgebra::{Isometry3, Translation3, UnitQuaternion, Vector3};

use crate::placement::Placement;

/// Constant part of a frame.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Geometry {
    /// Placement as in URDF; the joint moves after it.
    Origin(Placement),
    /// Denavit-Hartenberg numbers; the motion, which adds to `theta` or `d`, is not part of them.
    DenavitHartenberg(DhRow),
}

/// Denavit-Hartenberg numbers of one row.
#[derive(Clone, Copy, Debug)]
pub(crate) struct DhRow {
    pub(crate) convention: DhConvention,
    pub(crate) theta: f64,
    pub(crate) d: f64,
    pub(crate) a: f64,
    pub(crate) alpha: f64,
}

impl DhRow {
    /// Returns `Rz(theta) Tz(d)`, which commutes with every motion about or along z.
    fn z(&self) -> Isometry3<f64> {
        let turn = UnitQuaternion::from_axis_angle(&Vector3::z_axis(), self.theta);
        Isometry3::from_parts(Translation3::new(0.0, 0.0, self.d), turn)
    }

    /// Returns `Tx(a) Rx(alpha)`; the two factors commute.
    fn x(&self) -> Isometry3<f64> {
        let turn = UnitQuaternion::from_axis_angle(&Vector3::x_axis(), self.alpha);
        Isometry3::from_parts(Translation3::new(self.a, 0.0, 0.0), turn)
    }
}

impl Geometry {
    /// Returns the transform from the previous frame to the joint.
    pub(crate) fn before(&self) -> Isometry3<f64> {
        match self {
            Self::Origin(placement) => placement.motion(),
            Self::DenavitHartenberg(row) => match row.convention {
                DhConvention::Standard => row.z(),
                DhConvention::Modified => row.x() * row.z(),
            },
        }
    }

    /// Returns the transform from the joint to the frame.
    pub(crate) fn after(&self) -> Isometry3<f64> {
        match self {
            Self::DenavitHartenberg(row) if row.convention == DhConvention::Standard => row.x(),
            _ => Isometry3::identity(),
        }
    }

    /// Returns the sum of the lengths: the scale of rounding errors.
    pub(crate) fn size(&self) -> f64 {
        match self {
            Self::Origin(placement) => placement.xyz.iter().map(|x| x.abs()).sum(),
            Self::DenavitHartenberg(row) => row.a.abs() + row.d.abs(),
        }
    }
}
