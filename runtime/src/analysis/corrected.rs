//! Corrected joint commands for any manipulator, interpreted ones too.

use crate::compensator::{Compensated, compensate};
use crate::lanes::{InstructionSet, Path, Tiles};
use crate::{Error, Manipulator, Pose, Quantity, checks};

/// Commands that bring the real tool to `target`, from `q` on, or to where the ideal tool is at `q` if none is given.
///
/// See [`compensate`]. Errors as for [`Manipulator::generalized_errors`].
pub fn corrected(
    manipulator: &dyn Manipulator,
    target: Option<&Pose>,
    q: &[f64],
    s: &[f64],
    u: &[f64],
) -> Result<Compensated<Vec<f64>>, Error> {
    let description = manipulator.description();
    let ideal = manipulator.pose(q, s)?;
    let mut errors = vec![[0.0; 6]; description.frames.len()];
    manipulator.generalized_errors(q, s, u, &mut errors)?;
    let path = Path::CompensatorStep;
    let set = InstructionSet::BASELINE;
    let mut arguments = Tiles::new(set, path.arguments(&description), 1);
    let mut results = Tiles::new(set, path.results(&description), 1);
    let room = vec![[0.0; 6]; q.len()];
    compensate(&description, target.unwrap_or(&ideal), &q.to_vec(), room, |q, columns| {
        for (row, value) in q.iter().chain(s).chain(u).enumerate() {
            arguments.fill_row(row, *value);
        }
        manipulator.batch(path, &arguments, &mut results)?;
        let mut pose = Pose::IDENTITY;
        let entries = pose.0.as_flattened_mut().iter_mut().chain(columns.as_flattened_mut());
        entries.enumerate().for_each(|(row, entry)| *entry = results.get(row, 0));
        checks::finite(Quantity::Pose, pose.0.as_flattened())?;
        checks::finite(Quantity::Jacobian, columns.as_flattened())?;
        Ok(pose)
    })
}
