//! Interpretation of the numbers of a file.

use serde::Serialize;

use super::{Change, PoseFormat};

/// Units, format and differences from the spec with which the numbers of a file are read.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Interpretation {
    /// Is true if revolute joints are in degrees, false for radians; none if there are no revolute
    /// joints.
    pub joints_in_degrees: Option<bool>,
    /// Unit of prismatic joints; none if there are none.
    pub slides_in: Option<&'static str>,
    /// Unit of positions.
    pub lengths_in: &'static str,
    /// Format of the poses.
    pub layout: PoseFormat,
    /// Differences from the spec.
    pub changes: Vec<Change>,
}

impl Interpretation {
    /// Counts the differences from the spec, and from units and format stated by a map.
    pub(super) fn cost(&self, stated: Option<&Self>) -> usize {
        let units = stated.map_or(0, |stated| {
            usize::from(self.joints_in_degrees != stated.joints_in_degrees)
                + usize::from(self.slides_in != stated.slides_in)
                + usize::from(self.lengths_in != stated.lengths_in)
                + usize::from(self.layout != stated.layout)
        });
        // A map states target − actual; the data can rarely tell which sign was meant.
        let sign = usize::from(self.layout == PoseFormat::Difference { target_minus_actual: false });
        self.changes.iter().map(Change::cost).sum::<usize>() + units + sign
    }

    /// Returns true if this interpretation is the other one without some of its changes.
    pub(super) fn is_part_of(&self, other: &Self) -> bool {
        let same = self.joints_in_degrees == other.joints_in_degrees
            && self.slides_in == other.slides_in
            && self.lengths_in == other.lengths_in
            && self.layout == other.layout;
        same && self.changes.iter().all(|change| other.changes.iter().any(|one| change.is_like(one)))
    }
}
