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

/// Placement on the tool.
#[derive(Clone, Debug, Default)]
pub struct Placement {
    /// It is exact: targets or measured frame have no unknowns.
    pub exact: bool,
    /// Each station has its own.
    pub is_per_station: bool,
    /// Stated placements: one at most, or one for each of some stations.
    pub stated: Vec<StatedPlacement>,
}

/// Placement on the tool that replaces the nominal one.
#[derive(Clone, Debug, Default)]
pub struct StatedPlacement {
    /// Name of the station; empty for the placement at all stations.
    pub station: String,
    /// Positions of the targets in the frame of the tool, for points.
    pub targets: Option<Vec<[f64; 3]>>,
    /// Transform from the measured frame to the frame of the tool, for whole poses.
    pub mounting: Option<Pose>,
}

impl Placement {
    /// Returns the placement at a station, if it is stated.
    pub fn at(&self, station: &str) -> Option<&StatedPlacement> {
        self.stated.iter().find(|one| !self.is_per_station || one.station == station)
    }
}
