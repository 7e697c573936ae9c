//! Inverse kinematics: damped Newton steps on the joint Jacobian, within limits.

use core::f64::consts::TAU;

use nalgebra::{DMatrix, DVector, SVD};

use super::ReachError;
use crate::analysis::sampling;
use crate::analysis::workspace::in_range;
use crate::{Error, Manipulator, Pose, Quantity, Variable, VariableKind, deviation};

/// Where the tool is to be brought, in `F_0`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Target {
    /// The tool point: rows 1–3.
    Point([f64; 3]),
    /// Point and orientation: all six rows.
    Pose(Pose),
}

/// A target counts as reached below this residual: lengths in arm lengths, angles in rad.
const REACHED: f64 = 1e-10;
/// Below this there is nothing left to gain.
const ROUNDING: f64 = 1e-14;
/// Singular values below this share of the largest are directions that do not move.
const SINGULAR: f64 = 1e-10;
/// How far beyond a limit still counts as at it, in shares of the range.
const AT_LIMIT: f64 = 1e-9;
/// A step that gains less than this share gains nothing.
const STAGNATION: f64 = 1e-9;
/// A descent that gains less than `SLOW_GAIN` in `SLOW` steps creeps towards a place short of the target.
const SLOW: usize = 10;
const SLOW_GAIN: f64 = 0.01;
const ITERATIONS: usize = 200;
/// Enough for a 6R arm to be brought to each of 1000 sampled poses; half as many miss one.
const RESTARTS: usize = 32;

/// Values of the variables in `free` that bring the tool to `target`, the others held as in `start`.
///
/// Returns all of `q`, within its limits. Too many free variables are no harm: every step is the shortest one
/// (angles in rad, lengths in arm lengths). The search begins at `start`, then at 32 points spread
/// within the limits; only if it finds nothing does it look beyond them, to say which variable stops it.
pub fn inverse(
    manipulator: &dyn Manipulator,
    s: &[f64],
    start: &[f64],
    free: &[usize],
    target: &Target,
) -> Result<Vec<f64>, ReachError> {
    let description = manipulator.description();
    let variables = &description.variables;
    in_range(free.iter().copied(), Quantity::Variables, variables.len())?;
    if start.len() != variables.len() {
        let (expected, found) = (variables.len(), start.len());
        return Err(Error::Count { quantity: Quantity::Variables, expected, found }.into());
    }
    let arm = sampling::arm_length(manipulator, s)?;
    let mut free = free.to_vec();
    free.sort_unstable();
    free.dedup();
    let mut held = (0..variables.len()).filter(|i| !free.contains(i));
    if let Some(i) = held.find(|&i| beyond(&variables[i], start[i]) > AT_LIMIT) {
        return Err(outside(variables, i, start[i]));
    }

    let search = Search { manipulator, variables, s, free: &free, target, arm };
    let starts = (0..=RESTARTS).map(|restart| match restart {
        0 => start.to_vec(),
        _ => {
            let sample = sampling::joint_sample(description, arm, &free, restart - 1);
            (0..start.len()).map(|i| if free.contains(&i) { sample[i] } else { start[i] }).collect()
        }
    });
    for start in starts.clone() {
        if let Ok(found) = search.descend(&start, true, SLOW)
            && found.residual.norm() <= REACHED
        {
            return Ok(found.q);
        }
    }
    search.beyond_limits(&starts.collect::<Vec<_>>())
}

/// How far a value is beyond the limits of its variable, in shares of the range.
fn beyond(variable: &Variable, value: f64) -> f64 {
    let [lower, upper] = variable.limits;
    let range = upper - lower;
    let share = if range.is_finite() && range > 0.0 { range } else { 1.0 };
    (lower - value).max(value - upper).max(0.0) / share
}

fn outside(variables: &[Variable], variable: usize, value: f64) -> ReachError {
    ReachError::OutsideLimits { variable, value, limits: variables[variable].limits }
}

/// One problem. Its residuals are the rows of the target, lengths in arm lengths; its steps are in rad and in
/// arm lengths: a metre or a millimetre must not decide which joint moves.
struct Search<'a> {
    manipulator: &'a dyn Manipulator,
    variables: &'a [Variable],
    s: &'a [f64],
    free: &'a [usize],
    target: &'a Target,
    arm: f64,
}

/// Where a descent stands.
struct Point {
    q: Vec<f64>,
    residual: DVector<f64>,
    jacobian: DMatrix<f64>,
}

impl Search<'_> {
    fn evaluate(&self, q: Vec<f64>) -> Result<Point, Error> {
        let mut columns = vec![[0.0; 6]; self.variables.len()];
        let pose = self.manipulator.joint_jacobian(&q, self.s, &mut columns)?;
        let (target, rows) = match self.target {
            Target::Point(point) => (Pose([pose.0[0], pose.0[1], pose.0[2], *point]), 3),
            Target::Pose(target) => (*target, 6),
        };
        let difference = deviation(self.manipulator.description().orientation, &pose, &target);
        let row_scale = |i: usize| if i < 3 { 1.0 / self.arm } else { 1.0 };
        let residual = DVector::from_fn(rows, |i, _| difference[i] * row_scale(i));
        let jacobian = DMatrix::from_fn(rows, self.free.len(), |i, j| {
            columns[self.free[j]][i] * row_scale(i) * self.unit(self.free[j])
        });
        if let Some(index) = residual.iter().chain(&jacobian).position(|v| !v.is_finite()) {
            return Err(Error::NotFinite { quantity: Quantity::Jacobian, index });
        }
        Ok(Point { q, residual, jacobian })
    }

    /// The length of one unit of step.
    fn unit(&self, variable: usize) -> f64 {
        match self.variables[variable].kind {
            VariableKind::Revolute => 1.0,
            VariableKind::Prismatic => self.arm,
        }
    }

    /// Ends early where `patience` steps gain next to nothing.
    ///
    /// Levenberg: `Δq = Jᵀ (J Jᵀ + λ)⁻¹ r`, with `λ = 0` (Newton, shortest step) for as long as it helps.
    fn descend(&self, start: &[f64], bounded: bool, patience: usize) -> Result<Point, Error> {
        let step = DVector::zeros(self.free.len());
        let mut here = self.evaluate(self.moved(start, &step, bounded))?;
        let mut damping = 0.0;
        let mut before = f64::INFINITY;
        for iteration in 0..ITERATIONS {
            let norm = here.residual.norm();
            if norm <= ROUNDING {
                break;
            }
            if iteration.is_multiple_of(patience) {
                if norm > before * (1.0 - SLOW_GAIN) {
                    break;
                }
                before = norm;
            }
            let Some(step) = self.step(&here, damping, bounded) else { break };
            match self.evaluate(self.moved(&here.q, &step, bounded)) {
                Ok(there) if there.residual.norm() < norm * (1.0 - STAGNATION) => {
                    here = there;
                    damping = if damping > norm * norm { damping / 10.0 } else { 0.0 };
                }
                // Rounding is all that is left.
                _ if norm <= REACHED * 1e-2 || damping > 1e3 => break,
                _ => damping = f64::max(damping * 10.0, 0.01 * norm * norm),
            }
        }
        Ok(here)
    }

    /// The step from a point. Variables at a limit that it would push further out stay where they are.
    fn step(&self, here: &Point, damping: f64, bounded: bool) -> Option<DVector<f64>> {
        let mut active = (0..self.free.len()).collect::<Vec<_>>();
        loop {
            if active.is_empty() {
                return None;
            }
            let reduced = here.jacobian.select_columns(&active);
            let step = damped_step(reduced, &here.residual, damping)?;
            let mut position = 0;
            let before = active.len();
            active.retain(|&j| {
                let [lower, upper] = self.variables[self.free[j]].limits;
                let (value, step) = (here.q[self.free[j]], step[position]);
                position += 1;
                !(bounded && (value <= lower && step < 0.0 || value >= upper && step > 0.0))
            });
            if active.len() == before {
                let mut whole = DVector::zeros(self.free.len());
                for (&j, value) in active.iter().zip(step.iter()) {
                    whole[j] = *value;
                }
                return Some(self.shortened(whole));
            }
        }
    }

    /// No joint turns by more than 1 rad at once: linear models do not reach further.
    fn shortened(&self, step: DVector<f64>) -> DVector<f64> {
        let turns = self.free.iter().zip(step.iter());
        let turns = turns.filter(|(i, _)| self.variables[**i].kind == VariableKind::Revolute);
        let largest = turns.map(|(_, step)| step.abs()).fold(1.0, f64::max);
        step / largest
    }

    /// `q` moved by a step, to the limits at most if bounded.
    fn moved(&self, q: &[f64], step: &DVector<f64>, bounded: bool) -> Vec<f64> {
        let mut q = q.to_vec();
        for (&i, step) in self.free.iter().zip(step.iter()) {
            q[i] += step * self.unit(i);
            if bounded {
                let [lower, upper] = self.variables[i].limits;
                q[i] = q[i].min(upper).max(lower);
            }
        }
        q
    }

    /// Looks for the target without limits, to say what stops it.
    fn beyond_limits(&self, starts: &[Vec<f64>]) -> Result<Vec<f64>, ReachError> {
        // Of all solutions, the one that is least beyond: its worst variable, how far, its value.
        let mut least: Option<(usize, f64, f64)> = None;
        let mut nearest: Option<Point> = None;
        let mut failure = Error::NotFinite { quantity: Quantity::Pose, index: 0 };
        for start in starts {
            let found = match self.descend(start, false, SLOW) {
                Ok(found) => found,
                Err(error) => {
                    failure = error;
                    continue;
                }
            };
            if found.residual.norm() <= REACHED {
                // It may lie within the limits by whole turns, or just at one of them.
                let q = self.turned(&found.q);
                if let Ok(turned) = self.descend(&q, true, SLOW)
                    && turned.residual.norm() <= REACHED
                {
                    return Ok(turned.q);
                }
                let beyond = |&i: &usize| (i, beyond(&self.variables[i], q[i]), q[i]);
                let worst = self.free.iter().map(beyond).max_by(|a, b| a.1.total_cmp(&b.1));
                least = [least, worst].into_iter().flatten().min_by(|a, b| a.1.total_cmp(&b.1));
            } else {
                nearest = [nearest, Some(found)]
                    .into_iter()
                    .flatten()
                    .min_by(|a, b| a.residual.norm().total_cmp(&b.residual.norm()));
            }
        }
        if let Some((variable, _, value)) = least {
            return Err(outside(self.variables, variable, value));
        }
        let nearest = nearest.ok_or(failure)?;
        // How near it comes is worth every step.
        let nearest = self.descend(&nearest.q, false, ITERATIONS).unwrap_or(nearest);
        let rows = nearest.residual.as_slice();
        let (position, turn) = rows.split_at(3.min(rows.len()));
        let norm = |rows: &[f64]| rows.iter().fold(0.0, |norm: f64, row| norm.hypot(*row));
        Err(ReachError::OutOfReach { residual: norm(position) * self.arm, turn: norm(turn) })
    }

    /// Free revolute variables brought back by whole turns, towards the middle of their limits.
    fn turned(&self, q: &[f64]) -> Vec<f64> {
        let mut q = q.to_vec();
        for &i in self.free {
            let Variable { kind, limits: [lower, upper], .. } = self.variables[i];
            let middle = (lower + upper) / 2.0;
            if kind == VariableKind::Revolute {
                let middle = if middle.is_finite() { middle } else { 0.0 };
                q[i] -= TAU * ((q[i] - middle) / TAU).round();
            }
        }
        q
    }
}

/// `Jᵀ (J Jᵀ + λ)⁻¹ r = Σ σ / (σ² + λ) v (u · r)`, without the directions that do not move.
fn damped_step(jacobian: DMatrix<f64>, residual: &DVector<f64>, damping: f64) -> Option<DVector<f64>> {
    let columns = jacobian.ncols();
    let svd = SVD::try_new(jacobian, true, true, f64::EPSILON, 1000)?;
    let (u, vt) = (svd.u.as_ref()?, svd.v_t.as_ref()?);
    let largest = svd.singular_values.max();
    let mut step = DVector::zeros(columns);
    for (k, &sigma) in svd.singular_values.iter().enumerate() {
        if sigma > SINGULAR * largest {
            let share = sigma / (sigma * sigma + damping) * u.column(k).dot(residual);
            step += vt.row(k).transpose() * share;
        }
    }
    Some(step)
}
