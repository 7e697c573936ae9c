//! Residuals: model minus measurement, and their derivatives with respect to the unknowns.

use super::columns::turned;
use super::scratch::Scratch;
use super::{Failure, Measurement, Model, Observation, ReferenceLength};
use abbe_core::{Error, Pose, Quantity, rotation_vector};

impl Model<'_> {
    /// Returns the value of each of the [observables](Self::observables); ignores the measurement.
    pub fn values(
        &self,
        scratch: &mut Scratch,
        observation: &Observation,
        x: &[f64],
    ) -> Result<Vec<f64>, Failure> {
        self.chain(scratch, observation, x)?;
        let geometry = self.geometry(scratch);
        Ok((0..self.observables.len()).map(|i| self.evaluate(scratch, &geometry, i).value).collect())
    }

    /// Passes the residuals at `x` to `take`, one by one, in units of the uncertainty of the
    /// observation.
    ///
    /// There are three for each visible target, six for a pose (position, then rotation vector),
    /// one for each reading.
    pub(super) fn residuals(
        &self,
        scratch: &mut Scratch,
        observation: &Observation,
        x: &[f64],
        mut take: impl FnMut(f64),
    ) -> Result<(), Failure> {
        self.numbers::<false>(scratch, observation, x, |residual, _, _| take(residual))
    }

    /// Passes each residual and its derivatives with respect to all unknowns to `row`.
    pub(super) fn linear(
        &self,
        scratch: &mut Scratch,
        observation: &Observation,
        x: &[f64],
        mut row: impl FnMut(f64, &[f64]),
    ) -> Result<(), Failure> {
        self.numbers::<true>(scratch, observation, x, |residual, derivatives, _| row(residual, derivatives))
    }

    /// Passes each residual, its derivatives with respect to all unknowns, and the part of these
    /// that the row before it contributes, to `row`; that part is empty for a number that refers to
    /// no other row.
    ///
    /// A reading `g(here) − g(there)` has the derivatives `here − there`, and `−there` is the part.
    pub(super) fn linear_by_row(
        &self,
        scratch: &mut Scratch,
        observation: &Observation,
        x: &[f64],
        row: impl FnMut(f64, &[f64], &[f64]),
    ) -> Result<(), Failure> {
        self.numbers::<true>(scratch, observation, x, row)
    }

    /// Calls `row(residual, derivatives, part of the row before)` for each number; without
    /// derivatives unless `DERIVED`.
    fn numbers<const DERIVED: bool>(
        &self,
        scratch: &mut Scratch,
        observation: &Observation,
        x: &[f64],
        mut row: impl FnMut(f64, &[f64], &[f64]),
    ) -> Result<(), Failure> {
        self.chain(scratch, observation, x)?;
        let weight = observation.weight.sqrt();
        let [length, angle] = [self.uncertainty.length, self.uncertainty.angle].map(|sigma| weight / sigma);
        let last = scratch.tool();
        let mut lines = core::mem::take(&mut scratch.lines);
        let derived = if DERIVED { self.unknowns.len() } else { 0 };
        match &observation.measured {
            Measurement::Points(points) => {
                for (j, measured) in points.iter().enumerate() {
                    let Some(measured) = measured else { continue };
                    let point = last.apply(self.target(scratch, observation, j)?);
                    let target = scratch.first_target + j;
                    fill(&mut lines, derived, |k| {
                        self.point(scratch, k, target, point).map(|moved| moved * length)
                    });
                    for axis in 0..3 {
                        row((point[axis] - measured[axis]) * length, &lines[axis], &[]);
                    }
                }
            }
            Measurement::Pose(measured) => {
                let point = last.position();
                let place = |k| self.point(scratch, k, usize::MAX, point).map(|moved| moved * length);
                fill(&mut lines, derived, place);
                for axis in 0..3 {
                    row((point[axis] - measured.0[3][axis]) * length, &lines[axis], &[]);
                }
                let mut difference = last.then(&measured.inverse());
                difference.0[3] = [0.0; 3];
                let turn = rotation_vector(&difference);
                fill(&mut lines, derived, |k| {
                    turned(turn, self.turn(scratch, k)).map(|turned| turned * angle)
                });
                for axis in 0..3 {
                    row(turn[axis] * angle, &lines[axis], &[]);
                }
            }
            Measurement::Readings(values) => {
                let geometry = self.geometry(scratch);
                let size = self.relative_size(x);
                for (i, measured) in values.iter().enumerate().take(self.observables.len()) {
                    let Some(measured) = measured else { continue };
                    let size = size.filter(|_| self.observables[i].is_blind_to_size());
                    let share = size.map_or(1.0, |size| size.share);
                    let unit = weight / (self.observables[i].uncertainty * share);
                    let evaluation = self.evaluate(scratch, &geometry, i);
                    let along = geometry.base.turn(evaluation.along);
                    let derivative = |k| self.observable_derivative(scratch, i, &evaluation, along, k);
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
        scratch.lines = lines;
        Ok(())
    }

    /// Returns the size of the machine relative to the nominal one; none if it is not among the
    /// unknowns.
    fn relative_size(&self, x: &[f64]) -> Option<RelativeSize> {
        let ReferenceLength { error, length } = self.reference_length?;
        let unknown = self.unknowns.iter().position(|unknown| *unknown == error)?;
        Some(RelativeSize { unknown, share: 1.0 + x.get(unknown)? / length, length })
    }

    /// Returns the position of target `j` of the row's placement in the frame of the tool.
    pub(super) fn target(
        &self,
        scratch: &Scratch,
        observation: &Observation,
        j: usize,
    ) -> Result<[f64; 3], Failure> {
        let found = || match &observation.measured {
            Measurement::Points(points) => points.len(),
            _ => 0,
        };
        let targets = &scratch.targets[self.targets_of(scratch.placement)];
        targets.get(j).copied().ok_or_else(|| Failure::Observation {
            line: observation.line,
            error: Error::Count { quantity: Quantity::Pose, expected: targets.len(), found: found() },
        })
    }

    /// Returns measurement minus model at `x` for each number, and the derivatives of the model, in
    /// units of the uncertainty.
    pub fn linearized(
        &self,
        scratch: &mut Scratch,
        observation: &Observation,
        x: &[f64],
    ) -> Result<Vec<(f64, Vec<f64>)>, Failure> {
        let mut numbers = Vec::new();
        self.linear(scratch, observation, x, |residual, row| numbers.push((-residual, row.to_vec())))?;
        Ok(numbers)
    }

    /// Returns measurement minus model at `x` for each number, in units of the uncertainty.
    pub fn differences(
        &self,
        scratch: &mut Scratch,
        observation: &Observation,
        x: &[f64],
    ) -> Result<Vec<f64>, Failure> {
        let mut numbers = Vec::new();
        self.residuals(scratch, observation, x, |residual| numbers.push(-residual))?;
        Ok(numbers)
    }

    /// Returns the pose of the tool, and the derivatives of its point with respect to each unknown.
    pub fn tool(
        &self,
        scratch: &mut Scratch,
        observation: &Observation,
        x: &[f64],
    ) -> Result<(Pose, Vec<[f64; 3]>), Failure> {
        let pose = self.pose(scratch, observation, x)?;
        let moves = (0..self.unknowns.len()).map(|k| self.point(scratch, k, usize::MAX, pose.position()));
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
