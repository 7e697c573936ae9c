//! Where a machine stands and what is mounted on its tool, as a map states it: no errors of the machine.

use abbe::Pose;

use super::column::Column;

/// Where the machine stands before the instrument.
#[derive(Clone, Debug, PartialEq)]
pub struct StatedStation {
    /// What it is called; empty if it is the only one.
    pub name: String,
    /// From `F_0` to the frame of the instrument.
    pub pose: Pose,
}

/// The stations of a map.
#[derive(Clone, Debug, Default)]
pub struct Stations {
    /// The column that names the station of a row.
    pub column: Option<Column>,
    /// Those whose place is stated.
    pub stated: Vec<StatedStation>,
}

impl Stations {
    /// Where a station is, if that is stated.
    pub fn pose(&self, name: &str) -> Option<Pose> {
        self.stated.iter().find(|station| station.name == name).map(|station| station.pose)
    }

    /// The names before any row is read: those that are stated, or a single one without a name.
    pub(super) fn names(&self) -> Vec<String> {
        match (&self.column, &self.stated[..]) {
            (None, []) => vec![String::new()],
            (_, stated) => stated.iter().map(|station| station.name.clone()).collect(),
        }
    }
}

/// What is mounted on the tool.
#[derive(Clone, Debug, Default)]
pub struct Placement {
    /// Whether nothing of it is unknown: the targets, or the frame that is seen, are where the map says.
    pub exact: bool,
    /// Where the targets were found in the frame of the tool, in place of where they were designed.
    pub targets: Option<Vec<[f64; 3]>>,
    /// From the frame that is seen to that of the tool, for whole poses.
    pub mounting: Option<Pose>,
}
