//! Results of corrected commands, as the generator computes them, for the self-test.

use abbe_core::compensator::{CHANGE, Cycle, LARGEST, Status, begin, bound, compensate, norms};
use abbe_core::function::{COMPENSATED, Signature};
use abbe_core::{Description, Error, Function, Pose, Variable};

use super::expected::{Computed, Given};
use super::real::Real;
use crate::chain::Model;

/// Number of calls at the configuration of the self-test, which differ in their bounds only.
const AT_ONE: usize = 8;

/// Number of calls whose corrections nothing holds.
const FREE: usize = 2;

/// The call in single precision that the change holds, with all rotations.
const HELD: usize = 4;

/// Largest number of joints that are tried beyond each of their limits.
const JOINTS: usize = 8;

/// Shares of the change by default, then of the largest correction; the first holds nothing. Single
/// precision is damped more, so that its results are others where joints are held or the steps do
/// not end: only one call holds a correction there, and none is anywhere.
const SCALES: [[f64; 8]; 2] =
    [[1e3, 0.25, 1.0, 0.5, 1e3, 0.1, 0.02, 1.0], [1e3, 1e3, 0.03, 1.0, 0.1, 1e3, 0.3, 0.01]];

/// Multiple of the largest rounding errors that changes no result by more than its tolerance.
const MARGIN: f64 = 8.0;

/// Share of the range by which a command is beyond a limit.
const BEYOND: f64 = 1e-3;

/// A call with the sums of its results, each weighted 1 to 7 cyclically, and with their tolerances.
pub(super) struct Call {
    /// Number of its arguments, see [`Commands::arguments`].
    pub(super) number: usize,
    pub(super) sums: Vec<[f64; 2]>,
    pub(super) status: Status,
}

/// Computes corrected commands and where they begin at the given arguments.
pub(super) struct Commands<'m> {
    pub(super) description: &'m Description,
    pub(super) given: &'m Given,
    /// `pose`, `compensator_step` and `real_pose`.
    functions: [Computed<'m>; 3],
    pub(super) real: Real,
}

impl<'m> Commands<'m> {
    pub(super) fn new(description: &'m Description, model: &'m Model, given: &'m Given, real: Real) -> Self {
        let functions = [Function::Pose, Function::CompensatorStep, Function::RealPose];
        Self { description, given, functions: functions.map(|one| Computed::new(one, model)), real }
    }

    /// Returns the ends of the numbers of calls: at one configuration, one anywhere for each joint,
    /// with each joint below its lower and with each above its upper limit.
    pub(super) fn ends(&self) -> [usize; 4] {
        let joints = self.description.variables.len().min(JOINTS);
        [AT_ONE, AT_ONE + joints, AT_ONE + 2 * joints, AT_ONE + 3 * joints]
    }

    /// Returns [`SCALES`] in the precision of the code.
    pub(super) fn scales(&self) -> [[f64; 8]; 2] {
        [SCALES[0], if self.real == Real::Float { [SCALES[1][0]; 8] } else { SCALES[1] }]
    }

    /// Returns the calls whose results rounding errors do not change by more than the tolerance.
    pub(super) fn calls(&self, signature: &Signature) -> Vec<Call> {
        let [same, anywhere, _, above] = self.ends();
        // Loops may be nearly singular anywhere.
        let is_one = self.real == Real::Float || self.description.has_loops();
        let is_other = |k: usize| is_one && (same..anywhere).contains(&k);
        let end = if is_one && signature.name != COMPENSATED.name { same } else { above };
        (0..end).filter(|k| !is_other(*k)).filter_map(|number| self.call(signature, number)).collect()
    }

    /// Returns the command and the bounds of call `k`, as the self-test computes them.
    fn arguments(&self, k: usize) -> (Vec<f64>, Cycle<Vec<f64>>) {
        let [same, anywhere, below, above] = self.ends();
        let nearest = |value| self.real.nearest(value);
        let each = |of: &dyn Fn(usize, &Variable) -> f64| -> Vec<f64> {
            self.description.variables.iter().enumerate().map(|(j, one)| nearest(of(j, one))).collect()
        };
        let command = each(&|j, one| {
            let [lower, upper] = one.limits.map(nearest);
            let span = nearest(upper - lower);
            let share = match () {
                () if k < anywhere || (k - same) % (anywhere - same) != j => {
                    (1 + (7 * k + 3 * j) % 13) as f64 / 14.0
                }
                () if k < below => -BEYOND,
                () => 1.0 + BEYOND,
            };
            let is_there = k < same || above <= same || !span.is_finite();
            if is_there { self.given[0].1[j] } else { lower + nearest(nearest(share) * span) }
        });
        let bounds = |of: usize, bounds| {
            let at = |j: usize| match self.real {
                Real::Float => usize::from(k == HELD),
                Real::Double => {
                    if k < FREE {
                        0
                    } else {
                        (k + 3 * j) % 8
                    }
                }
            };
            let share = |j: usize| nearest(self.scales()[of][at(j)]);
            each(&|j, one| share(j) * nearest(bound(self.description, one.kind, bounds)))
        };
        let last = each(&|j, one| {
            let is_first = self.real == Real::Float || k.is_multiple_of(2);
            let share = if is_first { 0.0 } else { (((5 * k + 4 * j) % 9) as f64 - 4.0) * 0.25 };
            share * nearest(bound(self.description, one.kind, CHANGE))
        });
        let rotations = std::array::from_fn(|i| if (k + i) % 4 == 3 { 0.0 } else { 1.0 });
        (command, Cycle { last, change: bounds(0, CHANGE), largest: bounds(1, LARGEST), rotations })
    }

    fn call(&self, signature: &Signature, number: usize) -> Option<Call> {
        let (command, cycle) = self.arguments(number);
        let (numbers, status) = self.results(signature, &command, &cycle, 0.0)?;
        // Others may round in other ways, and loops may need another step.
        let others = [-MARGIN, MARGIN].map(|sign| self.results(signature, &command, &cycle, sign));
        let others: Vec<_> = others.into_iter().collect::<Option<_>>()?;
        // Numbers of a ten-thousandth of the largest correction: rounding errors and the tolerances
        // of single precision are smaller, what a wrong step leaves is larger.
        // Beyond a limit the iterations do not end: only the status counts, and the size.
        let share = [1e-7, 1e-3, 1.0][if status == Status::OutsideLimits { 2 } else { self.real as usize }];
        let mut sums = Vec::new();
        for (i, (array, numbers)) in signature.results.iter().zip(&numbers).enumerate() {
            let is_pose = array.len(self.description) == 6 && matches!(array.name, "before" | "after");
            let unit = |k: usize| match self.description.variables.get(k) {
                _ if is_pose => [1.0 / self.description.length.in_metres(), 1.0][usize::from(k > 2)] * 0.02,
                Some(variable) => bound(self.description, variable.kind, LARGEST),
                None => 0.0,
            };
            let sum = |term: &dyn Fn(usize) -> f64| -> f64 {
                (0..numbers.len()).map(|k| (k % 7 + 1) as f64 * term(k)).sum()
            };
            let size = sum(&|k| numbers[k].abs()) * self.real.unit_roundoff() * 16.0;
            let tolerance = share * sum(&unit) + size;
            let is_far = |(other, _): &(Vec<Vec<f64>>, Status)| {
                sum(&|k| numbers[k] - other[i][k]).abs() > tolerance / 4.0
            };
            if others.iter().any(is_far) {
                return None;
            }
            sums.push([sum(&|k| numbers[k]), tolerance]);
        }
        let is_same = others.iter().all(|(_, other)| *other == status);
        is_same.then_some(Call { number, sums, status })
    }

    /// Returns the results and the status, with the largest rounding errors, of a sign, in the
    /// functions of nodes; none if they are not finite, or if a status may be another one in single
    /// precision.
    fn results(
        &self,
        signature: &Signature,
        q: &Vec<f64>,
        cycle: &Cycle<Vec<f64>>,
        sign: f64,
    ) -> Option<(Vec<Vec<f64>>, Status)> {
        let evaluate = |function: usize, q: &Vec<f64>| -> Result<Vec<f64>, Error> {
            let mut given = self.given.clone();
            given[0].1.clone_from(q);
            let numbers = self.functions[function].numbers(&given, self.real.unit_roundoff());
            let each = numbers.iter().enumerate();
            let share = |k: usize| sign * ((k * 7 % 5) as f64 - 2.0) / 2.0;
            let values: Vec<f64> = each.map(|(k, one)| one.value + share(k) * one.bound).collect();
            let is_finite = values.iter().all(|value| value.is_finite());
            is_finite.then_some(values).ok_or(Error::NoFunction(Function::Pose))
        };
        let pose =
            |numbers: &[f64]| Pose(std::array::from_fn(|i| std::array::from_fn(|j| numbers[3 * i + j])));
        let columns = || vec![[0.0; 6]; q.len()];
        let (results, status, after) = if signature.name == COMPENSATED.name {
            let target = pose(&evaluate(0, q).ok()?);
            let done = compensate(self.description, &target, q, cycle, columns(), |q, columns| {
                let step = evaluate(1, q)?;
                columns.as_flattened_mut().copy_from_slice(&step[12..]);
                Ok(pose(&step))
            });
            let done = done.ok()?;
            let results = vec![done.q, done.correction, done.before.to_vec(), done.after.to_vec()];
            (results, done.status, done.after)
        } else {
            let target = pose(&evaluate(2, q).ok()?);
            let begun = begin(self.description, &target, q, cycle.rotations, columns(), |q, columns| {
                columns.as_flattened_mut().copy_from_slice(&evaluate(1, q)?[12..]);
                Ok(pose(&evaluate(0, q)?))
            });
            let begun = begun.ok()?;
            (vec![begun.command, begun.last, begun.after.to_vec()], begun.status, begun.after)
        };
        let status = if status == Status::NotReached { Status::NotConverged } else { status };
        let (distance, angle) = norms(&after);
        let is_far = distance * self.description.length.in_metres() > 1e-4 || angle > 1e-4;
        (is_far || matches!(status, Status::Reached | Status::OutsideLimits)).then_some((results, status))
    }
}
