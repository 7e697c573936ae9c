//! ΔX of every row, equation (5): measured minus ideal.

use abbe::identify::{Seen, register};
use abbe::{Orientation, Pose, deviation};

use crate::data::Data;
use crate::failure::Failure;
use crate::identify::Setup;

/// The errors of all rows that can be used.
pub(super) struct Errors {
    /// x, y, z of the tool point, then the rotation vector where orientations were measured, in the instrument's axes.
    pub(super) rows: Vec<[f64; 6]>,
    /// The tool point as measured.
    pub(super) points: Vec<[f64; 3]>,
    pub(super) turns: bool,
}

impl Errors {
    /// Rows that show too little of the tool are taken out of the data.
    pub(super) fn of(setup: &Setup, data: &mut Data) -> Result<Self, Failure> {
        let targets = setup.ideal.targets.len() > 1;
        let (mut rows, mut points) = (Vec::new(), Vec::new());
        let mut room = setup.ideal.room();
        let mut dropped = Vec::new();
        for (i, row) in data.observations.iter().enumerate() {
            let ideal = setup.ideal.pose(&mut room, row, &[]);
            let ideal =
                ideal.map_err(|error| Failure::of(&data.file, format!("line {}: {error}", data.lines[i])))?;
            let Some(real) = pose(&setup.ideal.targets, &row.seen, &ideal) else {
                dropped.push(i);
                continue;
            };
            rows.push(deviation(Orientation::RotationVector, &ideal, &real));
            points.push(real.position());
        }
        for i in dropped.into_iter().rev() {
            let line = data.lines.remove(i);
            data.observations.remove(i);
            data.leave_out(line, "fewer than three targets were seen: they make no frame");
        }
        if rows.is_empty() {
            return Err(
                Failure::of(&data.file, "no row shows three targets").help("three of them make a frame")
            );
        }
        Ok(Self { rows, points, turns: targets || setup.pose })
    }

    pub(super) fn norms(&self) -> Vec<f64> {
        self.rows.iter().map(|row| norm([row[0], row[1], row[2]])).collect()
    }
}

pub(super) fn norm(v: [f64; 3]) -> f64 {
    v.iter().map(|x| x * x).sum::<f64>().sqrt()
}

/// The pose of the tool, as it was seen; a single point has the orientation that it should have.
fn pose(targets: &[[f64; 3]], seen: &Seen, ideal: &Pose) -> Option<Pose> {
    match seen {
        Seen::Pose(pose) => Some(*pose),
        Seen::Points(points) if targets.len() == 1 => {
            let mut pose = *ideal;
            pose.0[3] = (*points.first()?)?;
            Some(pose)
        }
        Seen::Points(points) => {
            let both = targets.iter().zip(points).filter_map(|(target, point)| Some((*target, (*point)?)));
            let (from, to): (Vec<_>, Vec<_>) = both.unzip();
            register(&from, &to).filter(|found| found.breadth > 1e-3).map(|found| found.pose)
        }
    }
}
