//! Circular tests by ISO 230-4, and radial error motion of an axis of rotation by ISO 230-7.
//!
//! With the mean `r̄_i` of `n_i` readings of the radius at the angle `θ_i`:
//!
//! ```text
//! (R, x, y) = argmin Σ_i (r̄_i − R − x cos θ_i − y sin θ_i)²     ρ_i = r̄_i − x cos θ_i − y sin θ_i
//! F_max = max ρ_i      F_min = min ρ_i      G = F_max − F_min
//! H = max |r̄_i↑ − r̄_i↓|      D = R of both directions      G(b) = G of both directions
//! ```
//!
//! G of one direction is the synchronous error motion of ISO 230-7.

use abbe::analysis::sampling::range_of;
use nalgebra::DMatrix;
use serde::Serialize;

use super::evaluation::{Characteristic, Evaluation, InstrumentUncertainty, Statistics, Sum};
use crate::data::TargetRuns;

/// Results of a circular test. Values are in um.
#[derive(Clone, Debug, Serialize)]
pub struct CircularResult {
    /// Path in the direction of rising angles, counterclockwise; none without its readings.
    pub forward: Option<CircularPath>,
    /// Path clockwise.
    pub reverse: Option<CircularPath>,
    /// Bidirectional circular deviation `G(b)`; none unless there are both directions.
    pub circularity: Option<Characteristic>,
    /// Circular hysteresis `H`; none unless every angle has both directions.
    pub hysteresis: Option<Characteristic>,
    /// Mean bidirectional radial deviation `D`.
    pub mean: Option<Characteristic>,
}

/// Results of one direction. Values are in um, about the centre of the least-squares circle.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct CircularPath {
    /// Coordinates x and y of the centre, in `unit`.
    pub center: [f64; 2],
    /// Circular deviation `G`, the synchronous error motion of an axis of rotation.
    pub circularity: Characteristic,
    /// Largest radial deviation `F_max`.
    pub largest: Characteristic,
    /// Smallest radial deviation `F_min`.
    pub smallest: Characteristic,
    /// Asynchronous error motion, in `unit`: the largest range of readings at one angle; none
    /// unless each has several.
    pub asynchronous: Option<f64>,
    /// Total error motion, in `unit`: the range of all readings; none unless each angle has
    /// several.
    pub total: Option<f64>,
}

/// The circle of least squares of means.
struct Circle<'a> {
    statistics: &'a Statistics<'a>,
    /// Position and direction of each mean.
    places: Vec<(usize, usize)>,
    /// Weights of the means in R, x and y.
    weights: DMatrix<f64>,
}

impl<'a> Circle<'a> {
    /// Fits a circle to the means of some directions; `None` if they have few angles or are missing
    /// in half of it or more.
    fn new(statistics: &'a Statistics<'a>, directions: &[usize]) -> Option<Self> {
        let all = directions.iter().flat_map(|d| (0..statistics.positions.len()).map(move |i| (i, *d)));
        let places: Vec<_> = all.filter(|(i, d)| statistics.approach(*i, *d).is_some()).collect();
        let angle = |k: usize| statistics.positions[places[k].0].position;
        let mut angles: Vec<f64> = (0..places.len()).map(|k| angle(k).rem_euclid(360.0)).collect();
        angles.sort_by(f64::total_cmp);
        angles.dedup_by(|next, angle| *next - *angle < 1e-6);
        let behind = angles.iter().skip(1).copied().chain([angles.first()? + 360.0]);
        // Three angles always lie on a circle.
        if angles.len() < 4 || angles.iter().zip(behind).any(|(angle, next)| next - angle >= 180.0) {
            return None;
        }
        let terms = |angle: f64| [1.0, angle.to_radians().cos(), angle.to_radians().sin()];
        let design = DMatrix::from_fn(places.len(), 3, |k, term| terms(angle(k))[term]);
        let weights = (design.transpose() * &design).try_inverse()? * design.transpose();
        Some(Self { statistics, places, weights })
    }

    /// Returns the sum of the coordinates R, x and y, times factors.
    fn coordinates(&self, factors: [f64; 3]) -> Sum {
        let weight = |of: &DMatrix<f64>, k: usize| (0..3).map(|i| factors[i] * of[(i, k)]).sum();
        let means = self.places.iter().enumerate().map(|(k, (i, d))| (weight(&self.weights, k), *i, *d));
        Sum { means: means.collect(), ..Sum::default() }
    }

    /// Returns x and y.
    fn center(&self) -> Option<[f64; 2]> {
        let [x, y] =
            [[0.0, 1.0, 0.0], [0.0, 0.0, 1.0]].map(|one| self.statistics.value(&self.coordinates(one)));
        Some([x?, y?])
    }

    /// Returns F_max, F_min and G, in time proportional to the number of means.
    fn extremes(&self) -> Option<[Characteristic; 3]> {
        let center = self.center()?;
        let angle = |i: usize| self.statistics.positions[i].position;
        let mean = |(i, d): &(usize, usize)| self.statistics.approach(*i, *d).map_or(0.0, |own| own.mean);
        let radial = |place: &(usize, usize)| mean(place) - shift(center, angle(place.0));
        let by = |a: &&_, b: &&_| radial(a).total_cmp(&radial(b));
        let places = [self.places.iter().max_by(by)?, self.places.iter().min_by(by)?];
        let [most, least] = places.map(|(i, d)| {
            let (sine, cosine) = angle(*i).to_radians().sin_cos();
            Sum::mean(1.0, *i, *d).plus(self.coordinates([0.0, -cosine, -sine]))
        });
        let [largest, smallest] = [&most, &least].map(|sum| self.statistics.characteristic(sum));
        Some([largest?, smallest?, self.statistics.characteristic(&most.plus(least.times(-1.0)))?])
    }
}

/// Returns x cos θ + y sin θ of an angle in degrees.
fn shift([x, y]: [f64; 2], angle: f64) -> f64 {
    x * angle.to_radians().cos() + y * angle.to_radians().sin()
}

impl CircularResult {
    /// Evaluates readings of the radius, in um, at angles in degrees; `None` if a direction has few
    /// angles or none in half of the circle or more. `reading` is the uncertainty of one.
    pub(super) fn new(targets: &[TargetRuns], reading: Option<f64>) -> Option<Self> {
        let Evaluation { positions, .. } = Evaluation::of_positions(targets);
        let uncertainty = reading.map(|reading| InstrumentUncertainty { reading, scale: 0.0 });
        let statistics = Statistics { positions: &positions, uncertainty };
        let path = |d: usize| match targets.iter().any(|target| !target.deviations[d].is_empty()) {
            true => CircularPath::new(targets, &statistics, d).map(Some),
            false => Some(None),
        };
        let [forward, reverse] = [path(0)?, path(1)?];
        let mut found = Self { forward, reverse, circularity: None, hysteresis: None, mean: None };
        if forward.and(reverse).is_some() {
            let circle = Circle::new(&statistics, &[0, 1])?;
            found.circularity = circle.extremes().map(|[.., range]| range);
            found.mean = statistics.characteristic(&circle.coordinates([1.0, 0.0, 0.0]));
            found.hysteresis = statistics.reversal();
        }
        Some(found)
    }
}

impl CircularPath {
    fn new(targets: &[TargetRuns], statistics: &Statistics<'_>, side: usize) -> Option<Self> {
        let circle = Circle::new(statistics, &[side])?;
        let [largest, smallest, circularity] = circle.extremes()?;
        let center = circle.center()?;
        let of = |target: &TargetRuns| {
            let shift = shift(center, target.position);
            target.deviations[side].iter().map(move |reading| reading - shift).collect::<Vec<f64>>()
        };
        let measured = || targets.iter().map(of).filter(|own| !own.is_empty());
        let has_several = measured().all(|own| own.len() > 1);
        let ranges = measured().map(|own| range_of(own.into_iter())).map(|[least, most]| most - least);
        let [least, most] = range_of(measured().flatten());
        Some(Self {
            center,
            circularity,
            largest,
            smallest,
            asynchronous: has_several.then(|| ranges.fold(0.0, f64::max)),
            total: has_several.then_some(most - least),
        })
    }
}

#[cfg(test)]
mod tests;
