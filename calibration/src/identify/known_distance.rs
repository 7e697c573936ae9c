//! Rows of the known distances of fixtures: one number each, beside those of the observations.

use super::{FixtureGeometry, Model, Observation, Unknown};
use abbe_analysis::sampling::vectors::{dot, subtract as difference, unit};

impl Model<'_> {
    /// Passes the residual of each known distance at `x`, in units of its uncertainty, and its
    /// derivatives with respect to all unknowns to `row`.
    ///
    /// `r = (|c_a − c_b| − d)/σ`, `∂r/∂c_a = −∂r/∂c_b = (c_a − c_b)/(|c_a − c_b| σ)`.
    pub(super) fn distance_rows(&self, x: &[f64], mut row: impl FnMut(f64, &[f64])) {
        for known in &self.known_distances {
            let [a, b] = known.fixtures;
            let apart = difference(self.fixture_at(a, x), self.fixture_at(b, x));
            let along = unit(apart).map(|v| v / known.uncertainty);
            let derivative = |unknown: &Unknown| match *unknown {
                Unknown::Fixture(f, coordinate) if f == a => along[coordinate],
                Unknown::Fixture(f, coordinate) if f == b => -along[coordinate],
                _ => 0.0,
            };
            let derivatives: Vec<f64> = self.unknowns.iter().map(derivative).collect();
            row((dot(apart, apart).sqrt() - known.length) / known.uncertainty, &derivatives);
        }
    }

    /// Returns the residual of each known distance, in units of its uncertainty.
    pub fn distance_residuals(&self, x: &[f64]) -> Vec<f64> {
        let mut residuals = Vec::new();
        self.distance_rows(x, |residual, _| residuals.push(residual));
        residuals
    }

    /// Returns the number of measured numbers, with the known distances.
    pub(super) fn count<'o>(&self, data: impl Iterator<Item = &'o Observation>) -> usize {
        data.map(Observation::count).sum::<usize>() + self.known_distances.len()
    }

    /// Returns the position of a fixture; zero for a direction.
    fn fixture_at(&self, fixture: usize, x: &[f64]) -> [f64; 3] {
        let value = |coordinate| {
            let unknown = Unknown::Fixture(fixture, coordinate);
            self.unknowns.iter().position(|one| *one == unknown).map_or(0.0, |k| x[k])
        };
        match self.fixtures[fixture].geometry.displaced(&[value(0), value(1), value(2)]) {
            FixtureGeometry::Point(point) => point,
            FixtureGeometry::Direction(_) => [0.0; 3],
        }
    }
}
