//! Targets of inverse kinematics.

use abbe_core::Pose;

/// Target of the tool, in `F_0`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Target {
    /// Target of the tool point: rows 1–3.
    Point([f64; 3]),
    /// Target of position and orientation: all six rows.
    Pose(Pose),
}

impl Target {
    pub(super) fn is_finite(&self) -> bool {
        match self {
            Self::Point(point) => point.iter().all(|x| x.is_finite()),
            Self::Pose(pose) => pose.0.as_flattened().iter().all(|x| x.is_finite()),
        }
    }
}
