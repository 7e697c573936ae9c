//! Compensation of the real tool by bounded, damped least squares until the error stops decreasing.
//!
//! With `r = X_real(q) ⊖ X*` and `d` the departure from the original commands, in metres and rad:
//! minimizes `‖r_position‖² + w² ‖r_turn‖² + λ² ‖d‖²` within the limits by the Levenberg–Marquardt
//! method, with bounds in every step. The weights set the priorities: 1 m of position equals `1/w`
//! rad of orientation and `w/λ` times as much departure. Derivatives are central differences of the
//! exact real chain.

use nalgebra::{DMatrix, DVector};

use super::bounded::bounded;
use crate::sampling;
use abbe_core::{
    Description, Error, Manipulator, Orientation, Pose, VariableKind, deviation, drawn_pose,
    repeatable_magnitudes,
};

/// `w` in metres: first that of the compensator, then so small that the orientation does not affect
/// the position.
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
/// Step of the differences, in rad and metres: truncation and rounding errors are both about 1e-10.
const DIFFERENCE: f64 = 1e-6;
/// Number of further starts.
const STARTS: usize = 4;
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
    magnitudes: Vec<f64>,
    /// Limits of the variables.
    pub(super) limits: Vec<[f64; 2]>,
    /// One metre, and one arm length, in the length unit.
    metre: f64,
    arm: f64,
}

/// State of a descent.
#[derive(Clone)]
pub(super) struct DescentState {
    pub(super) q: Vec<f64>,
    pub(super) after: [f64; 6],
}

impl<'a> RealTool<'a> {
    pub(super) fn new(
        manipulator: &'a dyn Manipulator,
        s: &'a [f64],
        u: &'a [f64],
        target: &'a Pose,
        command: &'a [f64],
    ) -> Result<Self, Error> {
        let description = manipulator.description();
        let magnitudes = repeatable_magnitudes(description);
        let metre = 1.0 / description.length.in_metres();
        let arm = sampling::arm_length(manipulator, s)?;
        let limits = description.variables.iter().map(|variable| variable.limits).collect();
        Ok(Self { manipulator, description, s, u, target, command, magnitudes, limits, metre, arm })
    }

    pub(super) fn magnitudes(&self) -> &[f64] {
        &self.magnitudes
    }

    /// Returns whether a ΔX is negligible.
    pub(super) fn arrived(&self, after: &[f64; 6]) -> bool {
        let (length, angle) = abbe_core::compensator::norms(after);
        length <= ARRIVED[0] * self.metre && angle <= ARRIVED[1]
    }

    /// Returns the best commands near the given ones, the remaining error, and whether the steps
    /// converged.
    pub(super) fn nearest(&self, first: &[f64]) -> Result<(Vec<f64>, [f64; 6], bool), Error> {
        let (mut best, _) = self.steps(self.place(self.within(first.iter().copied()))?, TURN[0])?;
        if !self.arrived(&best.after) && self.may_gain(&best) {
            for start in 0..=STARTS {
                // A start that cannot be evaluated is skipped.
                let found = self.place(self.start(start)).and_then(|place| self.steps(place, TURN[0]));
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
        let (best, rest) = self.steps(best, TURN[1])?;
        Ok((best.q, best.after, rest))
    }

    /// Returns whether another start may end at a better point: the tool point is off target, a
    /// limit holds a variable, or six or more joints leave a rotation, as near a singular pose.
    fn may_gain(&self, place: &DescentState) -> bool {
        let at_limit = self.limits.iter().zip(&place.q).any(|(limits, q)| limits.contains(q));
        let (length, angle) = abbe_core::compensator::norms(&place.after);
        at_limit || length > ARRIVED[0] * self.metre || place.q.len() >= 6 && angle > ARRIVED[1]
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
        let mut rest = false;
        let mut place = self.place(self.within(q.into_iter()))?;
        for turn in TURN {
            (place, rest) = self.steps(place, turn)?;
        }
        Ok((place, rest))
    }

    fn place(&self, q: Vec<f64>) -> Result<DescentState, Error> {
        let after = deviation(Orientation::RotationVector, self.target, &self.real(&q)?);
        Ok(DescentState { q, after })
    }

    /// Returns the state after a step in rad and metres.
    fn moved(&self, q: &[f64], step: &DVector<f64>) -> Result<DescentState, Error> {
        let moved = q.iter().zip(step.iter()).enumerate().map(|(j, (q, step))| q + step * self.unit(j));
        self.place(self.within(moved))
    }

    fn real(&self, q: &[f64]) -> Result<Pose, Error> {
        drawn_pose(self.manipulator, q, self.s, self.u, &self.magnitudes)
    }

    /// Returns one metre or one rad in the unit of a variable.
    fn unit(&self, j: usize) -> f64 {
        match self.description.variables[j].kind {
            VariableKind::Revolute => 1.0,
            VariableKind::Prismatic => self.metre,
        }
    }

    /// Returns an angle in rad, or a number of arm lengths, in the unit of a variable.
    pub(super) fn in_its_unit(&self, j: usize, [angle, share]: [f64; 2]) -> f64 {
        match self.description.variables[j].kind {
            VariableKind::Revolute => angle,
            VariableKind::Prismatic => share * self.arm,
        }
    }

    /// Clamps values to the limits.
    fn within(&self, q: impl Iterator<Item = f64>) -> Vec<f64> {
        q.zip(&self.limits).map(|(value, [lower, upper])| value.max(*lower).min(*upper)).collect()
    }

    /// Returns [`left`](Self::left) at these commands.
    pub(super) fn left_at(&self, q: &[f64]) -> Result<f64, Error> {
        Ok(self.left(&self.place(q.to_vec())?))
    }

    /// Returns the weighted remaining error, dominated by position.
    pub(super) fn left(&self, place: &DescentState) -> f64 {
        self.cost(place, TURN[1])
    }

    fn cost(&self, place: &DescentState, turn: f64) -> f64 {
        self.residual(place, turn).norm_squared()
    }

    /// Returns position, orientation and departure, all in metres.
    fn residual(&self, DescentState { q, after }: &DescentState, turn: f64) -> DVector<f64> {
        let departure = |j: usize| DEPARTURE * (q[j] - self.command[j]) / self.unit(j);
        DVector::from_fn(6 + q.len(), |i, _| match i {
            0..3 => after[i] / self.metre,
            3..6 => after[i] * turn,
            _ => departure(i - 6),
        })
    }

    /// Returns the derivatives of the residual by metre and rad: central differences within the
    /// limits.
    fn derivatives(&self, q: &[f64], turn: f64) -> Result<DMatrix<f64>, Error> {
        let mut derivatives = DMatrix::zeros(6 + q.len(), q.len());
        for j in 0..q.len() {
            let at = |sign: f64| {
                let mut moved = q.to_vec();
                moved[j] += sign * DIFFERENCE * self.unit(j);
                let moved = self.within(moved.into_iter());
                Ok((moved[j], self.real(&moved)?))
            };
            let ((lower, below), (upper, above)) = (at(-1.0)?, at(1.0)?);
            derivatives[(6 + j, j)] = DEPARTURE;
            if upper > lower {
                let rows = deviation(Orientation::RotationVector, &below, &above);
                for i in 0..6 {
                    let weight = if i < 3 { 1.0 / self.metre } else { turn };
                    derivatives[(i, j)] = rows[i] * weight * self.unit(j) / (upper - lower);
                }
            }
        }
        Ok(derivatives)
    }

    /// Steps until the cost stops decreasing. Returns the end, and whether the steps converged.
    fn steps(&self, mut here: DescentState, turn: f64) -> Result<(DescentState, bool), Error> {
        let n = here.q.len();
        let mut damping = 0.0_f64;
        let mut derivatives = self.derivatives(&here.q, turn)?;
        for _ in 0..STEPS {
            let (residual, cost) = (self.residual(&here, turn), self.cost(&here, turn));
            let mut a = derivatives.clone().resize_vertically(6 + 2 * n, 0.0);
            (0..n).for_each(|j| a[(6 + n + j, j)] = damping.sqrt());
            let b = residual.resize_vertically(6 + 2 * n, 0.0);
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
            // A step keeps the position only to first order. A second step restores it and leaves
            // the rotation.
            let mut back = self.residual(&there, turn).resize_vertically(6 + 2 * n, 0.0);
            back.rows_mut(3, 3 + n).fill(0.0);
            let [lower, upper] = [&lower, &upper]
                .map(|bounds| bounds.iter().zip(step.iter()).map(|(b, p)| b - p).collect::<Vec<_>>());
            if let Some(second) = bounded(&a, &back, &lower, &upper) {
                let corrected = self.moved(&here.q, &(&step + second))?;
                if self.cost(&corrected, turn) < self.cost(&there, turn) {
                    there = corrected;
                }
            }
            let gained = cost - self.cost(&there, turn);
            if gained > 0.0 {
                derivatives = self.derivatives(&there.q, turn)?;
                here = there;
                damping = if damping > 1e-6 * turn * turn { damping * 0.1 } else { 0.0 };
                if gained <= NOTHING * cost && damping == 0.0 {
                    return Ok((here, true));
                }
            } else if step.amax() <= 1e-9 || damping > 1e3 {
                // Only rounding errors remain.
                return Ok((here, true));
            } else {
                // Start with a damping small enough for the smallest weight.
                damping = f64::max(damping * 10.0, 1e-3 * turn * turn);
            }
        }
        Ok((here, false))
    }
}
