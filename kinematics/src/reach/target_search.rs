//! Sequence of descents for one target: their starts, within limits or without.

use core::{f64::consts::TAU, ops::ControlFlow};

use super::{ReachError, SumLimits};
use crate::sampling;
use abbe_core::{Description, Error, Manipulator, Quantity, Variable, VariableKind, checks};

/// Residual at which a target counts as reached: lengths in arm lengths, angles in rad.
pub(super) const REACHED: f64 = 1e-10;
/// Residual below which only rounding errors remain.
pub(super) const ROUNDING: f64 = 1e-14;
/// Distance beyond a limit that still counts as at the limit, relative to the range.
pub(super) const AT_LIMIT: f64 = 1e-9;
/// Relative decrease below which a step makes no progress.
pub(super) const STAGNATION: f64 = 1e-9;
/// Largest number of steps of a descent.
pub(super) const ITERATIONS: usize = 200;
/// Patience of the first descent. Slow convergence ends short of the target; later starts are
/// abandoned sooner.
const PATIENT: Patience = Patience { steps: 10, gain: 0.01 };
const IMPATIENT: Patience = Patience { steps: 5, gain: 0.1 };
/// Patience of the descent that determines the smallest distance to six digits.
const EXACT: Patience = Patience { steps: 10, gain: 1e-7 };
/// Number of restarts. Reaches each of 1000 sampled poses of a 6R arm; half as many miss one.
const RESTARTS: usize = 32;
/// Number of solutions beyond the limits that are compared. The first starts from the best point
/// within the limits.
const COMPARED: usize = 4;

/// Manipulator with some free variables.
pub(super) struct Problem<'a> {
    pub(super) manipulator: &'a dyn Manipulator,
    pub(super) s: Vec<f64>,
    /// Indices of the free variables that follow no others, in ascending order.
    pub(super) free: Vec<usize>,
    pub(super) sums: SumLimits,
    pub(super) arm: f64,
    /// Starts of the descents, all of `q`: the caller's start, followed by points spread within the
    /// limits.
    pub(super) starts: Vec<Vec<f64>>,
}

/// Descent to be run.
pub(super) struct Descent {
    pub(super) q: Vec<f64>,
    pub(super) bounded: bool,
    pub(super) patience: Patience,
}

/// Early end of a descent: this many steps must reduce the residual by at least the share `gain`.
#[derive(Clone, Copy, Debug)]
pub(super) struct Patience {
    pub(super) steps: usize,
    pub(super) gain: f64,
}

/// Result of a descent: the norm of the residual, with its position (arm lengths) and rotation
/// (rad).
pub(super) struct DescentEnd {
    pub(super) q: Vec<f64>,
    pub(super) norm: f64,
    pub(super) position: f64,
    pub(super) turn: f64,
}

/// Next descent, or the result.
type Next = ControlFlow<Result<Vec<f64>, ReachError>, Descent>;

/// Classification of a target before a search.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Reachability {
    /// Out of reach even without limits.
    Never,
    /// Out of reach within the limits.
    BeyondLimits,
    /// Possibly within reach.
    Open,
}

/// State of the search for one target.
pub(super) struct TargetSearch {
    stage: Stage,
    /// Set after the first descent has failed.
    reachability: Option<Reachability>,
    /// Best point within the limits.
    stopped_at: Option<DescentEnd>,
    /// Number of solutions found outside the limits; `least` is the one least beyond them: its
    /// worst variable, distance and value.
    solutions: usize,
    least: Option<(usize, f64, f64)>,
    /// Best point without limits.
    nearest: Option<DescentEnd>,
    /// Limit of a sum that a solution within the limits of the variables exceeds.
    refused: Option<ReachError>,
    failure: Error,
}

enum Stage {
    /// Descent within the limits, from a start.
    Within(usize),
    /// Descent without limits, to name the limiting variable: first from the best point within
    /// them, then from a start.
    Beyond(usize),
    /// Descent from a solution beyond limits, brought back by full turns.
    Turned(usize, Vec<f64>),
    /// Descent without limits to the smallest distance.
    Nearest,
}

impl<'a> Problem<'a> {
    /// Creates the problem. Fails if a fixed variable is outside its limits.
    pub(super) fn new(
        manipulator: &'a dyn Manipulator,
        s: &[f64],
        start: &[f64],
        free: &[usize],
    ) -> Result<Self, ReachError> {
        let variables = &manipulator.description().variables;
        crate::configuration::in_range(free.iter().copied(), Quantity::Variables, variables.len())?;
        checks::length(Quantity::Variables, [variables.len(), 1], start.len())?;
        let arm = sampling::arm_length(manipulator, s)?;
        let mut free = free.to_vec();
        free.sort_unstable();
        free.dedup();
        let sums = SumLimits::new(manipulator.description(), &free.iter().rev().copied().collect::<Vec<_>>());
        let mut held = (0..variables.len()).filter(|i| !free.contains(i));
        if let Some(i) = held.find(|&i| beyond(&variables[i], start[i]) > AT_LIMIT) {
            return Err(outside_limits(variables, i, start[i]));
        }
        free.retain(|i| sums.followers.iter().all(|follower| follower.variable != *i));
        Ok(Self { manipulator, s: s.to_vec(), free, sums, arm, starts: vec![start.to_vec()] })
    }

    /// Adds further starts, for targets that the first does not reach.
    pub(super) fn spread(&mut self) {
        let description = self.description();
        let first = &self.starts[0];
        let start = |index: usize| {
            let sample = sampling::joint_sample(description, self.arm, &self.free, index);
            let mut start = first.clone();
            self.free.iter().for_each(|&i| start[i] = sample[i]);
            start
        };
        let others: Vec<Vec<f64>> = (0..RESTARTS).map(start).collect();
        self.starts.truncate(1);
        self.starts.extend(others);
    }

    pub(super) fn description(&self) -> &'a Description {
        self.manipulator.description()
    }

    pub(super) fn variable(&self, free: usize) -> &'a Variable {
        &self.description().variables[self.free[free]]
    }

    /// Returns the length of one unit of step of a free variable.
    pub(super) fn unit(&self, free: usize) -> f64 {
        self.variable(free).kind.either(1.0, self.arm)
    }

    /// Brings free revolute variables back by full turns, towards the center of their limits.
    fn turned(&self, q: &[f64]) -> Vec<f64> {
        let mut q = q.to_vec();
        for &i in &self.free {
            let Variable { kind, limits: [lower, upper], .. } = self.description().variables[i];
            let middle = (lower + upper) / 2.0;
            if kind == VariableKind::Revolute {
                let middle = if middle.is_finite() { middle } else { 0.0 };
                q[i] -= TAU * ((q[i] - middle) / TAU).round();
            }
        }
        q
    }
}

impl TargetSearch {
    /// Begins with start number `start`.
    pub(super) fn new(problem: &Problem<'_>, start: usize) -> (Self, Descent) {
        let target_search = Self {
            stage: Stage::Within(start),
            reachability: None,
            stopped_at: None,
            solutions: 0,
            least: None,
            nearest: None,
            refused: None,
            failure: Error::NotFinite { quantity: Quantity::Pose, index: 0 },
        };
        (target_search, from(problem, start, true))
    }

    /// Processes the result of a descent. Calls `reachability` once, when the first descent has
    /// failed.
    pub(super) fn next(
        &mut self,
        problem: &Problem<'_>,
        ended: Result<DescentEnd, Error>,
        reachability: impl FnOnce() -> Reachability,
    ) -> Next {
        let mut reached = ended.as_ref().is_ok_and(|ended| ended.norm <= REACHED);
        if let (true, Stage::Within(_) | Stage::Turned(..), Ok(ended)) = (reached, &self.stage, &ended) {
            self.refused = problem.sums.check(&ended.q).err().or(self.refused);
            reached = problem.sums.check(&ended.q).is_ok();
        }
        match (core::mem::replace(&mut self.stage, Stage::Nearest), ended) {
            (Stage::Within(_) | Stage::Turned(..), Ok(ended)) if reached => ControlFlow::Break(Ok(ended.q)),
            (Stage::Within(start), ended) => {
                match ended {
                    Ok(ended) => keep_nearer(&mut self.stopped_at, ended),
                    Err(error) => self.failure = error,
                }
                match *self.reachability.get_or_insert_with(reachability) {
                    Reachability::Open if start + 1 < problem.starts.len() => {
                        self.stage = Stage::Within(start + 1);
                        ControlFlow::Continue(from(problem, start + 1, true))
                    }
                    Reachability::Open | Reachability::BeyondLimits => match self.refused {
                        Some(refused) => ControlFlow::Break(Err(refused)),
                        None => self.beyond(problem, 0),
                    },
                    Reachability::Never => {
                        self.nearest = self.stopped_at.take();
                        self.nearest(problem)
                    }
                }
            }
            (stage @ (Stage::Beyond(_) | Stage::Nearest), Ok(ended)) if reached => {
                let start = if let Stage::Beyond(start) = stage { start } else { problem.starts.len() };
                let q = problem.turned(&ended.q);
                if self.reachability == Some(Reachability::BeyondLimits) {
                    return self.stopped(problem, start, &q);
                }
                // It may lie within the limits up to full turns, or just at a limit.
                self.stage = Stage::Turned(start, q.clone());
                ControlFlow::Continue(Descent { q, bounded: true, patience: PATIENT })
            }
            (Stage::Beyond(start), Ok(ended)) => {
                keep_nearer(&mut self.nearest, ended);
                self.beyond(problem, start + 1)
            }
            (Stage::Beyond(start), Err(error)) => {
                self.failure = error;
                self.beyond(problem, start + 1)
            }
            (Stage::Turned(start, q), _) => self.stopped(problem, start, &q),
            (Stage::Nearest, ended) => ControlFlow::Break(Err(self.out_of_reach(problem, ended))),
        }
    }

    /// Records a solution that lies beyond limits.
    fn stopped(&mut self, problem: &Problem<'_>, start: usize, q: &[f64]) -> Next {
        let variables = &problem.description().variables;
        let beyond = |&i: &usize| (i, beyond(&variables[i], q[i]), q[i]);
        let worst = problem.free.iter().map(beyond).max_by(|a, b| a.1.total_cmp(&b.1));
        self.least = [self.least, worst].into_iter().flatten().min_by(|a, b| a.1.total_cmp(&b.1));
        self.solutions += 1;
        self.beyond(problem, start + 1)
    }

    /// Returns the next descent without limits.
    fn beyond(&mut self, problem: &Problem<'_>, start: usize) -> Next {
        if start <= problem.starts.len() && self.solutions < COMPARED {
            self.stage = Stage::Beyond(start);
            return match (start, &self.stopped_at) {
                (0, None) => self.beyond(problem, 1),
                (0, Some(DescentEnd { q, .. })) => {
                    ControlFlow::Continue(Descent { q: q.clone(), bounded: false, patience: PATIENT })
                }
                _ => ControlFlow::Continue(from(problem, start - 1, false)),
            };
        }
        if let Some(refused) = self.refused {
            return ControlFlow::Break(Err(refused));
        }
        if let Some((variable, _, value)) = self.least {
            let variables = &problem.description().variables;
            return ControlFlow::Break(Err(outside_limits(variables, variable, value)));
        }
        self.nearest(problem)
    }

    /// Continues from the best point without limits.
    fn nearest(&mut self, problem: &Problem<'_>) -> Next {
        let q = self.nearest.as_ref().map_or(&problem.starts[0], |nearest| &nearest.q).clone();
        self.stage = Stage::Nearest;
        ControlFlow::Continue(Descent { q, bounded: false, patience: EXACT })
    }

    fn out_of_reach(&mut self, problem: &Problem<'_>, ended: Result<DescentEnd, Error>) -> ReachError {
        let failure = *ended.as_ref().err().unwrap_or(&self.failure);
        match ended.ok().or(self.nearest.take()) {
            Some(DescentEnd { position, turn, .. }) => {
                ReachError::OutOfReach { residual: position * problem.arm, turn }
            }
            None => failure.into(),
        }
    }
}

/// Returns the descent from a start, within limits or without.
pub(super) fn from(problem: &Problem<'_>, start: usize, bounded: bool) -> Descent {
    Descent { q: problem.starts[start].clone(), bounded, patience: patience(start) }
}

fn keep_nearer(nearest: &mut Option<DescentEnd>, ended: DescentEnd) {
    if nearest.as_ref().is_none_or(|nearest| ended.norm < nearest.norm) {
        *nearest = Some(ended);
    }
}

fn patience(start: usize) -> Patience {
    if start == 0 { PATIENT } else { IMPATIENT }
}

/// Returns the distance of a value beyond the limits of its variable, relative to the range.
fn beyond(variable: &Variable, value: f64) -> f64 {
    let [lower, upper] = variable.limits;
    let range = upper - lower;
    let share = if range.is_finite() && range > 0.0 { range } else { 1.0 };
    (lower - value).max(value - upper).max(0.0) / share
}

fn outside_limits(variables: &[Variable], variable: usize, value: f64) -> ReachError {
    ReachError::OutsideLimits { variable, value, limits: variables[variable].limits }
}
