//! What the numbers of a file mean.

use serde::Serialize;

use super::change::Change;
use super::pose_format::PoseFormat;

/// What the numbers of a file mean.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Interpretation {
    /// Whether angles of joints are in degrees; none if no joint turns.
    pub joints_in_degrees: Option<bool>,
    /// The unit of joints that slide; none if none does.
    pub slides_in: Option<&'static str>,
    /// The unit of positions.
    pub lengths_in: &'static str,
    /// How poses are written.
    pub layout: PoseFormat,
    /// What is other than the spec has it.
    pub changes: Vec<Change>,
}

impl Interpretation {
    /// Number of differences: from the spec, and from units and format that a map states.
    pub(super) fn cost(&self, stated: Option<&Self>) -> usize {
        let units = stated.map_or(0, |stated| {
            usize::from(self.joints_in_degrees != stated.joints_in_degrees)
                + usize::from(self.slides_in != stated.slides_in)
                + usize::from(self.lengths_in != stated.lengths_in)
                + usize::from(self.layout != stated.layout)
        });
        self.changes.iter().map(Change::cost).sum::<usize>() + units
    }

    /// Tells whether this is the other one with some changes left out.
    pub(super) fn is_part_of(&self, other: &Self) -> bool {
        let same = self.joints_in_degrees == other.joints_in_degrees
            && self.slides_in == other.slides_in
            && self.lengths_in == other.lengths_in
            && self.layout == other.layout;
        same && self.changes.iter().all(|change| other.changes.iter().any(|one| change.is_like(one)))
    }
}
