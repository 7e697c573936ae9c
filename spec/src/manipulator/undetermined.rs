//! Errors of an identified machine that its measurements could not determine.

use super::covariance::Identified;

/// Errors that a fit could not distinguish from those that it found.
///
/// A machine whose errors differ from the found ones by any combination of the directions explains
/// the measurements as well. At the measured points the combinations have no effect; other points
/// of the tool move by them.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Undetermined {
    /// Measured points in the last frame `F_n`, in the length unit: nominal, and as they were
    /// found.
    pub points: Vec<[f64; 3]>,
    /// Quantities of the columns.
    pub of: Vec<Identified>,
    /// Independent directions, each of one standard deviation, in the units of the quantities: the
    /// length unit, rad, or 1.
    pub rows: Vec<Vec<f64>>,
}

impl Undetermined {
    /// Returns `true` if a point of the last frame is a measured one, up to `distance`.
    pub fn has_point(&self, point: [f64; 3], distance: f64) -> bool {
        let away = |measured: &[f64; 3]| {
            point.iter().zip(measured).map(|(a, b)| (a - b).powi(2)).sum::<f64>().sqrt()
        };
        self.points.iter().any(|measured| away(measured) <= distance)
    }
}
