//! ΔX of every row, equation (5): measured minus ideal.

use abbe::identify::{Failure, Measurement, Model, Observation, Room, register};
use abbe::{Orientation, Pose, deviation};
use abbe_spec::diagnostic::Diagnostics;

use crate::data::Data;
use crate::identify::Setup;
use crate::mistake;

/// A row, and by how much the tool was not where it should be.
#[derive(Clone, Debug)]
pub struct RowError {
    /// What was commanded and measured.
    pub observation: Observation,
    /// x, y, z of the tool point, then the rotation vector where orientations were measured, in the instrument's axes.
    pub error: [f64; 6],
    /// The tool point as measured.
    pub point: [f64; 3],
}

/// A row of a configuration that is visited again.
#[derive(Clone, Copy, Debug)]
pub(super) struct Visit {
    pub(super) configuration: u32,
    /// From which direction, as a number.
    pub(super) direction: u32,
    /// When; 0 where nobody says.
    pub(super) time: f64,
    /// As in [`RowError`].
    pub(super) error: [f64; 6],
    pub(super) point: [f64; 3],
}

impl Visit {
    pub(super) fn new(&RowError { ref observation, error, point }: &RowError) -> Self {
        let (direction, time) = (observation.direction(), observation.time().unwrap_or_default());
        Self { configuration: observation.configuration, direction, time, error, point }
    }
}

impl RowError {
    /// The norm of the position error.
    pub fn distance(&self) -> f64 {
        norm([self.error[0], self.error[1], self.error[2]])
    }
}

/// The model whose tool point is the target, if that is the only one: its place on the tool is no error.
pub(super) fn at_single_target<'a>(model: &Model<'a>) -> Model<'a> {
    let [target] = model.targets[..] else { return model.clone() };
    let mut mounting = model.mounting;
    mounting.0[3] = mounting.apply(target);
    Model { mounting, targets: vec![[0.0; 3]], ..model.clone() }
}

/// x, y, z and the turn by which the tool was off, and the tool point as measured.
type Seen = ([f64; 6], [f64; 3]);

/// The errors of rows, one after the other: they are not kept.
pub(super) struct Errors<'a> {
    seen: Model<'a>,
    room: Room,
}

impl<'a> Errors<'a> {
    pub(super) fn new(setup: &Setup<'a>) -> Self {
        let seen = at_single_target(&setup.ideal);
        Self { room: seen.room(), seen }
    }

    /// The error of a row, and the tool point as measured; none if it shows too little of the tool.
    pub(super) fn at(&mut self, row: &Observation) -> Result<Option<Seen>, Failure> {
        let ideal = self.seen.pose(&mut self.room, row, &[])?;
        let real = pose(&self.seen.targets, &row.measured, &ideal);
        Ok(real.map(|real| (deviation(Orientation::RotationVector, &ideal, &real), real.position())))
    }

    /// The same with its row, of which it is known that it shows enough.
    pub(super) fn of(&mut self, row: &Observation) -> Result<RowError, Failure> {
        let (error, point) = self.at(row)?.unwrap_or_default();
        Ok(RowError { observation: row.clone(), error, point })
    }
}

/// Moves rows that show too little of the tool to the unusable ones.
pub(super) fn leave_out(setup: &Setup, data: &mut Data) -> Result<(), Diagnostics> {
    let mut errors = Errors::new(setup);
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
        data.leave_out(line, "fewer than three targets were seen: they make no frame");
    }
    if data.observations.is_empty() {
        let help = "three of them make a frame";
        return Err(mistake::with_help(&data.file, "no row shows three targets", help));
    }
    Ok(())
}

pub(super) fn norm(v: [f64; 3]) -> f64 {
    v.iter().map(|x| x * x).sum::<f64>().sqrt()
}

/// The pose of the tool, as it was measured; a single point has the orientation that it should have.
pub(super) fn pose(targets: &[[f64; 3]], measured: &Measurement, ideal: &Pose) -> Option<Pose> {
    match measured {
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
