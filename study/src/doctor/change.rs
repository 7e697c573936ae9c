//! One thing that is other than the spec has it.

use serde::Serialize;

/// What is other. Joints count from 0 in the order of the spec; their columns are first put into order, then signs, then
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
}

impl Change {
    /// How many things it is.
    pub(super) fn cost(&self) -> usize {
        match self {
            Self::Reversed(joints) => joints.len(),
            // Six numbers are fitted.
            Self::BaseElsewhere | Self::ToolElsewhere => 2,
            _ => 1,
        }
    }

    /// How many numbers are fitted to poses, or to positions alone.
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

    /// The same, but for what is fitted.
    pub(super) fn is_like(&self, other: &Self) -> bool {
        match (self, other) {
            (Self::Zero { joint, .. }, Self::Zero { joint: other, .. }) => joint == other,
            _ => self == other,
        }
    }
}
