//! What an instrument tells.

use crate::Pose;

/// What was measured at one configuration, in the frame of the instrument.
#[derive(Clone, Debug, PartialEq)]
pub enum Measurement {
    /// One point for each target on the end effector, none where it was hidden. The length unit.
    Points(Vec<Option<[f64; 3]>>),
    /// The whole pose of the tool.
    Pose(Pose),
    /// One number for each of the model's [readings](super::Model::readings), none where there was none.
    Readings(Vec<Option<f64>>),
}

/// One row of measurements: where it stands, what was commanded, what was measured, what it weighs.
#[derive(Clone, Debug, PartialEq)]
pub struct Observation {
    /// Its line in the file, from 1: what messages call it by.
    pub line: u64,
    /// The station where it was measured, from 0.
    pub station: usize,
    /// The joint variables as commanded: length unit, rad.
    pub q: Vec<f64>,
    /// The inputs: load, temperature.
    pub u: Vec<f64>,
    /// Which independent configuration it belongs to: rows with the same number are visits of one, and share the errors
    /// that the machine has there.
    pub configuration: usize,
    /// From which direction or along which path it was approached, as a number; 0 where nobody says.
    pub direction: usize,
    /// When it was measured, if that is known; rows are in the order of time otherwise.
    pub time: Option<f64>,
    /// Where the machine was before, for readings of how far it moved since: what was measured there does not matter.
    pub from: Option<Box<Observation>>,
    /// What was measured.
    pub measured: Measurement,
    /// Its weight in sums of squares: 1 where the instrument is as good as stated, ¼ where its standard deviation is twice
    /// that.
    pub weight: f64,
}

impl Observation {
    /// A row at the first station, as good as the instrument is stated to be, and a configuration of its own: numbered as
    /// its line.
    pub fn new(line: u64, q: Vec<f64>, u: Vec<f64>, measured: Measurement) -> Self {
        Self {
            line,
            station: 0,
            q,
            u,
            configuration: line as usize,
            direction: 0,
            time: None,
            from: None,
            measured,
            weight: 1.0,
        }
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
