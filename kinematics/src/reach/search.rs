//! Damped Newton steps on the joint Jacobian of any manipulator, one target at a time.

use core::ops::ControlFlow;

use nalgebra::{DMatrix, DVector, LU, Matrix3, SVD, U3, Vector3};

use super::target_search::{
    Descent, DescentEnd, ITERATIONS, Problem, REACHED, ROUNDING, Reachability, STAGNATION, TargetSearch, from,
};
use super::{ReachError, Target};
use abbe_core::{Error, Orientation, Pose, Quantity, VariableKind, deviation, displacement};

/// Relative singular value below which a direction is immobile.
const SINGULAR: f64 = 1e-10;
/// Rotation of the difference quotients that give the rates of Euler angles.
const TURN: f64 = 1e-6;

/// Search for one target. Residuals are its rows with lengths in arm lengths, and steps are in rad
/// and arm lengths, so that the choice of joints does not depend on the length unit.
pub(super) struct Search<'a> {
    pub(super) problem: &'a Problem<'a>,
    pub(super) target: &'a Target,
}

/// State of a descent.
struct Point {
    q: Vec<f64>,
    residual: DVector<f64>,
    jacobian: DMatrix<f64>,
}

impl Search<'_> {
    /// Runs all descents of the search.
    pub(super) fn solve(&self) -> Result<Vec<f64>, ReachError> {
        let (mut target_search, mut descent) = TargetSearch::new(self.problem, 0);
        loop {
            match target_search.next(self.problem, self.descend(&descent), || Reachability::Open) {
                ControlFlow::Continue(next) => descent = next,
                ControlFlow::Break(found) => return found,
            }
        }
    }

    /// Returns the result of the descent from a start, if it reaches the target within the limits.
    pub(super) fn from(&self, start: usize) -> Option<Vec<f64>> {
        let ended = self.descend(&from(self.problem, start, true)).ok()?;
        let is_permitted = || self.problem.sums.check(&ended.q).is_ok();
        (ended.norm <= REACHED && is_permitted()).then_some(ended.q)
    }

    fn evaluate(&self, q: Vec<f64>) -> Result<Point, Error> {
        let Problem { manipulator, ref s, ref free, arm, .. } = *self.problem;
        let mut columns = vec![[f64::NAN; 6]; q.len()];
        let pose = match (manipulator.joint_jacobian(&q, s, &mut columns), self.target) {
            // A point needs rows 1–3 alone.
            (Err(Error::EulerSingularity { .. }), Target::Point(_)) => manipulator.pose(&q, s)?,
            (pose, _) => pose?,
        };
        let (target, rows) = match self.target {
            Target::Point(point) => (Pose([pose.0[0], pose.0[1], pose.0[2], *point]), 3),
            Target::Pose(target) => (*target, 6),
            Target::Axis { point, .. } => (Pose([pose.0[0], pose.0[1], pose.0[2], *point]), 6),
        };
        let orientation = manipulator.description().orientation;
        let mut difference = deviation(orientation, &pose, &target);
        if let Target::Axis { axis, direction, .. } = self.target {
            let along = Vector3::from(pose.0[*axis]);
            difference[3..].copy_from_slice(turn_between(along, Vector3::from(*direction)).as_slice());
            let rates = rates(orientation, &pose);
            for column in &mut columns {
                let turn = rates.solve(&Vector3::new(column[3], column[4], column[5]));
                let turn = turn.map_or(Vector3::repeat(f64::NAN), |turn| turn - along * along.dot(&turn));
                column[3..].copy_from_slice(turn.as_slice());
            }
        }
        let row_scale = |i: usize| if i < 3 { 1.0 / arm } else { 1.0 };
        let residual = DVector::from_fn(rows, |i, _| difference[i] * row_scale(i));
        let jacobian = DMatrix::from_fn(rows, free.len(), |i, j| {
            let followers = self.problem.sums.followers.iter();
            let led = followers.map(|one| one.weights[free[j]] * columns[one.variable][i]);
            (columns[free[j]][i] + led.sum::<f64>()) * row_scale(i) * self.problem.unit(j)
        });
        if let Some(index) = residual.iter().chain(&jacobian).position(|v| !v.is_finite()) {
            return Err(Error::NotFinite { quantity: Quantity::Jacobian, index });
        }
        Ok(Point { q, residual, jacobian })
    }

    /// Descends by the Levenberg method, `Δq = Jᵀ (J Jᵀ + λ)⁻¹ r`, with `λ = 0` (Newton, shortest
    /// step) as long as the residual decreases.
    fn descend(&self, descent: &Descent) -> Result<DescentEnd, Error> {
        let &Descent { ref q, bounded, patience } = descent;
        let step = DVector::zeros(self.problem.free.len());
        let mut here = self.evaluate(self.moved(q, &step, bounded))?;
        let mut damping = 0.0;
        let mut before = f64::INFINITY;
        for iteration in 0..ITERATIONS {
            let norm = here.residual.norm();
            if norm <= ROUNDING {
                break;
            }
            if iteration.is_multiple_of(patience.steps) {
                if norm > before * (1.0 - patience.gain) {
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
                // Only rounding errors remain.
                _ if norm <= REACHED * 1e-2 || damping > 1e3 => break,
                _ => damping = f64::max(damping * 10.0, 0.01 * norm * norm),
            }
        }
        let rows = here.residual.as_slice();
        let (position, turn) = rows.split_at(3.min(rows.len()));
        let norm = |rows: &[f64]| rows.iter().fold(0.0, |norm: f64, row| norm.hypot(*row));
        Ok(DescentEnd { norm: here.residual.norm(), position: norm(position), turn: norm(turn), q: here.q })
    }

    /// Returns the step from a point. Variables at a limit that the step would exceed stay fixed.
    fn step(&self, here: &Point, damping: f64, bounded: bool) -> Option<DVector<f64>> {
        let free = &self.problem.free;
        let mut active = (0..free.len()).collect::<Vec<_>>();
        loop {
            if active.is_empty() {
                return None;
            }
            let step = damped_step(here.jacobian.select_columns(&active), &here.residual, damping)?;
            let mut position = 0;
            let before = active.len();
            active.retain(|&j| {
                let [lower, upper] = self.problem.variable(j).limits;
                let (value, step) = (here.q[free[j]], step[position]);
                position += 1;
                !(bounded && (value <= lower && step < 0.0 || value >= upper && step > 0.0))
            });
            if active.len() == before {
                let mut whole = DVector::zeros(free.len());
                for (&j, value) in active.iter().zip(step.iter()) {
                    whole[j] = *value;
                }
                return Some(self.shortened(whole));
            }
        }
    }

    /// Limits rotations to 1 rad per step, the reach of the linear model.
    fn shortened(&self, step: DVector<f64>) -> DVector<f64> {
        let turns = step.iter().enumerate();
        let turns = turns.filter(|(j, _)| self.problem.variable(*j).kind == VariableKind::Revolute);
        let largest = turns.map(|(_, step)| step.abs()).fold(1.0, f64::max);
        step / largest
    }

    /// Returns `q` after a step, clamped to the limits if `bounded`.
    fn moved(&self, q: &[f64], step: &DVector<f64>, bounded: bool) -> Vec<f64> {
        let mut q = q.to_vec();
        for (j, (&i, step)) in self.problem.free.iter().zip(step.iter()).enumerate() {
            q[i] += step * self.problem.unit(j);
            if bounded {
                let [lower, upper] = self.problem.variable(j).limits;
                q[i] = q[i].min(upper).max(lower);
            }
        }
        self.problem.sums.lead(&mut q);
        q
    }
}

/// Returns the shortest rotation vector that turns a unit vector into another.
fn turn_between(from: Vector3<f64>, to: Vector3<f64>) -> Vector3<f64> {
    let (across, cosine) = (from.cross(&to), from.dot(&to));
    let sine = across.norm();
    if sine > f64::EPSILON {
        return across * (sine.atan2(cosine) / sine);
    }
    // Half a turn about any perpendicular axis.
    let other = Vector3::ith(from.iamin(), 1.0);
    from.cross(&other).normalize() * if cosine < 0.0 { core::f64::consts::PI } else { 0.0 }
}

/// Returns the rates of rows 4–6 for rotations about x, y and z of `F_0`.
fn rates(orientation: Orientation, pose: &Pose) -> LU<f64, U3, U3> {
    let columns = [0, 1, 2].map(|axis| {
        if orientation == Orientation::RotationVector {
            return Vector3::ith(axis, 1.0);
        }
        let mut errors = [0.0; 6];
        errors[[5, 3, 4][axis]] = TURN;
        let turned = displacement(&errors).then(pose);
        let [.., a, b, c] = deviation(orientation, pose, &turned);
        Vector3::new(a, b, c) / TURN
    });
    Matrix3::from_columns(&columns).lu()
}

/// Returns `Jᵀ (J Jᵀ + λ)⁻¹ r = Σ σ / (σ² + λ) v (u · r)`, without the immobile directions.
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
