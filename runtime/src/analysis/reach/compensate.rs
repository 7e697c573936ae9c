//! Corrected joint commands for any manipulator, interpreted ones too.

use crate::compensator::{Compensated, compensate};
use crate::twist::twist;
use crate::{Error, Manipulator, Pose, drawn_pose, repeatable_magnitudes};

/// Commands that bring the real tool to `target`, from `q` on, or to where the ideal tool is at `q` if none is given.
///
/// See [`compensate`]. Errors as for [`Manipulator::generalized_errors`] and [`Manipulator::joint_jacobian`].
pub fn compensated(
    manipulator: &dyn Manipulator,
    target: Option<&Pose>,
    q: &[f64],
    s: &[f64],
    u: &[f64],
) -> Result<Compensated<Vec<f64>>, Error> {
    let description = manipulator.description();
    let ideal = manipulator.pose(q, s)?;
    let magnitudes = repeatable_magnitudes(description);
    let room = vec![[0.0; 6]; q.len()];
    compensate(description, target.unwrap_or(&ideal), &q.to_vec(), room, |q, columns| {
        let pose = manipulator.joint_jacobian(q, s, columns)?;
        columns.iter_mut().for_each(|column| *column = twist(description.orientation, &pose, column));
        drawn_pose(manipulator, q, s, u, &magnitudes)
    })
}
