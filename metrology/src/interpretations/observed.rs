//! Poses of the tool as given by the rows, in one format and unit.

use abbe::Pose;

use super::pose_format::{PoseFormat, transposed};
use super::{Change, Length};

/// Poses of the rows for one interpretation of their numbers.
pub(crate) struct Observed {
    pub(super) layout: PoseFormat,
    pub(super) unit: &'static str,
    /// Changes of the measured columns.
    pub(super) changes: Vec<Change>,
    pub(super) poses: Vec<Pose>,
    /// Root mean square distance of the positions from their mean.
    pub(super) spread: f64,
}

impl Observed {
    /// Reads the rows in every combination of format, unit and change. Combinations in which a row
    /// is not a pose are left out. `metres` is the length unit of the spec in metres.
    pub(crate) fn all(
        rows: &[Vec<f64>],
        layouts: &[PoseFormat],
        lengths: &[Length],
        changes: &[Option<Change>],
        metres: f64,
    ) -> Vec<Self> {
        let mut all = Vec::new();
        for (unit, in_metres) in lengths {
            for layout in layouts {
                for change in changes {
                    let pose = |row: &Vec<f64>| {
                        let pose = layout.pose(row, in_metres / metres)?;
                        Some(change.as_ref().map_or(pose, |change| changed(&pose, change)))
                    };
                    if let Some(poses) = rows.iter().map(pose).collect::<Option<Vec<Pose>>>() {
                        let (spread, changes) = (spread(&poses), change.iter().cloned().collect());
                        all.push(Self { layout: *layout, unit, changes, poses, spread });
                    }
                }
            }
        }
        all
    }
}

/// Applies a change of the measurement to a pose. Changes of the machine have no effect.
pub(crate) fn changed(pose: &Pose, change: &Change) -> Pose {
    let Pose([x, y, z, position]) = *pose;
    match change {
        Change::Mirrored => Pose([x, y, z, mirrored(position)]),
        Change::OrientationInverted => {
            let [x, y, z] = transposed([x, y, z]);
            Pose([x, y, z, position])
        }
        _ => *pose,
    }
}

/// Exchanges x and y of a point.
pub(crate) fn mirrored([x, y, z]: [f64; 3]) -> [f64; 3] {
    [y, x, z]
}

/// Computes the root mean square distance of positions from their mean.
pub(super) fn spread(poses: &[Pose]) -> f64 {
    let count = poses.len() as f64;
    let middle: [f64; 3] =
        std::array::from_fn(|i| poses.iter().map(|pose| pose.0[3][i]).sum::<f64>() / count);
    let square = |pose: &Pose| (0..3).map(|i| (pose.0[3][i] - middle[i]).powi(2)).sum::<f64>();
    (poses.iter().map(square).sum::<f64>() / count).sqrt()
}
