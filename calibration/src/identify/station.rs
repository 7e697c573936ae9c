//! Where a machine stands before an instrument.

use abbe_core::Pose;

/// Where `F_0` is as an instrument sees it. It is no error of the machine.
#[derive(Clone, Debug, PartialEq)]
pub struct Station {
    /// What it is called; empty if it is the only one.
    pub name: String,
    /// `B`: from `F_0` to the frame of the instrument, before any unknown.
    pub pose: Pose,
    /// Whether nothing of it is unknown.
    pub exact: bool,
}

impl Station {
    /// A single station, of which something is unknown.
    pub fn at(pose: Pose) -> Self {
        Self { name: String::new(), pose, exact: false }
    }
}
