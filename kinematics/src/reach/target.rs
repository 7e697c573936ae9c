//! Targets of inverse kinematics.

use abbe_core::Pose;

/// Target of the tool, in `F_0`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Target {
    /// Target of the tool point: rows 1–3.
    Point([f64; 3]),
    /// Target of position and orientation: all six rows.
    Pose(Pose),
    /// Target of position and of the direction of one axis of the tool, about which it may turn.
    Axis {
        /// Target of the tool point.
        point: [f64; 3],
        /// Axis of the tool: 0 for x, 1 for y, 2 for z.
        axis: usize,
        /// Unit vector in `F_0` along which the axis points.
        direction: [f64; 3],
    },
}

impl Target {
    pub(super) fn is_finite(&self) -> bool {
        match self {
            Self::Point(point) => point.iter().all(|x| x.is_finite()),
            Self::Axis { point, direction, .. } => point.iter().chain(direction).all(|x| x.is_finite()),
            Self::Pose(pose) => pose.0.as_flattened().iter().all(|x| x.is_finite()),
        }
    }
}
