//! Results of corrected commands, as the generator computes them, for the self-test.

use abbe_core::compensator::{CHANGE, Cycle, LARGEST, Status, begin, bound, compensate, norms};
use abbe_core::function::{COMPENSATED, Signature};
use abbe_core::{Description, Error, Function, Pose};

use super::expected::{Computed, Given};
use super::real::Real;
use crate::chain::Model;

/// Shares of the bounds by default that the correction before, the bound of the change and that of
/// the correction have, the weight of the third rotation, and how far the first joint with a limit
/// is beyond it, in spans of its range.
const CASES: [[f64; 5]; 5] = [
    // Nothing holds the correction.
    [0.0, 1e3, 1e3, 1.0, 0.0],
    // The change of the first cycle does.
    [0.0, 0.25, 1.0, 1.0, 0.0],
    [0.0, 1.0, 1.0, 1.0, 1e-3],
    // One rotation is free.
    [0.0, 1e3, 1e3, 0.0, 0.0],
    // The change holds it at one end and its size at the other. In single precision the joints that
    // are held depend on rounding errors.
    [-1.0, 0.5, 0.03, 1.0, 0.0],
];

/// A call with the sums of its results, each weighted 1 to 7 cyclically, and with their tolerances.
pub(super) struct Call {
    /// Shares as in [`CASES`], with the first joint that has a limit in its own unit.
    pub(super) shares: [f64; 5],
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

    /// Returns the calls whose results rounding errors do not change by more than the tolerance.
    pub(super) fn calls(&self, signature: &Signature) -> Vec<Call> {
        let count = if signature.name == COMPENSATED.name { [5, 4][self.real as usize] } else { 1 };
        CASES[..count].iter().filter_map(|shares| self.call(signature, *shares)).collect()
    }

    fn call(&self, signature: &Signature, mut shares: [f64; 5]) -> Option<Call> {
        let mut command = self.given[0].1.clone();
        if shares[4] > 0.0 {
            let (at, [lower, upper]) = self.limited()?;
            shares[4] = self.real.nearest(upper - command[at] + shares[4] * (upper - lower));
            command[at] += shares[4];
        }
        // Numbers of a ten-thousandth of the largest correction: rounding errors and the tolerances
        // of single precision are smaller, what a wrong step leaves is larger.
        // Beyond a limit the iterations do not end: only the status counts, and the size.
        let share = [1e-7, 1e-3, 1.0][if shares[4] > 0.0 { 2 } else { self.real as usize }];
        let [least, most] = [-1.0, 1.0].map(|sign| self.results(signature, &command, shares, sign));
        let ((numbers, status), (others, other)) = (least?, most?);
        let mut sums = Vec::new();
        for (array, (numbers, others)) in signature.results.iter().zip(numbers.iter().zip(&others)) {
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
            let [sum, other] = [sum(&|k| numbers[k]), sum(&|k| others[k])];
            sums.push([sum, tolerance]);
            if (sum - other).abs() > tolerance / 4.0 {
                return None;
            }
        }
        (status == other).then_some(Call { shares, sums, status })
    }

    /// Returns the first joint with a limit.
    pub(super) fn limited(&self) -> Option<(usize, [f64; 2])> {
        let limits = self.description.variables.iter().map(|variable| variable.limits).enumerate();
        limits.into_iter().find(|(_, [lower, upper])| (upper - lower).is_finite())
    }

    /// Returns the results and the status, with the largest rounding errors, of a sign, in the
    /// functions of nodes; none if they are not finite, or if a status may be another one in single
    /// precision.
    fn results(
        &self,
        signature: &Signature,
        q: &Vec<f64>,
        shares: [f64; 5],
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
        let [last, change, largest] = [(shares[0], CHANGE), (shares[1], CHANGE), (shares[2], LARGEST)].map(
            |(share, bounds)| -> Vec<f64> {
                let variables = self.description.variables.iter();
                variables.map(|one| share * bound(self.description, one.kind, bounds)).collect()
            },
        );
        let rotations = [1.0, 1.0, shares[3]];
        let (results, status, after) = if signature.name == COMPENSATED.name {
            let target = pose(&evaluate(0, q).ok()?);
            let cycle = Cycle { last, change, largest, rotations };
            let done = compensate(self.description, &target, q, &cycle, columns(), |q, columns| {
                let step = evaluate(1, q)?;
                columns.as_flattened_mut().copy_from_slice(&step[12..]);
                Ok(pose(&step))
            });
            let done = done.ok()?;
            let results = vec![done.q, done.correction, done.before.to_vec(), done.after.to_vec()];
            (results, done.status, done.after)
        } else {
            let target = pose(&evaluate(2, q).ok()?);
            let begun = begin(self.description, &target, q, rotations, columns(), |q, columns| {
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
