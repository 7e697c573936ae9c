//! Stations: poses of the machine in the frame of the instrument.

use abbe_core::Pose;

/// Pose of `F_0` in the frame of the instrument. It is not an error of the machine.
#[derive(Clone, Debug, PartialEq)]
pub struct Station {
    /// Name; empty for a single station.
    pub name: String,
    /// `B`: transform from `F_0` to the frame of the instrument, before any unknown.
    pub pose: Pose,
    /// The pose is exact: it has no unknowns.
    pub exact: bool,
    /// Index of the placement on the tool: of its targets and of its mounting.
    pub placement: usize,
}

impl Station {
    /// Creates a nameless station with unknown errors.
    pub fn at(pose: Pose) -> Self {
        Self { name: String::new(), pose, exact: false, placement: 0 }
    }
}
