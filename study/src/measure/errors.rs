//! ΔX of every row, equation (5): measured minus ideal.

use abbe::identify::{Measurement, Model, Observation, register};
use abbe::{Orientation, Pose, deviation};
use abbe_codegen::diagnostic::Diagnostics;

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

/// The errors of all rows; those that show too little of the tool go to the unusable ones.
pub(super) fn row_errors(setup: &Setup, data: &mut Data) -> Result<Vec<RowError>, Diagnostics> {
    let mut rows = Vec::new();
    let seen = at_single_target(&setup.ideal);
    let mut room = seen.room();
    for observation in std::mem::take(&mut data.observations) {
        let ideal = seen.pose(&mut room, &observation, &[]);
        let ideal = ideal.map_err(|failure| mistake::whole(&data.file, &failure))?;
        match pose(&seen.targets, &observation.measured, &ideal) {
            Some(real) => rows.push(RowError {
                error: deviation(Orientation::RotationVector, &ideal, &real),
                point: real.position(),
                observation,
            }),
            None => {
                data.leave_out(observation.line, "fewer than three targets were seen: they make no frame");
            }
        }
    }
    if rows.is_empty() {
        let help = "three of them make a frame";
        return Err(mistake::with_help(&data.file, "no row shows three targets", help));
    }
    Ok(rows)
}

pub(super) fn norm(v: [f64; 3]) -> f64 {
    v.iter().map(|x| x * x).sum::<f64>().sqrt()
}

/// The pose of the tool, as it was measured; a single point has the orientation that it should have.
pub(super) fn pose(targets: &[[f64; 3]], measured: &Measurement, ideal: &Pose) -> Option<Pose> {
    match measured {
        Measurement::Pose(pose) => Some(*pose),
        Measurement::Readings(_) => None,
        Measurement::Points(points) if targets.len() == 1 => {
            let mut pose = *ideal;
            pose.0[3] = (*points.first()?)?;
            Some(pose)
        }
        Measurement::Points(points) => {
            let both = targets.iter().zip(points).filter_map(|(target, point)| Some((*target, (*point)?)));
            let (from, to): (Vec<_>, Vec<_>) = both.unzip();
            register(&from, &to).filter(|found| found.breadth > 1e-3).map(|found| found.pose)
        }
    }
}
