//! Observations: commanded configurations and their measurements, with short vectors that are
//! stored without an allocation.

use std::ops::{Deref, DerefMut};

use smallvec::SmallVec;

use abbe_core::Pose;

/// Measurement at one configuration, in the frame of the instrument.
#[derive(Clone, Debug, PartialEq)]
pub enum Measurement {
    /// One point for each target on the end effector, none where it was hidden; the length unit.
    Points(Points),
    /// Pose of the tool.
    Pose(Box<Pose>),
    /// One number for each of the model's [observables](super::Model::observables), none where it
    /// was not read.
    Readings(Vec<Option<f64>>),
}

/// One row of measurements: station, commands, measurement and weight.
///
/// A row with one point and up to six joints takes 136 bytes without an allocation, because there
/// can be a million of them.
#[derive(Clone, Debug, PartialEq)]
pub struct Observation {
    /// Line in the file, from 1.
    pub line: u64,
    /// Index of the station.
    pub station: u32,
    /// Number of the independent configuration: rows with the same number are repeated visits and
    /// share the errors that the machine has there.
    pub configuration: u32,
    /// Commanded joint variables; the length unit or rad.
    pub q: Values,
    /// Inputs, such as load and temperature.
    pub u: Inputs,
    /// Approach to the configuration, if known.
    pub approach: Option<Box<Approach>>,
    /// The measurement.
    pub measured: Measurement,
    /// Weight in sums of squares: 1 at the stated uncertainty, ¼ at twice that standard deviation.
    pub weight: f64,
}

/// Approach to a configuration.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Approach {
    /// Number of the direction or path of approach; 0 if unknown.
    pub direction: u32,
    /// Time, if known; otherwise the rows are in order of time.
    pub time: Option<f64>,
    /// Previous configuration, for readings relative to the previous row; its measurement is
    /// ignored.
    pub from: Option<Box<Observation>>,
}

impl Observation {
    /// Creates a row at the first station with weight 1, as a configuration of its own numbered as
    /// its line.
    pub fn new(line: u64, q: impl AsRef<[f64]>, u: impl Into<Inputs>, measured: Measurement) -> Self {
        Self {
            line,
            station: 0,
            q: Values::from_slice(q.as_ref()),
            u: u.into(),
            configuration: line as u32,
            approach: None,
            measured,
            weight: 1.0,
        }
    }

    /// Returns the number of the direction of approach; 0 if unknown.
    pub fn direction(&self) -> u32 {
        self.approach.as_ref().map_or(0, |approach| approach.direction)
    }

    /// Returns the time of the measurement, if known.
    pub fn time(&self) -> Option<f64> {
        self.approach.as_ref().and_then(|approach| approach.time)
    }

    /// Returns the previous configuration, if readings depend on it.
    pub fn from(&self) -> Option<&Self> {
        self.approach.as_ref().and_then(|approach| approach.from.as_deref())
    }

    /// Replaces the approach.
    pub fn approached(mut self, approach: Approach) -> Self {
        self.approach = (approach != Approach::default()).then(|| Box::new(approach));
        self
    }

    /// Returns the approach for modification.
    pub fn approach_mut(&mut self) -> &mut Approach {
        self.approach.get_or_insert_default()
    }

    /// Returns the indices of the measured numbers among all that the row can have.
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

    /// Returns the number of measured numbers: three for each visible target, six for a pose, one
    /// for each reading.
    pub fn count(&self) -> usize {
        match &self.measured {
            Measurement::Points(points) => 3 * points.iter().flatten().count(),
            Measurement::Pose(_) => 6,
            Measurement::Readings(readings) => readings.iter().flatten().count(),
        }
    }
}

/// Standard deviations of the instrument.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Uncertainty {
    /// Standard deviation of a coordinate, in the length unit.
    pub length: f64,
    /// Standard deviation of an angle of a pose, in rad.
    pub angle: f64,
}

/// Values of the joints, stored inline up to six.
pub type Values = SmallVec<[f64; 6]>;

/// Values of the inputs. Most machines have none.
pub type Inputs = Box<[f64]>;

/// Positions of the targets, none where one was hidden: a slice of points, a single one stored
/// inline.
#[derive(Clone, Debug, PartialEq)]
pub struct Points(Seen);

#[derive(Clone, Debug, PartialEq)]
enum Seen {
    One(Option<[f64; 3]>),
    Many(Box<[Option<[f64; 3]>]>),
}

impl Deref for Points {
    type Target = [Option<[f64; 3]>];

    fn deref(&self) -> &[Option<[f64; 3]>] {
        match &self.0 {
            Seen::One(point) => std::slice::from_ref(point),
            Seen::Many(points) => points,
        }
    }
}

impl DerefMut for Points {
    fn deref_mut(&mut self) -> &mut [Option<[f64; 3]>] {
        match &mut self.0 {
            Seen::One(point) => std::slice::from_mut(point),
            Seen::Many(points) => points,
        }
    }
}

impl From<Vec<Option<[f64; 3]>>> for Points {
    fn from(points: Vec<Option<[f64; 3]>>) -> Self {
        match points[..] {
            [point] => Self(Seen::One(point)),
            _ => Self(Seen::Many(points.into())),
        }
    }
}

impl FromIterator<Option<[f64; 3]>> for Points {
    fn from_iter<I: IntoIterator<Item = Option<[f64; 3]>>>(points: I) -> Self {
        points.into_iter().collect::<Vec<_>>().into()
    }
}

#[cfg(test)]
mod tests;
