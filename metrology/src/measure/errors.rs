//! ΔX of each row, equation (5): measured minus ideal.

use abbe::analysis::sampling::norm;
use abbe::identify::{Failure, Measurement, Model, Observation, register};
use abbe::{Orientation, Pose, deviation};

use crate::{data::Data, identify::Setup};
use abbe_study::{Result, mistake};

/// A row and its error.
#[derive(Clone, Debug)]
pub struct RowError {
    /// Command and measurement.
    pub observation: Observation,
    /// x, y, z of the tool point, then the rotation vector if orientations were measured, in the
    /// axes of the instrument.
    pub error: [f64; 6],
    /// Measured tool point.
    pub point: [f64; 3],
    /// Measured minus predicted by the machine with its repeatable sources, in the order of
    /// `error`.
    pub residual: [f64; 6],
}

/// A visit of a configuration.
#[derive(Clone, Copy, Debug)]
pub(super) struct Visit {
    pub(super) configuration: u32,
    /// Number of the direction of approach.
    pub(super) direction: u32,
    /// Time; 0 if unknown.
    pub(super) time: f64,
    /// Error as in [`RowError`].
    pub(super) error: [f64; 6],
    pub(super) point: [f64; 3],
}

impl Visit {
    pub(super) fn new(&RowError { ref observation, error, point, .. }: &RowError) -> Self {
        let (direction, time) = (observation.direction(), observation.time().unwrap_or_default());
        Self { configuration: observation.configuration, direction, time, error, point }
    }
}

impl RowError {
    /// Returns the predicted tool point.
    pub fn predicted(&self) -> [f64; 3] {
        std::array::from_fn(|i| self.point[i] - self.residual[i])
    }

    /// Returns the norm of the position error.
    pub fn distance(&self) -> f64 {
        norm([self.error[0], self.error[1], self.error[2]])
    }
}

/// Moves the tool point of a model to its target, if that is the only one on the tool: the position
/// of the target is not an error.
pub(super) fn at_single_target<'a>(model: &Model<'a>) -> Model<'a> {
    if model.targets_of(0).len() != 1 {
        return model.clone();
    }
    let (mut mountings, targets) = (model.mountings.clone(), vec![[0.0; 3]; model.targets.len()]);
    for (mounting, point) in mountings.iter_mut().zip(model.mounted(&model.targets)) {
        mounting.0[3] = point;
    }
    Model { mountings, targets, ..model.clone() }
}

/// Error (position, then rotation vector) and measured tool point.
type Seen = ([f64; 6], [f64; 3]);

/// Computes the errors of rows one at a time.
pub(super) struct Errors<'a> {
    model: Model<'a>,
    /// The machine with its repeatable sources.
    real: Model<'a>,
}

impl<'a> Errors<'a> {
    pub(super) fn new(setup: &Setup<'a>) -> Self {
        let [model, real] = [&setup.ideal, &setup.real].map(at_single_target);
        Self { model, real }
    }

    /// Returns the error and the measured tool point of a row; none if fewer than three targets are
    /// visible.
    pub(super) fn at(&self, row: &Observation) -> Result<Option<Seen>, Failure> {
        let ideal = self.model.at(&[]).pose(row)?;
        let real = pose(&self.model, row, &ideal);
        Ok(real.map(|real| (deviation(Orientation::RotationVector, &ideal, &real), real.position())))
    }

    /// Returns the error of a row that shows the tool.
    pub(super) fn row_error(&self, row: &Observation) -> Result<RowError, Failure> {
        let (error, point) = self.at(row)?.unwrap_or_default();
        let predicted = self.real.at(&[]).pose(row)?;
        let measured = pose(&self.real, row, &predicted).unwrap_or(predicted);
        let residual = deviation(Orientation::RotationVector, &predicted, &measured);
        Ok(RowError { observation: row.clone(), error, point, residual })
    }
}

/// Moves rows that do not determine the pose of the tool to the unusable ones.
pub(super) fn leave_out(setup: &Setup, data: &mut Data) -> Result<()> {
    let errors = Errors::new(setup);
    let (mut failed, mut hidden) = (None, Vec::new());
    data.observations.retain(|row| match errors.at(row) {
        Ok(Some(_)) => true,
        Ok(None) => {
            hidden.push(row.line);
            false
        }
        Err(failure) => {
            failed.get_or_insert(failure);
            true
        }
    });
    if let Some(failure) = failed {
        return Err(mistake::whole(&data.file, &failure));
    }
    for line in hidden {
        data.leave_out(line, "fewer than three targets were measured, so the pose is unknown");
    }
    if data.observations.is_empty() {
        let help = "a pose needs three targets";
        return Err(mistake::with_help(&data.file, "no row has three measured targets", help));
    }
    Ok(())
}

/// Returns the measured pose of the tool; a single point takes the ideal orientation.
pub(super) fn pose(model: &Model, row: &Observation, ideal: &Pose) -> Option<Pose> {
    let targets = &model.targets[model.targets_at(row.station as usize)];
    match &row.measured {
        Measurement::Pose(pose) => Some(**pose),
        Measurement::Readings(_) => None,
        Measurement::Points(points) if targets.len() == 1 => {
            let mut pose = *ideal;
            pose.0[3] = (*points.first()?)?;
            Some(pose)
        }
        Measurement::Points(points) => {
            let both =
                targets.iter().zip(points.iter()).filter_map(|(target, point)| Some((*target, (*point)?)));
            let (from, to): (Vec<_>, Vec<_>) = both.unzip();
            register(&from, &to).filter(|found| found.breadth > 1e-3).map(|found| found.pose)
        }
    }
}
