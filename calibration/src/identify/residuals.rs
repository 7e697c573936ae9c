//! Residuals: model minus measurement, and their derivatives with respect to the unknowns.
//!
//! Known distances of fixtures have rows of one number each, beside those of the observations.

use super::columns::turned;
use super::{
    EvaluatedModel, Failure, FixtureGeometry, Measurement, Model, Observation, ReferenceLength, Result,
    Unknown,
};
use abbe_analysis::sampling::vectors::{dot, subtract as difference, unit};
use abbe_core::{Error, Pose, Quantity, rotation_vector};

impl EvaluatedModel<'_> {
    /// Returns the value of each of the [observables](super::Model::observables); ignores the
    /// measurement.
    pub fn values(&mut self, observation: &Observation) -> Result<Vec<f64>> {
        self.chain(observation)?;
        let geometry = self.geometry();
        Ok((0..self.model.observables.len()).map(|i| self.evaluate(&geometry, i).value).collect())
    }

    /// Passes the residuals at `x` to `take`, one by one, in units of the uncertainty of the
    /// observation.
    ///
    /// There are three for each visible target, six for a pose (position, then rotation vector),
    /// one for each reading.
    pub(super) fn residuals(&mut self, observation: &Observation, mut take: impl FnMut(f64)) -> Result<()> {
        self.numbers::<false>(observation, |residual, _, _| take(residual))
    }

    /// Passes each residual and its derivatives with respect to all unknowns to `row`.
    pub(super) fn linear(
        &mut self,
        observation: &Observation,
        mut row: impl FnMut(f64, &[f64]),
    ) -> Result<()> {
        self.numbers::<true>(observation, |residual, derivatives, _| row(residual, derivatives))
    }

    /// Passes each residual, its derivatives with respect to all unknowns, and the part of these
    /// that the row before it contributes, to `row`; that part is empty for a number that refers to
    /// no other row.
    ///
    /// A reading `g(here) − g(there)` has the derivatives `here − there`, and `−there` is the part.
    pub(super) fn linear_by_row(
        &mut self,
        observation: &Observation,
        row: impl FnMut(f64, &[f64], &[f64]),
    ) -> Result<()> {
        self.numbers::<true>(observation, row)
    }

    /// Calls `row(residual, derivatives, part of the row before)` for each number; without
    /// derivatives unless `DERIVED`.
    fn numbers<const DERIVED: bool>(
        &mut self,
        observation: &Observation,
        mut row: impl FnMut(f64, &[f64], &[f64]),
    ) -> Result<()> {
        let model = self.model;
        self.chain(observation)?;
        let weight = observation.weight.sqrt();
        let [length, angle] = [model.uncertainty.length, model.uncertainty.angle].map(|sigma| weight / sigma);
        let last = self.tool_pose();
        let mut lines = core::mem::take(&mut self.lines);
        let derived = if DERIVED { model.unknowns.len() } else { 0 };
        match &observation.measured {
            Measurement::Points(points) => {
                for (j, measured) in points.iter().enumerate() {
                    let Some(measured) = measured else { continue };
                    let point = last.apply(self.target(observation, j)?);
                    let target = self.first_target + j;
                    fill(&mut lines, derived, |k| self.point(k, target, point).map(|moved| moved * length));
                    for axis in 0..3 {
                        row((point[axis] - measured[axis]) * length, &lines[axis], &[]);
                    }
                }
            }
            Measurement::Pose(measured) => {
                let point = last.position();
                let place = |k| self.point(k, usize::MAX, point).map(|moved| moved * length);
                fill(&mut lines, derived, place);
                for axis in 0..3 {
                    row((point[axis] - measured.0[3][axis]) * length, &lines[axis], &[]);
                }
                let mut difference = last.then(&measured.inverse());
                difference.0[3] = [0.0; 3];
                let turn = rotation_vector(&difference);
                fill(&mut lines, derived, |k| turned(turn, self.turn(k)).map(|turned| turned * angle));
                for axis in 0..3 {
                    row(turn[axis] * angle, &lines[axis], &[]);
                }
            }
            Measurement::Readings(values) => {
                let geometry = self.geometry();
                let size = self.relative_size();
                for (i, measured) in values.iter().enumerate().take(model.observables.len()) {
                    let Some(measured) = measured else { continue };
                    let size = size.filter(|_| model.observables[i].is_blind_to_size());
                    let share = size.map_or(1.0, |size| size.share);
                    let unit = weight / (model.observables[i].uncertainty * share);
                    let evaluation = self.evaluate(&geometry, i);
                    let along = geometry.base.turn(evaluation.along);
                    let derivative = |k| self.observable_derivative(i, &evaluation, along, k);
                    fill(&mut lines, derived, |k| {
                        let [here, there] = derivative(k);
                        [(here - there) * unit, -there * unit, 0.0]
                    });
                    let residual = (evaluation.value - measured) * unit;
                    if let (true, Some(size)) = (DERIVED, size) {
                        // d(r/g) = dr/g − r dg/g², with g = 1 + e/l.
                        lines[0][size.unknown] -= residual / (size.share * size.length);
                    }
                    row(residual, &lines[0], &lines[1]);
                }
            }
        }
        self.lines = lines;
        Ok(())
    }

    /// Returns the size of the machine relative to the nominal one; none if it is not among the
    /// unknowns.
    fn relative_size(&self) -> Option<RelativeSize> {
        let ReferenceLength { error, length } = self.model.reference_length?;
        let unknown = self.model.unknowns.iter().position(|unknown| *unknown == error)?;
        Some(RelativeSize { unknown, share: 1.0 + self.x.get(unknown)? / length, length })
    }

    /// Returns the position of target `j` of the row's placement in the frame of the tool.
    pub(super) fn target(&self, observation: &Observation, j: usize) -> Result<[f64; 3]> {
        let found = || match &observation.measured {
            Measurement::Points(points) => points.len(),
            _ => 0,
        };
        let targets = &self.targets[self.model.targets_of(self.placement)];
        targets.get(j).copied().ok_or_else(|| Failure::Observation {
            line: observation.line,
            error: Error::Count { quantity: Quantity::Pose, expected: targets.len(), found: found() },
        })
    }

    /// Returns measurement minus model at `x` for each number, and the derivatives of the model, in
    /// units of the uncertainty.
    pub fn linearized(&mut self, observation: &Observation) -> Result<Vec<(f64, Vec<f64>)>> {
        let mut numbers = Vec::new();
        self.linear(observation, |residual, row| numbers.push((-residual, row.to_vec())))?;
        Ok(numbers)
    }

    /// Returns measurement minus model at `x` for each number, in units of the uncertainty.
    pub fn differences(&mut self, observation: &Observation) -> Result<Vec<f64>> {
        let mut numbers = Vec::new();
        self.residuals(observation, |residual| numbers.push(-residual))?;
        Ok(numbers)
    }

    /// Returns the pose of the tool, and the derivatives of its point with respect to each unknown.
    pub fn tool(&mut self, observation: &Observation) -> Result<(Pose, Vec<[f64; 3]>)> {
        let pose = self.pose(observation)?;
        let moves = (0..self.model.unknowns.len()).map(|k| self.point(k, usize::MAX, pose.position()));
        Ok((pose, moves.collect()))
    }
}

/// Size of the machine by its [reference length](ReferenceLength).
#[derive(Clone, Copy)]
struct RelativeSize {
    /// Index of the error of the length.
    unknown: usize,
    /// `1 + e/l`.
    share: f64,
    /// `l`.
    length: f64,
}

/// Fills the derivatives of three numbers with respect to `count` unknowns.
#[inline]
fn fill(lines: &mut [Vec<f64>; 3], count: usize, three: impl Fn(usize) -> [f64; 3]) {
    lines.iter_mut().for_each(|line| line.resize(count, 0.0));
    let [a, b, c] = lines;
    for (k, ((a, b), c)) in a.iter_mut().zip(b).zip(c).enumerate() {
        [*a, *b, *c] = three(k);
    }
}

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
