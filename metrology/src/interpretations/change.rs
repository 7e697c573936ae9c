//! Difference between the rows and the statements of the spec or the map.

use serde::Serialize;

/// Largest number of joints whose signs are combined.
pub(crate) const SIGNS: usize = 8;

/// Single difference. Joints are indexed from 0 in the order of the spec. Columns are reordered
/// first, then signs, couplings and zeros are applied.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Change {
    /// Different order of the columns: joint `i` is in column `order[i]`.
    Order(Vec<usize>),
    /// Opposite sign of these joints.
    Reversed(Vec<usize>),
    /// Column relative to another joint: `by` times that joint must be added.
    Coupled {
        /// Joint of the column.
        joint: usize,
        /// Joint to add.
        to: usize,
        /// Factor, 1 or −1.
        by: f64,
    },
    /// Offset of a joint's zero, in rad or in the spec's length unit.
    Zero {
        /// Joint with the offset.
        joint: usize,
        /// Value to add.
        offset: f64,
    },
    /// Other Denavit-Hartenberg convention than in the spec.
    Convention,
    /// Inverse of the spec's tool transform.
    ToolInverted,
    /// Poses of the last frame, without the tool.
    ToolLeftOut,
    /// Inverse of the fixed transforms at the base.
    BaseInverted,
    /// Poses relative to the first moving frame.
    BaseLeftOut,
    /// Base and tool exchanged.
    EndsExchanged,
    /// Poses of the base in the tool frame.
    PoseInverted,
    /// Poses relative to another frame, which is fitted.
    BaseElsewhere,
    /// Poses of another point of the end effector, which is fitted.
    ToolElsewhere,
    /// Two of the columns x, y and z exchanged, or one with the wrong sign. Every such case equals
    /// an exchange of x and y followed by a rotation of the base.
    Mirrored,
    /// Orientations of `F_0` in the tool frame; positions as stated.
    OrientationInverted,
}

impl Change {
    /// Returns the exchange of the columns of two of `count` joints.
    pub(crate) fn exchanged(i: usize, j: usize, count: usize) -> Self {
        let mut order: Vec<usize> = (0..count).collect();
        order.swap(i, j);
        Self::Order(order)
    }

    /// Returns the opposite signs of every combination of some of these joints.
    pub(crate) fn reversals(joints: &[usize]) -> impl Iterator<Item = Self> {
        (1..1_usize << joints.len()).map(|signs| {
            let reversed = joints.iter().enumerate().filter(|(k, _)| signs >> k & 1 == 1);
            Self::Reversed(reversed.map(|(_, joint)| *joint).collect())
        })
    }

    /// Counts the single differences that this change stands for.
    pub(crate) fn cost(&self) -> usize {
        match self {
            Self::Reversed(joints) => joints.len(),
            // Six parameters are fitted.
            Self::BaseElsewhere | Self::ToolElsewhere => 2,
            _ => 1,
        }
    }

    /// Counts the parameters fitted to poses, or to positions alone.
    pub(super) fn fitted(&self, oriented: bool) -> usize {
        match self {
            Self::Zero { .. } => 1,
            Self::ToolElsewhere if !oriented => 3,
            Self::BaseElsewhere | Self::ToolElsewhere => 6,
            _ => 0,
        }
    }

    /// Compares two changes, ignoring their fitted values.
    pub(super) fn is_like(&self, other: &Self) -> bool {
        match (self, other) {
            (Self::Zero { joint, .. }, Self::Zero { joint: other, .. }) => joint == other,
            _ => self == other,
        }
    }
}
