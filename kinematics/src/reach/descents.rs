//! Damped Newton steps on a chain of lower pairs for several targets at once: one target per lane.
//!
//! Each lane depends on its own numbers alone: its result does not depend on the targets in the
//! others.

// Loops instead of closures, which could be compiled without the instruction set.
#![allow(clippy::needless_range_loop)]

use core::ops::ControlFlow;

use super::bounds::Bounds;
use super::joint_chain::{JointChain, scaled, shift};
use super::lane_chain::LaneChain;
use super::pose_error::PoseError;
use super::target_search::{
    Descent, DescentEnd, ITERATIONS, Patience, Problem, REACHED, ROUNDING, STAGNATION, TargetSearch,
};
use super::{ReachError, Target};
use abbe_core::lanes::{Kernel, Lanes, Register};
use abbe_core::{Error, Quantity, Scalar};

/// Largest number of lanes.
const WIDEST: usize = 8;

/// Targets of one kind: points (3 rows) or poses (6 rows).
pub(super) struct Descents<'a, const ROWS: usize> {
    pub(super) problem: &'a Problem<'a>,
    pub(super) chain: &'a JointChain,
    pub(super) targets: &'a [Target],
    pub(super) bounds: &'a Bounds,
    /// Index of the first start.
    pub(super) start: usize,
}

/// State of the search in one lane.
struct Lane {
    target: usize,
    target_search: TargetSearch,
    bounded: bool,
    patience: Patience,
    iteration: usize,
    /// Iteration at which the progress is next checked.
    looked_at: usize,
    /// `true` before the first evaluation.
    fresh: bool,
    /// `true` if no variable can move.
    stuck: bool,
    norm: f64,
    before: f64,
    damping: f64,
}

/// States of all lanes: variables in rad and arm lengths.
struct LaneStates<R: Register, const ROWS: usize> {
    q: Vec<Lanes<R>>,
    candidate: Vec<Lanes<R>>,
    step: Vec<Lanes<R>>,
    /// 1 where a variable may move, 0 where a limit holds it.
    active: Vec<Lanes<R>>,
    limits: Vec<[Lanes<R>; 2]>,
    target: [[Lanes<R>; 3]; 4],
    here: PoseError<R, ROWS>,
    there: PoseError<R, ROWS>,
    /// Norm at the candidate.
    after: Lanes<R>,
}

impl<const ROWS: usize> Kernel for Descents<'_, ROWS> {
    type Output = Vec<Result<Vec<f64>, ReachError>>;

    #[inline(always)]
    fn run<R: Register>(self) -> Self::Output {
        let mut results: Vec<Option<Result<Vec<f64>, ReachError>>> = vec![None; self.targets.len()];
        let mut waiting = 0..self.targets.len();
        let chain = LaneChain::<R>::new(self.chain);
        let mut states = LaneStates::<R, ROWS>::new(chain.joints.len());
        let mut lanes: [Option<Lane>; WIDEST] = [const { None }; WIDEST];
        for (place, lane) in lanes[..R::WIDTH].iter_mut().enumerate() {
            *lane = self.next_target(&mut waiting, place, &mut states);
        }
        while lanes.iter().any(Option::is_some) {
            states.there.evaluate(&chain, &states.candidate, &states.target);
            states.after = states.there.norm;
            states.take_over(&lanes);
            for place in 0..R::WIDTH {
                let Some(lane) = &mut lanes[place] else { continue };
                let Some(ended) = lane.ended(&states, place, self.problem) else { continue };
                let reachability = || self.bounds.reachability(&self.targets[lane.target]);
                match lane.target_search.next(self.problem, ended, reachability) {
                    ControlFlow::Continue(descent) => {
                        lane.begin(&descent);
                        states.load(self.problem, place, &descent);
                    }
                    ControlFlow::Break(result) => {
                        results[lane.target] = Some(result);
                        lanes[place] = self.next_target(&mut waiting, place, &mut states);
                    }
                }
            }
            states.steps(&chain, &mut lanes);
        }
        results.into_iter().flatten().collect()
    }
}

impl<const ROWS: usize> Descents<'_, ROWS> {
    fn next_target<R: Register>(
        &self,
        waiting: &mut core::ops::Range<usize>,
        place: usize,
        states: &mut LaneStates<R, ROWS>,
    ) -> Option<Lane> {
        let target = waiting.next()?;
        let pose = match self.targets[target] {
            Target::Point(point) | Target::Axis { point, .. } => shift(point),
            Target::Pose(pose) => pose,
        };
        let pose = scaled(&pose, self.problem.arm);
        for (column, values) in states.target.iter_mut().zip(pose.0) {
            for (lanes, value) in column.iter_mut().zip(values) {
                put(lanes, place, value);
            }
        }
        let (target_search, descent) = TargetSearch::new(self.problem, self.start);
        let mut lane = Lane {
            target,
            target_search,
            bounded: true,
            patience: descent.patience,
            iteration: 0,
            looked_at: 0,
            fresh: true,
            stuck: false,
            norm: f64::INFINITY,
            before: f64::INFINITY,
            damping: 0.0,
        };
        lane.begin(&descent);
        states.load(self.problem, place, &descent);
        Some(lane)
    }
}

impl Lane {
    fn begin(&mut self, descent: &Descent) {
        (self.bounded, self.patience) = (descent.bounded, descent.patience);
        (self.iteration, self.looked_at, self.fresh, self.stuck) = (0, 0, true, false);
        (self.norm, self.before, self.damping) = (f64::INFINITY, f64::INFINITY, 0.0);
    }

    /// Updates the state after a step. Returns the result of the descent if it has ended.
    fn ended<R: Register, const ROWS: usize>(
        &mut self,
        states: &LaneStates<R, ROWS>,
        place: usize,
        problem: &Problem<'_>,
    ) -> Option<Result<DescentEnd, Error>> {
        let norm = states.after.as_slice()[place];
        let ended = || Some(Ok(states.ended(problem, place, self.bounded)));
        if self.fresh && !norm.is_finite() {
            return Some(Err(Error::NotFinite { quantity: Quantity::Jacobian, index: 0 }));
        }
        // A step must reduce the norm enough.
        if norm < self.norm * (1.0 - STAGNATION) {
            let squared = self.norm * self.norm;
            self.damping = if self.damping > squared { self.damping / 10.0 } else { 0.0 };
            (self.norm, self.fresh) = (norm, false);
        } else {
            // Only rounding errors remain.
            if self.norm <= REACHED * 1e-2 || self.damping > 1e3 || self.stuck {
                return ended();
            }
            self.damping = f64::max(self.damping * 10.0, 0.01 * self.norm * self.norm);
        }
        if self.norm <= ROUNDING || self.iteration == ITERATIONS {
            return ended();
        }
        if self.iteration == self.looked_at {
            self.looked_at += self.patience.steps;
            if self.norm > self.before * (1.0 - self.patience.gain) {
                return ended();
            }
            self.before = self.norm;
        }
        self.iteration += 1;
        None
    }
}

impl<R: Register, const ROWS: usize> LaneStates<R, ROWS> {
    fn new(count: usize) -> Self {
        let zero = Lanes::constant(0.0);
        Self {
            q: vec![zero; count],
            candidate: vec![zero; count],
            step: vec![zero; count],
            active: vec![zero; count],
            limits: vec![[zero; 2]; count],
            target: [[zero; 3]; 4],
            here: PoseError::new(count),
            there: PoseError::new(count),
            after: zero,
        }
    }

    /// Loads the start of a descent into a lane.
    fn load(&mut self, problem: &Problem<'_>, place: usize, descent: &Descent) {
        for (j, &i) in problem.free.iter().enumerate() {
            let unit = problem.unit(j);
            let limits = problem.variable(j).limits.map(|limit| limit / unit);
            let [lower, upper] = if descent.bounded { limits } else { [f64::NEG_INFINITY, f64::INFINITY] };
            let value = (descent.q[i] / unit).min(upper).max(lower);
            put(&mut self.candidate[j], place, value);
            put(&mut self.limits[j][0], place, lower);
            put(&mut self.limits[j][1], place, upper);
        }
    }

    /// Moves the lanes whose candidate is better to it.
    #[inline(always)]
    fn take_over(&mut self, lanes: &[Option<Lane>; WIDEST]) {
        let norm = |lane: &Lane| lane.norm * (1.0 - STAGNATION);
        let before = Lanes::<R>::from_fn(|place| lanes[place].as_ref().map_or(f64::INFINITY, norm));
        let better = before.more_than(self.there.norm);
        let (zero, one) = (Lanes::<R>::constant(0.0), Lanes::<R>::constant(1.0));
        if !better.select(zero, one).more_than(zero).any() {
            core::mem::swap(&mut self.q, &mut self.candidate);
            core::mem::swap(&mut self.here, &mut self.there);
            return;
        }
        for (here, there) in self.q.iter_mut().zip(&self.candidate) {
            *here = better.select(*there, *here);
        }
        self.here.replace(&self.there, better);
    }

    /// Computes a step in every lane. Variables at a limit that the step would exceed stay fixed.
    #[inline(always)]
    fn steps(&mut self, chain: &LaneChain<R>, lanes: &mut [Option<Lane>; WIDEST]) {
        let (zero, one) = (Lanes::<R>::constant(0.0), Lanes::<R>::constant(1.0));
        let damping = Lanes::<R>::from_fn(|place| lanes[place].as_ref().map_or(1.0, |lane| lane.damping));
        self.active.fill(one);
        for _ in 0..=self.q.len() {
            self.here.damped_step(damping, &self.active, &mut self.step);
            let mut held = zero;
            for j in 0..self.q.len() {
                let ([lower, upper], q, step) = (self.limits[j], self.q[j], self.step[j]);
                // Nonzero only at that limit, for an outward step.
                let below = q.more_than(lower).select(zero, (-step).max(zero));
                let above = upper.more_than(q).select(zero, step.max(zero));
                let outwards = (below + above).more_than(zero);
                self.active[j] = outwards.select(zero, self.active[j]);
                held = outwards.select(one, held);
            }
            if !held.more_than(zero).any() {
                break;
            }
        }
        // Limits rotations to 1 rad per step, the reach of the linear model.
        let (mut largest, mut any) = (one, zero);
        for (joint, step) in chain.joints.iter().zip(&self.step) {
            let size = step.abs();
            any = any.max(size);
            if joint.turns {
                largest = largest.max(size);
            }
        }
        let share = one / largest;
        let fresh = Lanes::<R>::from_fn(|place| match &lanes[place] {
            Some(lane) if lane.fresh => 1.0,
            _ => 0.0,
        });
        let fresh = fresh.more_than(zero);
        for j in 0..self.q.len() {
            let [lower, upper] = self.limits[j];
            let moved = self.step[j].mul_add(share, self.q[j]).min(upper).max(lower);
            self.candidate[j] = fresh.select(self.candidate[j], moved);
        }
        for (lane, size) in lanes.iter_mut().zip(any.as_slice()) {
            if let Some(lane) = lane.as_mut().filter(|lane| !lane.fresh) {
                lane.stuck = *size == 0.0;
            }
        }
    }

    fn ended(&self, problem: &Problem<'_>, place: usize, bounded: bool) -> DescentEnd {
        let mut q = problem.starts[0].clone();
        for (j, &i) in problem.free.iter().enumerate() {
            let value = self.q[j].as_slice()[place] * problem.unit(j);
            let [lower, upper] = problem.variable(j).limits;
            q[i] = if bounded { value.min(upper).max(lower) } else { value };
        }
        let rows: [f64; ROWS] = core::array::from_fn(|row| self.here.rows[row].as_slice()[place]);
        let (position, turn) = rows.split_at(3);
        let norm = |rows: &[f64]| rows.iter().fold(0.0, |norm: f64, row| norm.hypot(*row));
        let norm_of_all = self.here.norm.as_slice()[place];
        let position = norm(position);
        // The rows of a rotation by θ have the norm 2 sin θ/2. Beyond a right angle the total norm
        // is more accurate.
        let chord =
            if turn.is_empty() { 0.0 } else { (norm_of_all.powi(2) - position.powi(2)).max(0.0).sqrt() };
        let chord = if chord < 1.0 { norm(turn) } else { chord };
        DescentEnd { q, norm: norm_of_all, position, turn: 2.0 * (chord / 2.0).min(1.0).asin() }
    }
}

/// Sets the value of one lane.
fn put<R: Register>(lanes: &mut Lanes<R>, place: usize, value: f64) {
    bytemuck::cast_slice_mut::<Lanes<R>, f64>(core::slice::from_mut(lanes))[place] = value;
}
