//! What is tried for one target, descent after descent: from where, and within limits or without.

use core::f64::consts::TAU;
use core::ops::ControlFlow;

use super::ReachError;
use crate::sampling;
use abbe_core::{Description, Error, Manipulator, Quantity, Variable, VariableKind};

/// A target counts as reached below this residual: lengths in arm lengths, angles in rad.
pub(super) const REACHED: f64 = 1e-10;
/// Below this there is nothing left to gain.
pub(super) const ROUNDING: f64 = 1e-14;
/// How far beyond a limit still counts as at it, in shares of the range.
const AT_LIMIT: f64 = 1e-9;
/// A step that gains less than this share gains nothing.
pub(super) const STAGNATION: f64 = 1e-9;
/// The most steps of a descent.
pub(super) const ITERATIONS: usize = 200;
/// What creeps ends short of the target: where the search is to begin, this is seen late; at one of many starts, soon.
const PATIENT: Patience = Patience { steps: 10, gain: 0.01 };
const IMPATIENT: Patience = Patience { steps: 5, gain: 0.1 };
/// How near it comes is told to six digits.
const EXACT: Patience = Patience { steps: 10, gain: 1e-7 };
/// Enough for a 6R arm to be brought to each of 1000 sampled poses; half as many miss one.
const RESTARTS: usize = 32;
/// So many solutions beyond the limits are compared: the first is the one next to where the limits stop it.
const COMPARED: usize = 4;

/// A manipulator, of which some variables are free.
pub(super) struct Problem<'a> {
    pub(super) manipulator: &'a dyn Manipulator,
    pub(super) s: Vec<f64>,
    /// Indices of the free variables, in ascending order.
    pub(super) free: Vec<usize>,
    pub(super) arm: f64,
    /// Where descents begin, all of `q`: where the caller wants to, then points spread within the limits.
    pub(super) starts: Vec<Vec<f64>>,
}

/// A descent that is asked for.
pub(super) struct Descent {
    pub(super) q: Vec<f64>,
    pub(super) bounded: bool,
    pub(super) patience: Patience,
}

/// A descent ends early where so many steps gain less than this share of the residual.
#[derive(Clone, Copy, Debug)]
pub(super) struct Patience {
    pub(super) steps: usize,
    pub(super) gain: f64,
}

/// Where a descent ended: the norm of the residual, and its position (arm lengths) and turn (rad).
pub(super) struct Ended {
    pub(super) q: Vec<f64>,
    pub(super) norm: f64,
    pub(super) position: f64,
    pub(super) turn: f64,
}

/// The next descent, or the answer.
type Next = ControlFlow<Result<Vec<f64>, ReachError>, Descent>;

/// What is known of a target before it is searched for.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Prospect {
    /// Out of reach, limits aside.
    Never,
    /// Out of reach within the limits.
    BeyondLimits,
    /// Nothing.
    Open,
}

/// The search for one target.
pub(super) struct Quest {
    stage: Stage,
    /// Known once the first descent has failed.
    prospect: Option<Prospect>,
    /// Where it comes nearest within the limits.
    stopped_at: Option<Ended>,
    /// How many solutions outside the limits were found, and of the one that is least beyond: its worst variable, how far, its value.
    solutions: usize,
    least: Option<(usize, f64, f64)>,
    /// Where it comes nearest, limits aside.
    nearest: Option<Ended>,
    failure: Error,
}

enum Stage {
    /// Within the limits, from a start.
    Within(usize),
    /// Without limits, to say what stops it: from where it comes nearest within them, then from a start.
    Beyond(usize),
    /// From a solution beyond limits, brought back by whole turns.
    Turned(usize, Vec<f64>),
    /// Without limits, as near as it comes.
    Nearest,
}

impl<'a> Problem<'a> {
    /// Errors where a variable that is not free is outside its limits.
    pub(super) fn new(
        manipulator: &'a dyn Manipulator,
        s: &[f64],
        start: &[f64],
        free: &[usize],
    ) -> Result<Self, ReachError> {
        let variables = &manipulator.description().variables;
        crate::workspace::in_range(free.iter().copied(), Quantity::Variables, variables.len())?;
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
        Ok(Self { manipulator, s: s.to_vec(), free, arm, starts: vec![start.to_vec()] })
    }

    /// Takes further starts in, for what is not reached from the first one.
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

    /// The length of one unit of step of a free variable.
    pub(super) fn unit(&self, free: usize) -> f64 {
        match self.variable(free).kind {
            VariableKind::Revolute => 1.0,
            VariableKind::Prismatic => self.arm,
        }
    }

    /// Free revolute variables brought back by whole turns, towards the middle of their limits.
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

impl Quest {
    /// Begins with a start, which is not the first if that was tried.
    pub(super) fn new(problem: &Problem<'_>, start: usize) -> (Self, Descent) {
        let failure = Error::NotFinite { quantity: Quantity::Pose, index: 0 };
        let stage = Stage::Within(start);
        let quest = Self {
            stage,
            prospect: None,
            stopped_at: None,
            solutions: 0,
            least: None,
            nearest: None,
            failure,
        };
        (quest, from(problem, start, true))
    }

    /// After a descent has ended. What is known of the target is asked for if it was not reached at once.
    pub(super) fn next(
        &mut self,
        problem: &Problem<'_>,
        ended: Result<Ended, Error>,
        prospect: impl FnOnce() -> Prospect,
    ) -> Next {
        let reached = ended.as_ref().is_ok_and(|ended| ended.norm <= REACHED);
        match (core::mem::replace(&mut self.stage, Stage::Nearest), ended) {
            (Stage::Within(_) | Stage::Turned(..), Ok(ended)) if reached => ControlFlow::Break(Ok(ended.q)),
            (Stage::Within(start), ended) => {
                match ended {
                    Ok(ended) => keep_nearer(&mut self.stopped_at, ended),
                    Err(error) => self.failure = error,
                }
                match *self.prospect.get_or_insert_with(prospect) {
                    Prospect::Open if start + 1 < problem.starts.len() => {
                        self.stage = Stage::Within(start + 1);
                        ControlFlow::Continue(from(problem, start + 1, true))
                    }
                    Prospect::Open | Prospect::BeyondLimits => self.beyond(problem, 0),
                    Prospect::Never => {
                        self.nearest = self.stopped_at.take();
                        self.nearest(problem)
                    }
                }
            }
            (stage @ (Stage::Beyond(_) | Stage::Nearest), Ok(ended)) if reached => {
                let start = if let Stage::Beyond(start) = stage { start } else { problem.starts.len() };
                let q = problem.turned(&ended.q);
                if self.prospect == Some(Prospect::BeyondLimits) {
                    return self.stopped(problem, start, &q);
                }
                // It may lie within the limits by whole turns, or just at one of them.
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

    /// A solution that lies beyond limits.
    fn stopped(&mut self, problem: &Problem<'_>, start: usize, q: &[f64]) -> Next {
        let variables = &problem.description().variables;
        let beyond = |&i: &usize| (i, beyond(&variables[i], q[i]), q[i]);
        let worst = problem.free.iter().map(beyond).max_by(|a, b| a.1.total_cmp(&b.1));
        self.least = [self.least, worst].into_iter().flatten().min_by(|a, b| a.1.total_cmp(&b.1));
        self.solutions += 1;
        self.beyond(problem, start + 1)
    }

    /// The next descent without limits.
    fn beyond(&mut self, problem: &Problem<'_>, start: usize) -> Next {
        if start <= problem.starts.len() && self.solutions < COMPARED {
            self.stage = Stage::Beyond(start);
            return match (start, &self.stopped_at) {
                (0, None) => self.beyond(problem, 1),
                (0, Some(Ended { q, .. })) => {
                    ControlFlow::Continue(Descent { q: q.clone(), bounded: false, patience: PATIENT })
                }
                _ => ControlFlow::Continue(from(problem, start - 1, false)),
            };
        }
        if let Some((variable, _, value)) = self.least {
            return ControlFlow::Break(Err(outside(&problem.description().variables, variable, value)));
        }
        self.nearest(problem)
    }

    /// On from where it came nearest, limits aside.
    fn nearest(&mut self, problem: &Problem<'_>) -> Next {
        let q = self.nearest.as_ref().map_or(&problem.starts[0], |nearest| &nearest.q).clone();
        self.stage = Stage::Nearest;
        ControlFlow::Continue(Descent { q, bounded: false, patience: EXACT })
    }

    fn out_of_reach(&mut self, problem: &Problem<'_>, ended: Result<Ended, Error>) -> ReachError {
        let failure = *ended.as_ref().err().unwrap_or(&self.failure);
        match ended.ok().or(self.nearest.take()) {
            Some(Ended { position, turn, .. }) => {
                ReachError::OutOfReach { residual: position * problem.arm, turn }
            }
            None => failure.into(),
        }
    }
}

fn from(problem: &Problem<'_>, start: usize, bounded: bool) -> Descent {
    Descent { q: problem.starts[start].clone(), bounded, patience: patience(start) }
}

fn keep_nearer(nearest: &mut Option<Ended>, ended: Ended) {
    if nearest.as_ref().is_none_or(|nearest| ended.norm < nearest.norm) {
        *nearest = Some(ended);
    }
}

fn patience(start: usize) -> Patience {
    if start == 0 { PATIENT } else { IMPATIENT }
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
