//! Corrected joint commands for any manipulator, interpreted ones too: as many steps as it takes.

use super::real_tool::RealTool;
use abbe_core::compensator::{Compensated, compensate};
use abbe_core::twist;
use abbe_core::{Error, Manipulator, Pose, drawn_pose};

/// Commands that bring the real tool to `target`, from `q` on, or to where the ideal tool is at `q` if none is given.
///
/// The steps of [`compensate`], and where they do not arrive, bounded and damped ones on the derivatives of the real chain until
/// nothing is gained: first the tool point, then as much of the turn as is possible, within the limits, and of all commands
/// that do this the ones nearest to `q`. They are sought from `q` and from a few places within 0.3 rad of it, and a tenth of an arm
/// length: an arm that would have to turn over is left where it is. [`obstacle`](super::obstacle()) says why not all is reached. Errors as for
/// [`Manipulator::generalized_errors`] and [`Manipulator::joint_jacobian`].
pub fn compensated(
    manipulator: &dyn Manipulator,
    target: Option<&Pose>,
    q: &[f64],
    s: &[f64],
    u: &[f64],
) -> Result<Compensated<Vec<f64>>, Error> {
    let description = manipulator.description();
    let ideal = manipulator.pose(q, s)?;
    let target = target.unwrap_or(&ideal);
    let tool = RealTool::new(manipulator, s, u, target, q)?;
    let room = vec![[0.0; 6]; q.len()];
    let first = compensate(description, target, &q.to_vec(), room, |q, columns| {
        let pose = manipulator.joint_jacobian(q, s, columns)?;
        columns.iter_mut().for_each(|column| *column = twist(description.orientation, &pose, column));
        drawn_pose(manipulator, q, s, u, tool.magnitudes())
    })?;
    if tool.arrived(&first.after) {
        return Ok(Compensated { converged: true, ..first });
    }
    let (q, after, converged) = tool.nearest(&first.q)?;
    Ok(Compensated { q, before: first.before, after, converged })
}
