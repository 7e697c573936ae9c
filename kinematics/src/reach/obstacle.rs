//! Reasons why compensated commands do not bring the real tool to the target.

use nalgebra::{DMatrix, Matrix6xX, SVD, Vector3};

use super::{Goal, real_tool::RealTool};
use crate::{decompose::singular_values, sampling};
use abbe_core::compensator::{Compensated, norms};
use abbe_core::{Error, Manipulator, VariableKind, twist};

/// Remaining error.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Missing {
    /// The tool point is off target: distance, in the length unit.
    Point(f64),
    /// The tool point is on target, its orientation is not: angle, in rad.
    Turn(f64),
}

/// Reason for a remaining error.
#[derive(Clone, Debug, PartialEq)]
pub struct Obstacle {
    /// Remaining error.
    pub missing: Missing,
    /// Axis of the remaining error in `F_0`: a unit vector, along it or about it.
    pub axis: [f64; 3],
    /// Indices of the variables at a limit whose extension would reduce the error.
    pub limits: Vec<usize>,
    /// `true` if no variable, limits aside, moves the tool point along the axis, or rotates the
    /// tool about it with a fixed tool point.
    pub immobile: bool,
}

/// Extension of a limit in the test for an obstacle, in rad and arm lengths.
const FURTHER: [f64; 2] = [0.05, 0.02];
/// Relative decrease of the error by which an extended limit counts as the obstacle.
const GAIN: f64 = 1e-3;
/// Component along an axis below which a variable does not move along it, relative to its motion.
/// Exceeds the rotations by errors of a real machine.
const IMMOBILE: f64 = 0.02;
/// Relative singular value below which a direction is immobile.
const SINGULAR: f64 = 1e-6;

/// Explains the remaining error of `found`, a result of [`compensated`](super::compensated()).
///
/// `command` is the original command. Returns `None` if the remaining error is at most `length` (in
/// the length unit) and `angle` (rad). Errors as for [`compensated`](super::compensated()).
pub fn obstacle(
    manipulator: &dyn Manipulator,
    goal: Goal<'_>,
    command: &[f64],
    s: &[f64],
    u: &[f64],
    found: &Compensated<Vec<f64>>,
    [length, angle]: [f64; 2],
) -> Result<Option<Obstacle>, Error> {
    let (position, turn) = norms(&found.after);
    let [x, y, z, a, b, c] = found.after;
    let (missing, left) = match (position > length, turn > angle) {
        (true, _) => (Missing::Point(position), Vector3::new(x, y, z)),
        (false, true) => (Missing::Turn(turn), Vector3::new(a, b, c)),
        (false, false) => return Ok(None),
    };
    let axis = left.normalize();
    let ideal = manipulator.pose(command, s)?;
    let mut tool = RealTool::new(manipulator, s, u, goal.target.unwrap_or(&ideal), command, goal.weight)?;
    let held: Vec<usize> = (0..command.len()).filter(|j| tool.limits[*j].contains(&found.q[*j])).collect();
    let before = tool.left_at(&found.q)?;
    let closed = tool.limits.clone();
    let mut helps = |opened: &[usize]| {
        tool.limits.clone_from(&closed);
        for &j in opened {
            let further = tool.in_its_unit(j, FURTHER);
            tool.limits[j] = [closed[j][0] - further, closed[j][1] + further];
        }
        // A limit beyond which the machine cannot be evaluated is no obstacle.
        tool.descend(found.q.clone()).is_ok_and(|(place, _)| tool.left(&place) < before * (1.0 - GAIN))
    };
    let mut limits: Vec<usize> = held.iter().copied().filter(|j| helps(&[*j])).collect();
    if limits.is_empty() && held.len() > 1 && helps(&held) {
        limits = held;
    }
    let immobile = limits.is_empty() && immobile(&twists(manipulator, &found.q, s)?, missing, &axis);
    Ok(Some(Obstacle { missing, axis: axis.into(), limits, immobile }))
}

/// Returns the mobility of the tool, 0 to 6: the largest rank of `J_q` over ten joint samples.
pub fn mobility(manipulator: &dyn Manipulator, s: &[f64]) -> Result<usize, Error> {
    let description = manipulator.description();
    let all: Vec<usize> = (0..description.variables.len()).collect();
    let arm = sampling::arm_length(manipulator, s)?;
    let metres = arm * description.length.in_metres();
    let rank = |index: usize| {
        let q = sampling::joint_sample(description, arm, &all, index);
        let mut columns = twists(manipulator, &q, s)?;
        // Lengths of rows and of prismatic joints in arm lengths.
        columns.rows_mut(0, 3).scale_mut(1.0 / metres);
        for (mut column, variable) in columns.column_iter_mut().zip(&*description.variables) {
            let moves = f64::from(u8::from(variable.limits[0] < variable.limits[1]));
            column.scale_mut(if variable.kind == VariableKind::Prismatic { metres * moves } else { moves });
        }
        let values = singular_values(DMatrix::from_column_slice(6, columns.ncols(), columns.as_slice()));
        let values = values.unwrap_or_default();
        let largest = values.first().copied().unwrap_or(0.0);
        Ok(values.iter().filter(|value| **value > SINGULAR * largest).count())
    };
    let mut most = 0;
    let mut failure = None;
    for index in 0..10 {
        match rank(index) {
            Ok(rank) => most = most.max(rank),
            Err(error) => failure = Some(error),
        }
    }
    failure.filter(|_| most == 0).map_or(Ok(most), Err)
}

/// Returns `J_q` with the small rotation in `F_0` as rows 4–6, in metres and rad.
fn twists(manipulator: &dyn Manipulator, q: &[f64], s: &[f64]) -> Result<Matrix6xX<f64>, Error> {
    let description = manipulator.description();
    let metres = description.length.in_metres();
    let mut columns = vec![[0.0; 6]; q.len()];
    let pose = manipulator.joint_jacobian(q, s, &mut columns)?;
    Ok(Matrix6xX::from_fn(q.len(), |i, j| {
        let column = twist(description.orientation, &pose, &columns[j]);
        let unit = if description.variables[j].kind == VariableKind::Prismatic { 1.0 / metres } else { 1.0 };
        column[i] * unit * if i < 3 { metres } else { 1.0 }
    }))
}

fn immobile(columns: &Matrix6xX<f64>, missing: Missing, axis: &Vector3<f64>) -> bool {
    let (point, turn) = (columns.rows(0, 3), columns.rows(3, 3));
    match missing {
        Missing::Point(_) => {
            point.column_iter().all(|column| column.dot(axis).abs() <= IMMOBILE * column.norm().max(1e-12))
        }
        // Consider the motions that keep the tool point fixed.
        Missing::Turn(_) => {
            let point: DMatrix<f64> = point.into_owned();
            let along = turn.transpose() * axis;
            let Some(svd) = SVD::try_new(point.clone(), true, true, f64::EPSILON, 1000) else { return false };
            let largest = svd.singular_values.max();
            let Ok(back) = svd.pseudo_inverse(SINGULAR * largest.max(1e-300)) else { return false };
            let free = &along - &back * (&point * &along);
            free.norm() <= IMMOBILE * turn.norm().max(1e-12)
        }
    }
}
