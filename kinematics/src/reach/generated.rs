//! Solutions of inverse kinematics by the function of the manipulator.

use super::target_search::{Problem, REACHED};
use abbe_core::{Error, Pose, deviation};

/// Returns the solutions within the limits, in the turns nearest to `start`. Returns `None` if the
/// manipulator has no such function, or if not all joints are free.
pub(super) fn solutions(
    problem: &Problem<'_>,
    start: &[f64],
    target: &Pose,
) -> Result<Option<Vec<Vec<f64>>>, Error> {
    let Problem { manipulator, ref s, ref free, .. } = *problem;
    let count = manipulator.description().solutions;
    if count == 0 || free.len() < start.len() {
        return Ok(None);
    }
    let (mut solutions, mut found) = (vec![0.0; count * start.len()], vec![0.0; count]);
    manipulator.inverse(start, s, target, &mut solutions, &mut found)?;
    let rows = solutions.chunks_exact(start.len()).zip(found);
    let rows = rows.filter(|(row, found)| *found > 0.5 && problem.sums.check(row).is_ok());
    Ok(Some(rows.map(|(row, _)| row.to_vec()).collect()))
}

/// Returns the solution nearest to the first start, in rad and arm lengths, verified by the
/// manipulator. Returns `None` if there is none, or no function.
pub(super) fn nearest(problem: &Problem<'_>, target: &Pose) -> Option<Vec<f64>> {
    let start = &problem.starts[0];
    let way = |q: &[f64]| (0..q.len()).map(|i| ((q[i] - start[i]) / problem.unit(i)).powi(2)).sum::<f64>();
    let found = solutions(problem, start, target).ok()??;
    let nearest = found.into_iter().min_by(|a, b| way(a).total_cmp(&way(b)))?;
    let pose = problem.manipulator.pose(&nearest, &problem.s).ok()?;
    let difference = deviation(problem.description().orientation, &pose, target);
    let scale = |i: usize| if i < 3 { 1.0 / problem.arm } else { 1.0 };
    let norm = (0..6).map(|i| (difference[i] * scale(i)).powi(2)).sum::<f64>().sqrt();
    (norm <= REACHED).then_some(nearest)
}
