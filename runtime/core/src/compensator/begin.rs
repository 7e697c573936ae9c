//! The command that drives carry out where they stand: the inverse of the correction.
//!
//! With `X` the real pose at the drives, `X(q) = X` is solved for the nominal chain, from the
//! drives, by steps `y = Jᵀ (J Jᵀ + λ)⁻¹ (X ⊖ X(q))` with the Jacobian at `q`: Newton's method for
//! six independent joints, the solution nearest to the drives for redundant arms.

use super::shortest::{dot, pull};
use super::{ITERATIONS, Problem, Status, clamped};
use crate::{Description, Error, Orientation, Pose, deviation};

/// Command where a controller begins, and its correction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Begun<Q> {
    /// Command whose corrected one is where the drives stand.
    pub command: Q,
    /// The drives minus the command: [`Cycle::last`](super::Cycle::last) of the first cycle.
    pub last: Q,
    /// ΔX of the ideal tool at the command, minus the real one at the drives: what the drives will
    /// correct.
    pub after: [f64; 6],
    /// [`Status::Reached`] or [`Status::NotReached`].
    pub status: Status,
}

/// Computes the command that puts the ideal tool at `target`, where the real one is with the drives
/// at `drives`, within the limits of the variables. `rotations` are those of the
/// [`Cycle`](super::Cycle).
///
/// `step` returns the nominal pose at a configuration and fills in the nominal `J_q` with
/// rotation-vector rows, one column per variable. It is called [`ITERATIONS`] times, with `columns`
/// as scratch space. Returns an error only if `step` does.
pub fn begin<Q, C>(
    description: &Description,
    target: &Pose,
    drives: &Q,
    rotations: [f64; 3],
    mut columns: C,
    mut step: impl FnMut(&Q, &mut C) -> Result<Pose, Error>,
) -> Result<Begun<Q>, Error>
where
    Q: Clone + AsRef<[f64]> + AsMut<[f64]>,
    C: AsMut<[[f64; 6]]>,
{
    let problem = Problem::new(description, target, rotations);
    let [mut q, mut command, mut held] = [(); 3].map(|()| drives.clone());
    held.as_mut().fill(0.0);
    let (mut after, mut least) = ([0.0; 6], f64::INFINITY);
    for _ in 0..ITERATIONS {
        let left = deviation(Orientation::RotationVector, target, &step(&q, &mut columns)?);
        let cost = problem.cost(&left);
        if cost < least {
            (command, after, least) = (q.clone(), left, cost);
        }
        for (j, column) in columns.as_mut().iter_mut().enumerate() {
            *column = problem.weighted(column.map(|entry| entry * problem.unit(j)));
        }
        let wanted = problem.weighted(left).map(|row| -row);
        let pull = pull(columns.as_mut(), held.as_ref(), &wanted);
        for (j, (q, column)) in q.as_mut().iter_mut().zip(columns.as_mut()).enumerate() {
            *q = clamped(*q + dot(column, &pull) * problem.unit(j), description.variables[j].limits);
        }
    }
    let status = if problem.is_reached(&after) { Status::Reached } else { Status::NotReached };
    let mut last = drives.clone();
    for (last, command) in last.as_mut().iter_mut().zip(command.as_ref()) {
        *last -= command;
    }
    Ok(Begun { command, last, after, status })
}
