//! What an instrument saw.

use crate::Pose;

/// What was seen at one configuration, in the frame of the instrument.
#[derive(Clone, Debug, PartialEq)]
pub enum Seen {
    /// One point for each target on the end effector, none where it was hidden. The length unit.
    Points(Vec<Option<[f64; 3]>>),
    /// The whole pose of the tool.
    Pose(Pose),
}

/// One row of measurements.
#[derive(Clone, Debug, PartialEq)]
pub struct Observation {
    /// The joint variables as commanded: length unit, rad.
    pub q: Vec<f64>,
    /// The inputs: load, temperature.
    pub u: Vec<f64>,
    /// What was seen.
    pub seen: Seen,
}

impl Observation {
    /// How many numbers it holds.
    pub fn count(&self) -> usize {
        match &self.seen {
            Seen::Points(points) => 3 * points.iter().flatten().count(),
            Seen::Pose(_) => 6,
        }
    }
}

/// One standard deviation of the instrument.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Uncertainty {
    /// Of a coordinate, in the length unit.
    pub length: f64,
    /// Of an angle, rad; only poses have those.
    pub angle: f64,
}
