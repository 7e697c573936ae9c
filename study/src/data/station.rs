//! Stations and mounting as a map states them; they are no errors of the machine.

use abbe::Pose;

use super::column::Column;

/// Pose of the machine at a station.
#[derive(Clone, Debug, PartialEq)]
pub struct StatedStation {
    /// Name; empty for a single station.
    pub name: String,
    /// Transform from `F_0` to the frame of the instrument.
    pub pose: Pose,
}

/// Stations of a map.
#[derive(Clone, Debug, Default)]
pub struct Stations {
    /// Column of the station of a row.
    pub column: Option<Column>,
    /// Stations with a stated pose.
    pub stated: Vec<StatedStation>,
}

impl Stations {
    /// Returns the pose of a station, if it is stated.
    pub fn pose(&self, name: &str) -> Option<Pose> {
        self.stated.iter().find(|station| station.name == name).map(|station| station.pose)
    }

    /// Returns the names before any row is read: the stated ones, or a single empty one.
    pub(super) fn names(&self) -> Vec<String> {
        match (&self.column, &self.stated[..]) {
            (None, []) => vec![String::new()],
            (_, stated) => stated.iter().map(|station| station.name.clone()).collect(),
        }
    }
}

/// Mounting on the tool.
#[derive(Clone, Debug, Default)]
pub struct Placement {
    /// The mounting is exact: targets or measured frame have no unknowns.
    pub exact: bool,
    /// Identified positions of the targets in the frame of the tool, which replace the nominal
    /// ones.
    pub targets: Option<Vec<[f64; 3]>>,
    /// Transform from the measured frame to the frame of the tool, for whole poses.
    pub mounting: Option<Pose>,
}
