//! What an instrument tells.

use super::values::{Inputs, Points, Values};
use abbe_core::Pose;

/// What was measured at one configuration, in the frame of the instrument.
#[derive(Clone, Debug, PartialEq)]
pub enum Measurement {
    /// One point for each target on the end effector, none where it was hidden. The length unit.
    Points(Points),
    /// The whole pose of the tool.
    Pose(Box<Pose>),
    /// One number for each of the model's [readings](super::Model::readings), none where there was none.
    Readings(Vec<Option<f64>>),
}

/// One row of measurements: where it stands, what was commanded, what was measured, what it weighs.
///
/// Of a point that was measured of an arm with up to seven joints it is 136 bytes, and nothing elsewhere: there may be a
/// million of them.
#[derive(Clone, Debug, PartialEq)]
pub struct Observation {
    /// Its line in the file, from 1: what messages call it by.
    pub line: u64,
    /// The station where it was measured, from 0.
    pub station: u32,
    /// Which independent configuration it belongs to: rows with the same number are visits of one, and share the errors
    /// that the machine has there.
    pub configuration: u32,
    /// The joint variables as commanded: length unit, rad.
    pub q: Values,
    /// The inputs: load, temperature.
    pub u: Inputs,
    /// How the machine came there; none where nobody says.
    pub approach: Option<Box<Approach>>,
    /// What was measured.
    pub measured: Measurement,
    /// Its weight in sums of squares: 1 where the instrument is as good as stated, ¼ where its standard deviation is twice
    /// that.
    pub weight: f64,
}

/// How the machine came to a configuration.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Approach {
    /// From which direction or along which path, as a number; 0 where nobody says.
    pub direction: u32,
    /// When, if that is known; rows are in the order of time otherwise.
    pub time: Option<f64>,
    /// Where the machine was before, for readings of how far it moved since: what was measured there does not matter.
    pub from: Option<Box<Observation>>,
}

impl Observation {
    /// A row at the first station, as good as the instrument is stated to be, and a configuration of its own: numbered as
    /// its line.
    pub fn new(line: u64, q: impl Into<Values>, u: impl Into<Inputs>, measured: Measurement) -> Self {
        Self {
            line,
            station: 0,
            q: q.into(),
            u: u.into(),
            configuration: line as u32,
            approach: None,
            measured,
            weight: 1.0,
        }
    }

    /// From which direction it was approached, as a number; 0 where nobody says.
    pub fn direction(&self) -> u32 {
        self.approach.as_ref().map_or(0, |approach| approach.direction)
    }

    /// When it was measured, if that is known.
    pub fn time(&self) -> Option<f64> {
        self.approach.as_ref().and_then(|approach| approach.time)
    }

    /// Where the machine was before, if that matters.
    pub fn from(&self) -> Option<&Self> {
        self.approach.as_ref().and_then(|approach| approach.from.as_deref())
    }

    /// The same with another way there.
    pub fn approached(mut self, approach: Approach) -> Self {
        self.approach = (approach != Approach::default()).then(|| Box::new(approach));
        self
    }

    /// How it was approached, to be changed.
    pub fn approach_mut(&mut self) -> &mut Approach {
        self.approach.get_or_insert_default()
    }

    /// Which numbers were measured, among all that such a row can have.
    pub(super) fn places(&self) -> Vec<usize> {
        let measured = |(place, number): (usize, &Option<f64>)| number.map(|_| place);
        match &self.measured {
            Measurement::Points(points) => {
                let points = points.iter().enumerate().filter(|(_, point)| point.is_some());
                points.flat_map(|(j, _)| 3 * j..3 * j + 3).collect()
            }
            Measurement::Pose(_) => (0..6).collect(),
            Measurement::Readings(readings) => readings.iter().enumerate().filter_map(measured).collect(),
        }
    }

    /// How many numbers were measured: three for every target that was not hidden, six for a pose, one for a reading.
    pub fn count(&self) -> usize {
        match &self.measured {
            Measurement::Points(points) => 3 * points.iter().flatten().count(),
            Measurement::Pose(_) => 6,
            Measurement::Readings(readings) => readings.iter().flatten().count(),
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

#[cfg(test)]
mod tests {
    use super::{Approach, Measurement, Observation};

    /// What a million rows take is this million times.
    #[test]
    fn a_row_is_small() {
        assert_eq!(size_of::<Measurement>(), 32);
        assert_eq!(size_of::<Observation>(), 136);
        assert_eq!(size_of::<Approach>(), 32);
    }
}
