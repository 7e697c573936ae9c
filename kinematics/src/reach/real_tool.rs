//! Compensation of the real tool by bounded, damped least squares until the error stops decreasing.
//!
//! With `r = X_real(q) ⊖ X*` and `d` the departure from the original commands, in metres and rad:
//! minimizes `‖r_position‖² + w² ‖r_turn‖² + λ² ‖d‖²` within the limits by the
//! Levenberg–Marquardt method, with bounds in every step and the [`Curvature`] that the residual
//! causes. The weights set the priorities: 1 m of position equals `1/w` rad of orientation and
//! `w/λ` times as much departure. Derivatives are differences of the exact real chain.

use nalgebra::{DMatrix, DVector};

use super::bounded::bounded;
use super::curvature::{Curvature, Linearization};
use crate::sampling;
use abbe_core::{
    Description, Error, Manipulator, Orientation, Pose, deviation, drawn_pose, repeatable_magnitudes,
};

/// `w` in metres, unless it is given: first that of the compensator, then so small that the
/// orientation does not affect the position.
const TURN: [f64; 2] = [1e-3, 1e-5];
/// `λ` in metres.
const DEPARTURE: f64 = 1e-10;
/// Error at which the tool has arrived: 0.1 nm and 0.1 µrad.
const ARRIVED: [f64; 2] = [1e-10, 1e-7];
/// Largest step of a variable, in rad and arm lengths.
const LONGEST: f64 = 0.2;
/// Smallest significant step and relative decrease.
const NOTHING: f64 = 1e-12;
const STEPS: usize = 300;
/// Relative decrease of the cost below which a search has found its minimum. Only the best one is
/// refined.
const COARSE: f64 = 1e-4;
/// Largest number of steps back to the position.
const RESTORATIONS: usize = 5;
/// Smallest damping, relative to the square of the weight of the orientation.
const LEAST_DAMPING: f64 = 1e-6;
/// Step of the differences, in rad and metres: the truncation error is about 5e-8, the rounding
/// error 1e-9.
const DIFFERENCE: f64 = 1e-7;
/// Number of further starts.
const STARTS: usize = 6;
/// Distance of the further starts from the command, in rad and arm lengths.
const NEAR: [f64; 2] = [0.3, 0.1];

/// Machine with its errors, target and command.
pub(super) struct RealTool<'a> {
    manipulator: &'a dyn Manipulator,
    description: &'a Description,
    s: &'a [f64],
    u: &'a [f64],
    target: &'a Pose,
    /// Original command.
    command: &'a [f64],
    pub(super) magnitudes: Vec<f64>,
    /// Limits of the variables.
    pub(super) limits: Vec<[f64; 2]>,
    /// One metre, and one arm length, in the length unit.
    metre: f64,
    arm: f64,
    /// `w` of the descents, one after the other, in metres.
    turns: [f64; 2],
}

/// State of a descent.
#[derive(Clone)]
pub(super) struct DescentState {
    pub(super) q: Vec<f64>,
    pub(super) after: [f64; 6],
    real: Pose,
}

impl<'a> RealTool<'a> {
    pub(super) fn new(
        manipulator: &'a dyn Manipulator,
        s: &'a [f64],
        u: &'a [f64],
        target: &'a Pose,
        command: &'a [f64],
        weight: Option<f64>,
    ) -> Result<Self, Error> {
        let description = manipulator.description();
        let magnitudes = repeatable_magnitudes(description);
        let metre = 1.0 / description.length.in_metres();
        let arm = sampling::arm_length(manipulator, s)?;
        let limits = description.variables.iter().map(|variable| variable.limits).collect();
        let turns = weight.map_or(TURN, |weight| [weight / metre; 2]);
        Ok(Self { manipulator, description, s, u, target, command, magnitudes, limits, metre, arm, turns })
    }

    /// Returns whether a ΔX is negligible.
    pub(super) fn arrived(&self, after: &[f64; 6]) -> bool {
        let (length, angle) = abbe_core::compensator::norms(after);
        length <= ARRIVED[0] * self.metre && angle <= ARRIVED[1]
    }

    /// Returns the best commands near the given ones, the remaining error, and whether the steps
    /// converged.
    pub(super) fn nearest(&self, first: &[f64]) -> Result<(Vec<f64>, [f64; 6], bool), Error> {
        let (mut best, _) =
            self.steps(self.place(self.within(first.iter().copied()))?, self.turns[0], COARSE)?;
        if !self.arrived(&best.after) && self.may_gain(&best) {
            for start in 0..=STARTS {
                // A start that cannot be evaluated is skipped.
                let found =
                    self.place(self.start(start)).and_then(|place| self.steps(place, self.turns[0], COARSE));
                if let Ok((found, _)) = found
                    && self.left(&found) < self.left(&best)
                {
                    best = found;
                }
                if self.arrived(&best.after) {
                    break;
                }
            }
        }
        let (best, rest) = self.refined(best)?;
        Ok((best.q, best.after, rest))
    }

    /// Returns whether another start may end at a better point: the tool point is off target, a
    /// limit holds a variable, or six or more joints leave a rotation, as near a singular pose.
    fn may_gain(&self, place: &DescentState) -> bool {
        let (length, angle) = abbe_core::compensator::norms(&place.after);
        self.is_held(&place.q) || length > ARRIVED[0] * self.metre || place.q.len() >= 6 && angle > ARRIVED[1]
    }

    /// Returns `true` if a variable is at a limit.
    pub(super) fn is_held(&self, q: &[f64]) -> bool {
        self.limits.iter().zip(q).any(|(limits, q)| limits.contains(q))
    }

    /// Returns a start: the command within its limits first, then points around it.
    fn start(&self, start: usize) -> Vec<f64> {
        let moved = self.command.iter().enumerate().map(|(j, command)| {
            let share = if start == 0 { 0.0 } else { 2.0 * sampling::halton(start, j) - 1.0 };
            command + share * self.in_its_unit(j, NEAR)
        });
        self.within(moved)
    }

    /// Descends with both weights, one after the other. Returns the end, and whether the steps
    /// converged.
    pub(super) fn descend(&self, q: Vec<f64>) -> Result<(DescentState, bool), Error> {
        self.refined(self.place(self.within(q.into_iter()))?)
    }

    fn refined(&self, mut place: DescentState) -> Result<(DescentState, bool), Error> {
        let mut rest = false;
        for turn in self.turns {
            (place, rest) = self.steps(place, turn, NOTHING)?;
        }
        Ok((place, rest))
    }

    fn place(&self, q: Vec<f64>) -> Result<DescentState, Error> {
        let real = drawn_pose(self.manipulator, &q, self.s, self.u, &self.magnitudes)?;
        let after = deviation(Orientation::RotationVector, self.target, &real);
        Ok(DescentState { q, after, real })
    }

    /// Returns the state after a step in rad and metres.
    fn moved(&self, q: &[f64], step: &DVector<f64>) -> Result<DescentState, Error> {
        let moved = q.iter().zip(step.iter()).enumerate().map(|(j, (q, step))| q + step * self.unit(j));
        self.place(self.within(moved))
    }

    /// Returns one metre or one rad in the unit of a variable.
    fn unit(&self, j: usize) -> f64 {
        self.description.variables[j].kind.either(1.0, self.metre)
    }

    /// Returns an angle in rad, or a number of arm lengths, in the unit of a variable.
    pub(super) fn in_its_unit(&self, j: usize, [angle, share]: [f64; 2]) -> f64 {
        self.description.variables[j].kind.either(angle, share * self.arm)
    }

    /// Clamps values to the limits.
    pub(super) fn within(&self, q: impl Iterator<Item = f64>) -> Vec<f64> {
        q.zip(&self.limits).map(|(value, [lower, upper])| value.max(*lower).min(*upper)).collect()
    }

    /// Returns [`left`](Self::left) at these commands.
    pub(super) fn left_at(&self, q: &[f64]) -> Result<f64, Error> {
        Ok(self.left(&self.place(q.to_vec())?))
    }

    /// Returns the weighted remaining error, dominated by position unless a weight is given.
    pub(super) fn left(&self, place: &DescentState) -> f64 {
        self.cost(place, self.turns[1])
    }

    fn cost(&self, place: &DescentState, turn: f64) -> f64 {
        self.residual(place, turn).norm_squared()
    }

    /// Returns position, orientation and departure, all in metres.
    fn residual(&self, DescentState { q, after, .. }: &DescentState, turn: f64) -> DVector<f64> {
        let departure = |j: usize| DEPARTURE * (q[j] - self.command[j]) / self.unit(j);
        DVector::from_fn(6 + q.len(), |i, _| match i {
            0..3 => after[i] / self.metre,
            3..6 => after[i] * turn,
            _ => departure(i - 6),
        })
    }

    /// Returns the residual and its derivatives by metre and rad: differences towards the farther
    /// limit.
    fn linearization(&self, here: &DescentState, turn: f64) -> Result<Linearization, Error> {
        let q = &here.q;
        let mut derivatives = DMatrix::zeros(6 + q.len(), q.len());
        for (j, [lower, upper]) in self.limits.iter().enumerate() {
            let sign = if upper - q[j] >= q[j] - lower { 1.0 } else { -1.0 };
            let mut moved = q.clone();
            moved[j] = (q[j] + sign * DIFFERENCE * self.unit(j)).max(*lower).min(*upper);
            derivatives[(6 + j, j)] = DEPARTURE;
            let step = (moved[j] - q[j]) / self.unit(j);
            if step != 0.0 {
                let rows = deviation(Orientation::RotationVector, &here.real, &self.place(moved)?.real);
                for i in 0..6 {
                    let weight = if i < 3 { 1.0 / self.metre } else { turn };
                    derivatives[(i, j)] = rows[i] * weight / step;
                }
            }
        }
        Ok(Linearization { residual: self.residual(here, turn), derivatives })
    }

    /// Steps until a step reduces the cost by less than `least` of it. Returns the end, and whether
    /// the steps converged.
    fn steps(&self, mut here: DescentState, turn: f64, least: f64) -> Result<(DescentState, bool), Error> {
        let n = here.q.len();
        let mut damping = 0.0_f64;
        let mut curvature = Curvature::zero(n);
        let mut linear = self.linearization(&here, turn)?;
        for _ in 0..STEPS {
            let cost = linear.residual.norm_squared();
            // Rows of the residual, of the damping and of the curvature.
            let mut a = linear.derivatives.clone().resize_vertically(6 + 3 * n, 0.0);
            (0..n).for_each(|j| a[(6 + n + j, j)] = damping.sqrt());
            a.rows_mut(6 + 2 * n, n).copy_from(&curvature.rows());
            let b = linear.residual.clone().resize_vertically(6 + 3 * n, 0.0);
            let room = |j: usize| {
                let [lower, upper] = self.limits[j];
                let longest = self.in_its_unit(j, [LONGEST; 2]) / self.unit(j);
                let to = |limit: f64| ((limit - here.q[j]) / self.unit(j)).clamp(-longest, longest);
                [to(lower).min(0.0), to(upper).max(0.0)]
            };
            let (lower, upper): (Vec<f64>, Vec<f64>) = (0..n).map(|j| room(j).into()).unzip();
            let Some(step) = bounded(&a, &b, &lower, &upper) else { return Ok((here, false)) };
            if step.amax() <= NOTHING {
                return Ok((here, true));
            }
            let mut there = self.moved(&here.q, &step)?;
            // A step keeps the position only to first order. Further steps restore it and leave the
            // rotation: long steps along the poses that keep the position need them.
            let mut restored = step.clone();
            for _ in 0..RESTORATIONS {
                let mut back = self.residual(&there, turn).resize_vertically(6 + 3 * n, 0.0);
                back.rows_mut(3, 3 + n).fill(0.0);
                let [lower, upper] = [&lower, &upper]
                    .map(|bounds| bounds.iter().zip(restored.iter()).map(|(b, p)| b - p).collect::<Vec<_>>());
                let Some(next) = bounded(&a, &back, &lower, &upper) else { break };
                restored += next;
                let corrected = self.moved(&here.q, &restored)?;
                if self.cost(&corrected, turn) >= self.cost(&there, turn) {
                    break;
                }
                there = corrected;
            }
            let gained = cost - self.cost(&there, turn);
            if gained > 0.0 {
                let next = self.linearization(&there, turn)?;
                let moved = (0..n).map(|j| (there.q[j] - here.q[j]) / self.unit(j));
                curvature.update(&DVector::from_iterator(n, moved), &linear, &next);
                (here, linear) = (there, next);
                damping = if damping > LEAST_DAMPING * turn * turn { damping * 0.1 } else { 0.0 };
                if gained <= least * cost && (damping == 0.0 || least > NOTHING) {
                    return Ok((here, true));
                }
            } else if step.amax() <= 1e-9 || damping > 1e3 {
                // Only rounding errors remain.
                return Ok((here, true));
            } else {
                damping = f64::max(damping * 10.0, LEAST_DAMPING * turn * turn);
            }
        }
        Ok((here, false))
    }
}
