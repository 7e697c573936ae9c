//! All solutions of inverse kinematics: in closed form where the structure permits, otherwise by
//! many searches.

use core::f64::consts::{PI, TAU};

use nalgebra::{Matrix6, Vector6};

use super::search::Search;
use super::target_search::{AT_LIMIT, Problem, REACHED};
use super::{ReachError, Target, generated, inverse};
use crate::sampling;
use abbe_core::{Manipulator, Pose, Quantity, Variable, VariableKind, checks, deviation};

/// Largest difference of two solutions that count as one, in rad or arm lengths.
const SAME: f64 = 1e-6;
/// Residual that needs no improvement, in arm lengths and rad.
const PRECISE: f64 = 1e-12;
/// Largest value of a start, in rad or in the length unit: its sine has ten digits.
const FARTHEST: f64 = 1e6;
/// Largest number of Newton's steps that improve a solution.
const STEPS: usize = 4;

/// Inverse kinematics of a manipulator with all of its solutions.
///
/// Arms whose axes intersect or are parallel where the arms of industry have them so, gantries, and
/// platforms on legs have a closed form as a function of their own ([`Manipulator::inverse`]). Of
/// all others the solutions are those of many searches. Every solution is verified, and where
/// needed improved, by the manipulator itself: the loops of a platform close there in the assembly
/// mode of home. Errors of a calibration, which tilt and shift the axes of an arm, leave no closed
/// form of it.
///
/// Lengths are in the manipulator's unit, angles in rad; poses are those of the tool point in
/// `F_0`.
pub struct InverseKinematics<'a> {
    problem: Problem<'a>,
}

impl<'a> InverseKinematics<'a> {
    /// Prepares a manipulator with given parameters. Errors as for [`inverse()`].
    pub fn new(manipulator: &'a dyn Manipulator, s: &[f64]) -> Result<Self, ReachError> {
        let home = sampling::home(manipulator.description());
        let all: Vec<usize> = (0..home.len()).collect();
        Ok(Self { problem: Problem::new(manipulator, s, &home, &all)? })
    }

    /// Returns `true` if the solutions are found in closed form. Then none is missing, except where
    /// a joint is free to move: see [`solve`](Self::solve).
    pub fn is_closed_form(&self) -> bool {
        self.problem.description().solutions > 0
    }

    /// Returns all solutions within the limits that bring the tool point to a pose, the one nearest
    /// to `start` first; revolute joints have the full turn nearest to `start` of those within the
    /// limits.
    ///
    /// Where a joint is free to move, as the first and the last one of a straight wrist, it stays
    /// as in `start`: one of infinitely many solutions. Without a closed form the solutions are
    /// those of searches from 33 starts, and some may be missing; of an arm with more than six
    /// joints, it is one.
    ///
    /// # Errors
    ///
    /// Returns the errors of [`inverse()`] if there is no solution, and
    /// [`Error::NotFinite`](abbe_core::Error::NotFinite) if `start` is not finite.
    pub fn solve(&self, start: &[f64], target: &Pose) -> Result<Vec<Vec<f64>>, ReachError> {
        let Problem { manipulator, ref s, ref free, .. } = self.problem;
        let one = || inverse(manipulator, s, start, free, &Target::Pose(*target));
        checks::finite(Quantity::Variables, start)?;
        if start.len() != free.len() || free.len() > 6 || !Target::Pose(*target).is_finite() {
            return one().map(|q| vec![q]);
        }
        // Joints that are free to move stay there.
        let variables = &self.problem.description().variables;
        let nearest = |(value, variable): (&f64, &Variable)| {
            value.clamp(-FARTHEST, FARTHEST).clamp(variable.limits[0], variable.limits[1])
        };
        let start: &[f64] = &start.iter().zip(variables.iter()).map(nearest).collect::<Vec<_>>();
        let mut found: Vec<(f64, Vec<f64>)> = Vec::with_capacity(8);
        let mut columns = vec![[0.0; 6]; free.len()];
        let candidates = match self.is_closed_form() {
            true => generated::solutions(&self.problem, start, target)?.unwrap_or_default(),
            false => self.searched(start, target)?,
        };
        for candidate in candidates {
            let polished = self.polished(candidate, target, &mut columns);
            let Some(q) = polished.and_then(|q| self.within_limits(q, start)) else { continue };
            let way = |a: &[f64], i: usize| (a[i] - q[i]) / self.problem.unit(i);
            let is_same = |other: &[f64]| {
                (0..q.len()).all(|i| {
                    let way = way(other, i);
                    // Of two turns that are as near to the start one is a solution.
                    let is_turn = way.abs() > PI && variables[i].kind == VariableKind::Revolute;
                    (if is_turn { way.abs() - TAU } else { way }).abs() <= SAME
                })
            };
            if !found.iter().any(|(_, other)| is_same(other)) {
                found.push(((0..q.len()).map(|i| way(start, i).powi(2)).sum(), q));
            }
        }
        if found.is_empty() {
            return one().map(|q| vec![q]);
        }
        found.sort_by(|(a, _), (b, _)| a.total_cmp(b));
        Ok(found.into_iter().map(|(_, q)| q).collect())
    }

    fn searched(&self, start: &[f64], target: &Pose) -> Result<Vec<Vec<f64>>, ReachError> {
        let Problem { manipulator, ref s, ref free, .. } = self.problem;
        let mut problem = Problem::new(manipulator, s, start, free)?;
        problem.spread();
        let search = Search { problem: &problem, target: &Target::Pose(*target) };
        Ok((0..problem.starts.len()).filter_map(|start| search.from(start)).collect())
    }

    /// Improves a solution by Newton's steps. Returns `None` if it does not reach the target.
    /// `columns` is a buffer for the joint Jacobian.
    fn polished(&self, mut q: Vec<f64>, target: &Pose, columns: &mut [[f64; 6]]) -> Option<Vec<f64>> {
        let Problem { manipulator, ref s, arm, .. } = self.problem;
        let orientation = manipulator.description().orientation;
        let scale = |i: usize| if i < 3 { 1.0 / arm } else { 1.0 };
        let (mut best, mut least) = (Vec::new(), f64::INFINITY);
        for _ in 0..=STEPS {
            let Ok(pose) = manipulator.pose(&q, s) else { break };
            let entries = pose.0.as_flattened().iter().zip(target.0.as_flattened()).enumerate();
            let square =
                |(i, (a, b)): (usize, (&f64, &f64))| ((a - b) * if i < 9 { 1.0 } else { scale(0) }).powi(2);
            if entries.map(square).sum::<f64>() <= PRECISE * PRECISE {
                return Some(q);
            }
            let difference = deviation(orientation, &pose, target);
            let residual = Vector6::from_fn(|i, _| difference[i] * scale(i));
            let norm = residual.norm();
            if norm <= PRECISE {
                return Some(q);
            }
            if norm.is_nan() || norm >= least {
                break;
            }
            best.clone_from(&q);
            least = norm;
            // Searches of fewer joints have ended where they could.
            if q.len() != 6 || manipulator.joint_jacobian(&q, s, columns).is_err() {
                break;
            }
            let jacobian = Matrix6::from_fn(|i, j| columns[j][i] * scale(i) * self.problem.unit(j));
            // Damped, so that the step remains small where the matrix is singular.
            let square = jacobian * jacobian.transpose() + Matrix6::identity() * (norm * norm);
            let Some(part) = square.lu().solve(&residual) else { break };
            let step = jacobian.transpose() * part;
            q.iter_mut().enumerate().for_each(|(i, q)| *q += step[i] * self.problem.unit(i));
        }
        (least <= REACHED).then_some(best)
    }

    /// Brings revolute joints near to `start` by full turns. Returns `None` if a joint is outside
    /// its limits in every turn.
    fn within_limits(&self, mut q: Vec<f64>, start: &[f64]) -> Option<Vec<f64>> {
        let variables = &self.problem.description().variables;
        for ((q, variable), start) in q.iter_mut().zip(variables.iter()).zip(start) {
            let [lower, upper] = variable.limits;
            let is_near = variable.kind == VariableKind::Prismatic || (start - *q).abs() <= PI;
            if is_near && (lower..=upper).contains(q) {
                continue;
            }
            let slack = if (upper - lower).is_finite() { AT_LIMIT * (upper - lower) } else { 0.0 };
            if variable.kind == VariableKind::Revolute {
                let fewest = ((lower - slack - *q) / TAU).ceil();
                let most = ((upper + slack - *q) / TAU).floor();
                *q += TAU * ((start - *q) / TAU).round().max(fewest).min(most);
            }
            if *q < lower - slack || *q > upper + slack {
                return None;
            }
            *q = q.clamp(lower, upper);
        }
        self.problem.sums.check(&q).is_ok().then_some(q)
    }
}
