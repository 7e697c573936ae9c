//! Results of corrected commands, as the generator computes them, for the self-test.

use abbe_core::compensator::{CHANGE, Cycle, ITERATIONS, LARGEST, Status, begin, bound, compensate, norms};
use abbe_core::function::{COMPENSATED, Signature};
use abbe_core::{Description, Error, Function, Pose, Variable};

use super::expected::{Computed, Given};
use super::real::Real;
use crate::chain::Model;

/// Share of the range of the joints with even and with odd numbers at which the command is, or 0
/// for the configuration of the self-test; weights of the rotations; and multiples of the bounds by
/// default that the correction before has, for even and odd joints, and that the bound of the
/// change and that of the correction have.
///
/// Where a bound keeps a pose from being reached, the iterations may not end, and rounding decides
/// which of two corrections that are about as good is taken. Rounding should not matter beyond the
/// tolerance where the iterations end or the pose is reached; tests try several compilers.
const CASES: [[f64; 9]; 32] = include!("cases.in");

/// Multiple of the bounds by default that holds no correction.
const FREE: f64 = 1e3;

/// A call with the sums of its results, each weighted 1 to 7 cyclically, and with their tolerances.
pub(super) struct Call {
    /// Columns of [`CASES`] from the third on, and the command.
    pub(super) row: Vec<f64>,
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
        let is_own = |[at, .., change, largest]: &&[f64; 9]| {
            // Single precision is damped more, and rounding decides there which joints are held.
            let is_double = *at > 0.0 && *at < 1.0 || *change < FREE && change * largest > 0.0;
            let is_tried = *largest >= FREE || *change == 0.0 || signature.name == COMPENSATED.name;
            is_tried && !(is_double && self.real == Real::Float)
        };
        CASES.iter().filter(is_own).filter_map(|case| self.call(signature, case)).collect()
    }

    fn call(&self, signature: &Signature, case: &[f64; 9]) -> Option<Call> {
        let variables = &self.description.variables;
        let at = |(j, one): (usize, &Variable)| match one.limits {
            [lower, upper] if case[j % 2] != 0.0 && (upper - lower).is_finite() => {
                self.real.nearest(lower + case[j % 2] * (upper - lower))
            }
            _ => self.given[0].1[j],
        };
        let command: Vec<f64> = variables.iter().enumerate().map(at).collect();
        // Numbers of a ten-thousandth of the largest correction: rounding errors and the tolerances
        // of single precision are smaller, what a wrong step leaves is larger.
        let share = [1e-7, 1e-3][self.real as usize];
        let results = |errors| self.results(signature, &command, case, errors);
        let (numbers, status) = results(0.0)?;
        // Others may round in other ways.
        let others = [results(-1.0)?, results(1.0)?];
        let mut sums = Vec::new();
        for (i, (array, numbers)) in signature.results.iter().zip(&numbers).enumerate() {
            let is_pose = array.len(self.description) == 6 && matches!(array.name, "before" | "after");
            let unit = |k: usize| match is_pose {
                true => [1.0 / self.description.length.in_metres(), 1.0][usize::from(k > 2)] * 0.02,
                false => bound(self.description, variables[k].kind, LARGEST),
            };
            let sum = |term: &dyn Fn(usize) -> f64| -> f64 {
                (0..numbers.len()).map(|k| (k % 7 + 1) as f64 * term(k)).sum()
            };
            let size = sum(&|k| numbers[k].abs()) * self.real.unit_roundoff() * 16.0;
            let tolerance = share * sum(&unit) + size;
            let far = |other: &[Vec<f64>]| sum(&|k| numbers[k] - other[i][k]).abs();
            if others.iter().any(|(other, kind)| *kind != status || far(other) > tolerance / 4.0) {
                return None;
            }
            sums.push([sum(&|k| numbers[k]), tolerance]);
        }
        Some(Call { row: [&case[2..], &command].concat(), sums, status })
    }

    /// Returns the results and the status, with a multiple of 8 times the largest rounding errors,
    /// or once those of single precision, in the functions of nodes; none if they are not finite,
    /// or if a status may be another one in single precision.
    fn results(
        &self,
        signature: &Signature,
        q: &Vec<f64>,
        case: &[f64; 9],
        errors: f64,
    ) -> Option<(Vec<Vec<f64>>, Status)> {
        let evaluate = |function: usize, q: &Vec<f64>| -> Result<Vec<f64>, Error> {
            let mut given = self.given.clone();
            given[0].1.clone_from(q);
            let numbers = self.functions[function].numbers(&given, self.real.unit_roundoff());
            let each = numbers.iter().enumerate();
            let share = |k: usize| errors * [4.0, 0.5][self.real as usize] * ((k * 7 % 5) as f64 - 2.0);
            let values: Vec<f64> = each.map(|(k, one)| one.value + share(k) * one.bound).collect();
            let is_finite = values.iter().all(|value| value.is_finite());
            is_finite.then_some(values).ok_or(Error::NoFunction(Function::Pose))
        };
        let pose = |of: &[f64]| Pose(std::array::from_fn(|i| std::array::from_fn(|j| of[3 * i + j])));
        let columns = vec![[0.0; 6]; q.len()];
        let each = |shares: [f64; 2], bounds| -> Vec<f64> {
            let variables = self.description.variables.iter().enumerate();
            variables.map(|(j, one)| shares[j % 2] * bound(self.description, one.kind, bounds)).collect()
        };
        let [_, _, x, y, z, even, odd, change, largest] = *case;
        let (results, status, after, steps) = if signature.name == COMPENSATED.name {
            let target = pose(&evaluate(0, q).ok()?);
            let (last, change, largest) =
                (each([even, odd], CHANGE), each([change; 2], CHANGE), each([largest; 2], LARGEST));
            let cycle = Cycle { last, change, largest, rotations: [x, y, z] };
            let mut steps = 0;
            let done = compensate(self.description, &target, q, &cycle, columns, |q, columns| {
                steps += 1;
                let step = evaluate(1, q)?;
                columns.as_flattened_mut().copy_from_slice(&step[12..]);
                Ok(pose(&step))
            });
            let done = done.ok()?;
            let results = vec![done.q, done.correction, done.before.to_vec(), done.after.to_vec()];
            (results, done.status, done.after, steps)
        } else {
            let target = pose(&evaluate(2, q).ok()?);
            let begun = begin(self.description, &target, q, [x, y, z], columns, |q, columns| {
                columns.as_flattened_mut().copy_from_slice(&evaluate(1, q)?[12..]);
                Ok(pose(&evaluate(0, q)?))
            });
            let begun = begun.ok()?;
            (vec![begun.command, begun.last, begun.after.to_vec()], begun.status, begun.after, usize::MAX)
        };
        let status = if status == Status::NotReached { Status::NotConverged } else { status };
        let (distance, angle) = norms(&after);
        let is_far = distance * self.description.length.in_metres() > 1e-4 || angle > 1e-4;
        let is_sure = is_far || matches!(status, Status::Reached | Status::OutsideLimits);
        let is_determined = steps <= ITERATIONS || status == Status::Reached || case[0] * case[7] <= 0.0;
        (is_sure && is_determined).then_some((results, status))
    }
}
