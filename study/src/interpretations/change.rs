//! One way in which the rows differ from what the spec or the map states.

use serde::Serialize;

/// One difference. Joints count from 0 in the order of the spec. Columns are put into order first, then signs are applied, then
/// couplings, then zeros.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Change {
    /// The columns stand in another order: that of joint `i` is the one of the place `order[i]`.
    Order(Vec<usize>),
    /// These joints count the other way round.
    Reversed(Vec<usize>),
    /// A column is relative to another joint: `by` times that joint is added, 1 or −1.
    Coupled {
        /// The joint whose column it is.
        joint: usize,
        /// The joint that is added.
        to: usize,
        /// 1 or −1.
        by: f64,
    },
    /// The zero of a joint: this much is added to its value, in rad or in the spec's length unit.
    Zero {
        /// The joint.
        joint: usize,
        /// What is added.
        offset: f64,
    },
    /// Denavit-Hartenberg numbers are of the other convention than the spec says.
    Convention,
    /// The tool of the spec is the other way round.
    ToolInverted,
    /// The poses are those of the last frame, without the tool.
    ToolLeftOut,
    /// The fixed frames at the base are the other way round.
    BaseInverted,
    /// The poses are seen from the first frame that moves.
    BaseLeftOut,
    /// Base and tool are exchanged.
    EndsExchanged,
    /// The poses are those of the base as the tool sees it.
    PoseInverted,
    /// The poses are seen from another place, which is fitted.
    BaseElsewhere,
    /// The poses are those of another point of the end effector, which is fitted.
    ToolElsewhere,
    /// Two of the columns x, y and z are exchanged, or one has the wrong sign. Every such case is this one and a rotation of the base.
    Mirrored,
    /// The orientations are those of `F_0` as the tool sees it; the positions are as stated.
    OrientationInverted,
}

impl Change {
    /// The columns of two of `count` joints are exchanged.
    pub(crate) fn exchanged(i: usize, j: usize, count: usize) -> Self {
        let mut order: Vec<usize> = (0..count).collect();
        order.swap(i, j);
        Self::Order(order)
    }

    /// Number of single differences that it counts for.
    pub(super) fn cost(&self) -> usize {
        match self {
            Self::Reversed(joints) => joints.len(),
            // Six numbers are fitted.
            Self::BaseElsewhere | Self::ToolElsewhere => 2,
            _ => 1,
        }
    }

    /// Number of parameters fitted to poses, or to positions alone.
    pub(super) fn fitted(&self, oriented: bool) -> usize {
        match self {
            Self::Zero { .. } => 1,
            Self::BaseElsewhere => 6,
            Self::ToolElsewhere => {
                if oriented {
                    6
                } else {
                    3
                }
            }
            _ => 0,
        }
    }

    /// Compares two changes without their fitted values.
    pub(super) fn is_like(&self, other: &Self) -> bool {
        match (self, other) {
            (Self::Zero { joint, .. }, Self::Zero { joint: other, .. }) => joint == other,
            _ => self == other,
        }
    }
}
