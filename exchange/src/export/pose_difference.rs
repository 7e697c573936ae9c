//! Differences between poses of the tool.

use abbe::{Orientation, Pose, deviation};
use serde::Serialize;

/// Size of the differences of many pairs of poses.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct PoseDifference {
    /// Distance of the tool points, in the unit of length.
    pub position: Figure,
    /// Angle between the orientations, in rad.
    pub angle: Figure,
}

/// Statistics of a difference, in the length unit or rad.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct Figure {
    /// Largest value.
    pub largest: f64,
    /// Root mean square.
    pub rms: f64,
}

impl PoseDifference {
    /// Compares the poses of each pair.
    pub(crate) fn new(pairs: impl IntoIterator<Item = [Pose; 2]>) -> Self {
        let (mut largest, mut squares, mut count) = ([0.0_f64; 2], [0.0; 2], 0_u32);
        for [from, to] in pairs {
            let [x, y, z, a, b, c] = deviation(Orientation::RotationVector, &from, &to);
            for (i, v) in [[x, y, z], [a, b, c]].into_iter().enumerate() {
                let square = v.iter().map(|v| v * v).sum::<f64>();
                // `max` would hide a NaN.
                largest[i] = if square.sqrt() <= largest[i] { largest[i] } else { square.sqrt() };
                squares[i] += square;
            }
            count += 1;
        }
        let figure =
            |i: usize| Figure { largest: largest[i], rms: (squares[i] / f64::from(count.max(1))).sqrt() };
        Self { position: figure(0), angle: figure(1) }
    }
}

#[cfg(test)]
mod tests;
