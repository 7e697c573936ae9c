//! Compensated joint commands for any manipulator, with as many iterations as necessary.

use super::real_tool::RealTool;
use abbe_core::compensator::{Compensated, Cycle, LEVER, Status, compensate, is_reached};
use abbe_core::{Error, Manipulator, Pose, drawn_pose, twist};

/// Goal of compensated commands; by default the ideal pose at the commands, the position with
/// priority.
#[derive(Clone, Copy, Debug, Default)]
pub struct Goal<'a> {
    /// Pose of the tool; none for the ideal one at the commands.
    pub target: Option<&'a Pose>,
    /// Length that weighs as much as 1 rad where both cannot be reached, in the length unit; none
    /// if the position has priority.
    pub weight: Option<f64>,
}

/// Computes commands that bring the real tool to the target of `goal`.
///
/// Starts with the steps of [`compensate`]. If these do not converge, bounded and damped steps on
/// the derivatives of the real chain follow until the error stops decreasing. Among equivalent
/// commands within the limits the result is the one nearest to `q`. Searches start from `q` and
/// from a few points within 0.3 rad and a tenth of an arm length of it: an arm that would have to
/// flip over stays in its posture. [`obstacle`](super::obstacle()) explains a remaining error.
/// Errors as for [`Manipulator::generalized_errors`] and [`Manipulator::joint_jacobian`].
pub fn compensated(
    manipulator: &dyn Manipulator,
    goal: Goal<'_>,
    q: &[f64],
    s: &[f64],
    u: &[f64],
) -> Result<Compensated<Vec<f64>>, Error> {
    let description = manipulator.description();
    let ideal = manipulator.pose(q, s)?;
    let target = goal.target.unwrap_or(&ideal);
    let tool = RealTool::new(manipulator, s, u, target, q, goal.weight)?;
    let room = vec![[0.0; 6]; q.len()];
    let turned = goal.weight.map_or(1.0, |weight| weight * description.length.in_metres() / LEVER);
    let cycle = Cycle { rotations: [turned; 3], ..Cycle::<[f64; 0]>::UNBOUNDED };
    let first = compensate(description, target, &q.to_vec(), &cycle, room, |q, columns| {
        let pose = manipulator.joint_jacobian(q, s, columns)?;
        columns.iter_mut().for_each(|column| *column = twist(description.orientation, &pose, column));
        drawn_pose(manipulator, q, s, u, &tool.magnitudes)
    })?;
    if tool.arrived(&first.after) {
        return Ok(first);
    }
    let command = q;
    let (q, after, converged) = tool.nearest(&first.q)?;
    let status = match () {
        () if first.status == Status::OutsideLimits => Status::OutsideLimits,
        () if is_reached(description, &after) => Status::Reached,
        () if tool.is_held(&q) => Status::Held,
        () if !converged => Status::NotConverged,
        () => Status::NotReached,
    };
    let command = tool.within(command.iter().copied());
    let correction = q.iter().zip(command).map(|(q, command)| q - command).collect();
    Ok(Compensated { q, correction, before: first.before, after, status })
}
