//! Compensated joint commands: the `q′` that solves `A_1 E_1(q′) … A_n E_n(q′) · T = X*`.
//!
//! With `d = q′ − q`, `r = X* ⊖ X_real(q′)` and `b = r + J d`, every iteration makes [`PASSES`]
//! passes `d_m = argmin ‖b − J d‖² + λ ‖d − d_{m−1}‖²` from `d_0 = 0`, on the nominal `J_q`, over
//! an interval of each joint: its limits and the largest correction ([`Cycle`]), in the last pass
//! those that a cycle permits. This yields the exact solution for six independent joints, the
//! solution nearest to `q` for redundant arms, the least-squares solution for fewer joints, and
//! where `J` loses rank a step that is bounded. Each minimum is unique, so that corrections stay
//! continuous where joints reach their bounds or leave them; `departure` finds it.
//!
//! The real Jacobian differs from `J` by rotations of the size of the errors, so that an iteration
//! reduces the residual by about the ratio of the errors' angles to the smallest singular value of
//! `J` (in metres and rad). Where this ratio exceeds 1, full steps go back and forth. A step is
//! repeated with a quarter of its length unless what is left becomes less or the next step is at
//! most half as long (Deuflhard: Newton Methods for Nonlinear Problems, 2004, section 3.3).
//! Iterations begin at the correction of the previous cycle, so that commands do not alternate
//! between corrections that are about as good. From one cycle to the next no joint moves further
//! than its command does and its bound, whatever the commands are. `cycle` has arguments and
//! results.
//!
//! Residuals on the exact chain, as tested: less than 0.001 mm and 1 µrad within the limits, for
//! errors of millimetres and milliradians, where that singular value is above 0.1. For the paper's
//! positioner over its treatment volume, 5.4 mm become less than 10⁻⁵ mm, and a rotation remains
//! only where a joint is at its limit. The cost is bounded by [`ITERATIONS`] and [`solves`], and
//! nothing is allocated.

mod begin;
mod cycle;
mod departure;
mod shortest;

pub use self::begin::{Begun, begin};
pub use self::cycle::{CHANGE, Compensated, Cycle, LARGEST, REACHED, Status, bound};
pub use self::departure::{PASSES, RELEASES, solves};
pub use self::shortest::DAMPING;
pub use crate::chain::LEAST_SINE;

use self::shortest::dot;
use crate::{Description, Error, Orientation, Pose, Scalar, Variable, deviation};

/// Largest number of iterations. The real chain is evaluated at most twice more: at the command,
/// and at the correction of the previous cycle.
pub const ITERATIONS: usize = 6;

/// Length of a repeated step, compared with the step before it.
pub const SHORTER: f64 = 0.25;

/// Length of the next step, compared with an accepted one, up to which more may be left after it.
pub const CONTRACTION: f64 = 0.5;

/// Largest step of a converged iteration, in rad and metres.
pub const REST: f64 = 1e-10;

/// Share of a command by which it may be beyond a limit: rounding errors of a limit that was
/// converted from degrees.
pub const AT_LIMIT: f64 = 4.0 * f64::EPSILON;

/// Metres that weigh as much as one rad. The small value gives the position of the tool point
/// priority.
pub const LEVER: f64 = 1e-3;

/// Returns the norms of the position and of the rotation of a ΔX, in the manipulator's length unit
/// and in rad.
pub fn norms(rows: &[f64; 6]) -> (f64, f64) {
    let norm = |v: &[f64]| Scalar::sqrt(dot(v, v));
    (norm(&rows[..3]), norm(&rows[3..]))
}

/// Computes commands that bring the real tool to `target`, near `start` and within the bounds of
/// `cycle`.
///
/// `step` returns the real pose at a configuration and fills in the nominal `J_q` with
/// rotation-vector rows, one column per variable, as a generated `compensator_step` does. It is
/// called at most `ITERATIONS + 2` times, with `columns` as scratch space. The result is the best
/// configuration evaluated; it is never worse than `start` if `start` is within the bounds. Where
/// position and rotation cannot both be reached, position has priority (1 rad weighs as much as 1
/// mm).
///
/// [`Compensated::after`] is the remaining error, and [`Compensated::status`] says why more than
/// [`REACHED`] remains. Entries that `cycle` lacks are those of [`Cycle::UNBOUNDED`].
/// `abbe::analysis::compensated` iterates as often as necessary. Returns an error only if `step`
/// does.
pub fn compensate<Q, C>(
    description: &Description,
    target: &Pose,
    start: &Q,
    cycle: &Cycle<impl AsRef<[f64]>>,
    mut columns: C,
    mut step: impl FnMut(&Q, &mut C) -> Result<Pose, Error>,
) -> Result<Compensated<Q>, Error>
where
    Q: Clone + AsRef<[f64]> + AsMut<[f64]>,
    C: AsMut<[[f64; 6]]>,
{
    let problem = Problem::new(description, target, cycle.rotations);
    let bounds = Bounds::new(problem.variables, start, cycle);
    let error = |real: &Pose| deviation(Orientation::RotationVector, target, real);

    let before = error(&step(start, &mut columns)?);
    let (mut best, mut left) = (bounds.begin.clone(), before);
    if best.as_ref() != start.as_ref() {
        left = error(&step(&best, &mut columns)?);
    }
    let mut least = problem.cost(&left);
    let (mut q, mut from, mut towards) = (best.clone(), best.clone(), best.clone());
    let (mut after, mut cost, mut solved) = (left, least, 0);
    let (mut accepted, mut length) = (f64::INFINITY, f64::INFINITY);
    let mut is_moving = false;
    for _ in 0..ITERATIONS {
        problem.depart(&bounds, &q, &mut towards, columns.as_mut(), &after, &mut solved);
        let next = problem.largest_step(q.as_ref(), towards.as_ref());
        if next < CONTRACTION * length || cost < accepted {
            (from, accepted, length) = (q, cost, next);
            q = towards.clone();
        } else {
            for (j, (q, from)) in q.as_mut().iter_mut().zip(from.as_ref()).enumerate() {
                *q = bounds.clamped(j, from + (*q - from) * SHORTER);
            }
        }
        let moved = problem.largest_step(from.as_ref(), q.as_ref());
        after = error(&step(&q, &mut columns)?);
        cost = problem.cost(&after);
        is_moving = cost < least && moved > REST;
        if cost < least {
            (best, left, least) = (q.clone(), after, cost);
        }
        if moved <= REST {
            break;
        }
    }
    if bounds.contain(start.as_ref()) && problem.cost(&before) < least {
        (best, left) = (start.clone(), before);
    }
    let status = match () {
        () if bounds.are_beyond(start.as_ref()) => Status::OutsideLimits,
        () if problem.is_reached(&left) => Status::Reached,
        () if bounds.hold(best.as_ref()) => Status::Held,
        () if is_moving => Status::NotConverged,
        () => Status::NotReached,
    };
    let mut correction = best.clone();
    for (correction, command) in correction.as_mut().iter_mut().zip(bounds.command.as_ref()) {
        *correction -= command;
    }
    Ok(Compensated { q: best, correction, before, after: left, status })
}

/// Returns `true` if at most [`REACHED`] is left of the whole pose.
pub fn is_reached(description: &Description, after: &[f64; 6]) -> bool {
    Problem::new(description, &Pose::IDENTITY, [1.0; 3]).is_reached(after)
}

/// Least-squares problem, with lengths in metres and angles in rad.
struct Problem<'a> {
    variables: &'a [Variable],
    /// One metre in the manipulator's unit.
    metre: f64,
    /// Axes of the tool at the target, multiplied by the weights of the rotations about them.
    axes: [[f64; 3]; 3],
}

impl<'a> Problem<'a> {
    fn new(description: &'a Description, target: &Pose, rotations: [f64; 3]) -> Self {
        let [x, y, z, _] = target.0;
        let [a, b, c] = rotations;
        let axes = [(x, a), (y, b), (z, c)].map(|(axis, weight)| axis.map(|entry| entry * weight));
        Self { variables: &description.variables, metre: 1.0 / description.length.in_metres(), axes }
    }

    /// Returns the position in metres, and the rotations about the axes of the tool, weighted.
    fn weighted(&self, rows: [f64; 6]) -> [f64; 6] {
        let ([x, y, z, ..], length) = (rows, 1.0 / self.metre);
        let [a, b, c] = self.axes.map(|axis| dot(&axis, &rows[3..]) * LEVER);
        [x * length, y * length, z * length, a, b, c]
    }

    fn cost(&self, after: &[f64; 6]) -> f64 {
        let weighted = self.weighted(*after);
        dot(&weighted, &weighted)
    }

    fn is_reached(&self, after: &[f64; 6]) -> bool {
        let ((position, rotation), [distance, angle]) = (norms(&self.weighted(*after)), REACHED);
        position <= distance && rotation <= angle * LEVER
    }

    /// Returns one metre or one rad in the unit of the variable.
    fn unit(&self, j: usize) -> f64 {
        self.variables[j].kind.either(1.0, self.metre)
    }

    /// Returns the largest change of a variable, in metres and rad.
    fn largest_step(&self, from: &[f64], to: &[f64]) -> f64 {
        let steps = from.iter().zip(to).enumerate();
        steps.map(|(j, (from, to))| Scalar::abs(to - from) / self.unit(j)).fold(0.0, f64::max)
    }
}

/// Interval of each joint in one cycle: its limits, and the bounds of its correction.
struct Bounds<Q> {
    /// The command, at its limits where it is beyond them.
    command: Q,
    /// First configuration of the iterations: the command with the correction of the previous
    /// cycle.
    begin: Q,
    lower: Q,
    upper: Q,
    /// Ends without the bound of the change.
    least: Q,
    most: Q,
}

impl<Q: Clone + AsRef<[f64]> + AsMut<[f64]>> Bounds<Q> {
    fn new(variables: &[Variable], start: &Q, cycle: &Cycle<impl AsRef<[f64]>>) -> Self {
        let entry = |list: &[f64], j: usize, missing: f64| list.get(j).copied().unwrap_or(missing);
        let [mut command, mut begin, mut lower, mut upper, mut least, mut most] =
            [(); 6].map(|()| start.clone());
        for (j, variable) in variables.iter().enumerate() {
            let at = clamped(start.as_ref()[j], variable.limits);
            let last = entry(cycle.last.as_ref(), j, 0.0);
            // `max` replaces NaN.
            let change = entry(cycle.change.as_ref(), j, f64::INFINITY).max(0.0);
            let largest = entry(cycle.largest.as_ref(), j, f64::INFINITY).max(0.0);
            let window = [last - change, last + change];
            let within = |correction: f64| clamped(at + clamped(correction, window), variable.limits);
            command.as_mut()[j] = at;
            least.as_mut()[j] = clamped(at - largest, variable.limits);
            most.as_mut()[j] = clamped(at + largest, variable.limits);
            lower.as_mut()[j] = within(-largest);
            upper.as_mut()[j] = within(largest);
            begin.as_mut()[j] = clamped(at + last, [lower.as_ref()[j], upper.as_ref()[j]]);
        }
        Self { command, begin, lower, upper, least, most }
    }

    fn contain(&self, q: &[f64]) -> bool {
        q.iter().enumerate().all(|(j, value)| self.clamped(j, *value) == *value)
    }

    /// Returns `true` if a command is beyond the limits, and not by rounding.
    fn are_beyond(&self, start: &[f64]) -> bool {
        let mut both = start.iter().zip(self.command.as_ref());
        both.any(|(q, nearest)| Scalar::abs(nearest - q) > AT_LIMIT * Scalar::abs(*q))
    }

    /// Returns `true` if a joint is at an end of its interval.
    fn hold(&self, q: &[f64]) -> bool {
        let mut ends = q.iter().zip(self.lower.as_ref().iter().zip(self.upper.as_ref()));
        ends.any(|(value, (lower, upper))| value <= lower || value >= upper)
    }
}

impl<Q: AsRef<[f64]>> Bounds<Q> {
    fn clamped(&self, j: usize, value: f64) -> f64 {
        clamped(value, [self.lower.as_ref()[j], self.upper.as_ref()[j]])
    }
}

/// Returns the nearest value of an interval, and its lower end for NaN.
fn clamped(value: f64, [lower, upper]: [f64; 2]) -> f64 {
    value.max(lower).min(upper)
}
