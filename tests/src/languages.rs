//! Reference of the generated languages: common arguments, and names with a meaning in one of them.

use std::f64::consts::FRAC_PI_2;

use abbe::analysis::sampling::{arm_length, halton, joint_sample, nominal_parameters};
use abbe::compensator::{Begun, CHANGE, Compensated, Cycle, LARGEST, Status, begin, bound, compensate};
use abbe::function::{Array, BEGIN, COMMANDS, COMPENSATED, Signature};
use abbe::{Description, Error, Function, Input, Manipulator, Pose, Quantity, VariableKind};

/// Spec with keywords of languages, and names that their functions use.
pub const NAMES: &str = r#"
[manipulator]
name = "arguments"
title = "Comments end here: */ or `not`, and begin /* here"
length = "m"
[parameters]
function = "0.3 m"
Math = 2
pose = 0.1
class = "0.2 m"
double = "0.05 m"
sine = "0.01 m"
arguments_pose = "0.02 m"
arguments_array_6 = 0
ARGUMENTS_OK = 0
inputs_are_in_range = 0
[inputs]
NaN = { value = "2 N", range = ["0 N", "3 N"] }
[[frame]]
name = "\"quoted\" \\ and '${more}'"
variable = { name = "new", kind = "revolute", limits = [-1, 1] }
transform = "Rz(new - pose) Tx(function)"
[[frame]]
name = "second"
variable = { name = "undefined", kind = "revolute", limits = [-1, 1] }
transform = "Rx(undefined*Math) Ty(class) Rz(0.4)"
[tool]
transform = "Tx(-function^1.5/abs(class)^0.5) Ty(double + sin(0.3)*sine + arguments_pose*(1 + ARGUMENTS_OK + inputs_are_in_range + arguments_array_6))"
[[source]]
name = "repeatable"
class = "repeatable"
frame = "second"
e_x = "1e-4 m/N*NaN*cos(new)"
e_r = "-1e-3*atan2(function, class)*sqrt(Math)"
"#;

/// Returns configurations: q, s, u, errors, variances and magnitudes, the cycle of corrected
/// commands, of which every other one is bounded, and a pose to be reached.
pub fn configurations(robot: &dyn Manipulator, count: usize) -> Vec<Vec<f64>> {
    let description = robot.description();
    let s = nominal_parameters(description);
    let arm = arm_length(robot, &s).unwrap();
    let moved: Vec<usize> = (0..description.variables.len()).collect();
    let errors = 6 * description.frames.len();
    let configuration = |index: usize| {
        let small = (0..2 * errors).map(|k| 1e-3 * halton(index + 1, k % 30));
        let magnitudes = (0..description.sources.len()).map(|k| 2.0 * halton(index + 1, k % 30) - 1.0);
        let mut q = joint_sample(description, arm, &moved, index);
        if index == 2 {
            quarter_turns(description, &mut q);
        }
        q.into_iter()
            .chain(s.clone())
            .chain(inputs(description, index))
            .chain(small)
            .chain(magnitudes)
            .chain(cycle(description, index))
            .chain(target(robot, &s, &joint_sample(description, arm, &moved, 3 * index + 1)))
            .collect()
    };
    (0..count).map(configuration).collect()
}

/// Returns the pose of other joint variables.
fn target(robot: &dyn Manipulator, s: &[f64], q: &[f64]) -> Vec<f64> {
    robot.pose(q, s).map_or_else(|_| Pose::IDENTITY.0.concat(), |pose| pose.0.concat())
}

/// Returns a configuration of the machine `linkage` at which its rod does not reach the plate.
pub fn open_linkage(linkage: &dyn Manipulator) -> Vec<f64> {
    let mut given = configurations(linkage, 1).remove(0);
    given[..3].copy_from_slice(&[0.0, 1.0, 500.0]);
    given
}

/// Sets joints to a quarter turn, where the cosine has only digits of the last part of π/2.
fn quarter_turns(description: &Description, q: &mut [f64]) {
    for (value, variable) in q.iter_mut().zip(&*description.variables) {
        let [lower, upper] = variable.limits;
        if variable.kind == VariableKind::Revolute && (lower..=upper).contains(&FRAC_PI_2) {
            *value = FRAC_PI_2;
        }
    }
}

/// Returns inputs within their ranges, or their nominal values if they have no range.
fn inputs(description: &Description, index: usize) -> Vec<f64> {
    let one = |(k, input): (usize, &Input)| match input.range {
        [lower, upper] if (upper - lower).is_finite() => lower + (upper - lower) * halton(index + 1, k),
        _ => input.nominal,
    };
    description.inputs.iter().enumerate().map(one).collect()
}

/// Returns `last`, `change`, `largest` and `rotations` of a configuration.
fn cycle(description: &Description, index: usize) -> Vec<f64> {
    let count = description.variables.len();
    if index.is_multiple_of(2) {
        return [vec![0.0; count], vec![f64::INFINITY; 2 * count], vec![1.0; 3]].concat();
    }
    let each = |bounds| description.variables.iter().map(move |one| bound(description, one.kind, bounds));
    // A long chain would be held in most of its joints, and the others amplify rounding errors.
    let is_long = count > 7;
    let share = |j| if is_long { 0.0 } else { halton(index, j) - 0.5 };
    let last = each(CHANGE).enumerate().map(|(j, most)| most * share(j));
    let rotations = if index % 4 == 1 { [1.0; 3] } else { [1.0, 1.0, 0.0] };
    // Every fourth time, the size of a correction holds it.
    let is_held = index % 8 == 3 && !is_long;
    let largest = each(if is_held { CHANGE } else { LARGEST });
    let largest = largest.map(|most| if is_held { 0.3 * most } else { most });
    last.chain(each(CHANGE)).chain(largest).chain(rotations).collect()
}

/// Returns the arrays that functions take, in the order of their numbers in a configuration.
pub fn given_arrays() -> Vec<&'static Array> {
    let mut arrays: Vec<&Array> = Vec::new();
    let functions = Function::ALL.map(Function::signature).into_iter().chain(COMMANDS);
    let functions = functions.chain(Function::OF_INVERSE.map(Function::signature));
    for array in functions.flat_map(|signature| signature.arguments) {
        if !arrays.contains(&array) {
            arrays.push(array);
        }
    }
    arrays
}

/// Returns the arguments of a function from a configuration.
pub fn arguments(robot: &dyn Manipulator, signature: &Signature, given: &[f64]) -> Vec<f64> {
    let mut rest = given;
    let mut taken = Vec::new();
    for array in given_arrays() {
        let (numbers, others) = rest.split_at(array.len(robot.description()));
        rest = others;
        if signature.arguments.contains(array) {
            taken.extend(numbers);
        }
    }
    taken
}

/// Compares the results of functions in another language with those in Rust, to a share of the
/// largest number of a result, and compensated commands to 1e-9. `found` has the results of every
/// function for the first configuration, then for the next. Returns the largest difference, without
/// compensated commands.
///
/// # Errors
///
/// Returns the first difference that is too large.
pub fn compare(
    robot: &dyn Manipulator,
    evaluate: impl Fn(Function, &[f64]) -> Vec<f64>,
    given: &[Vec<f64>],
    found: &[f64],
    share: f64,
) -> Result<f64, String> {
    let mut found = found;
    let mut worst: f64 = 0.0;
    for given in given {
        for function in Function::all(robot.description()) {
            let expected = evaluate(function, &arguments(robot, function.signature(), given));
            let results = found.split_off(..expected.len()).ok_or("numbers are missing")?;
            let mut first = 0;
            let arrays = function.signature().results.iter().map(|array| array.len(robot.description()));
            for len in arrays.chain([1]) {
                let range = first..(first + len).min(expected.len());
                let (results, expected) = (&results[range.clone()], &expected[range]);
                let largest = expected.iter().fold(0.0, |largest: f64, value| largest.max(value.abs()));
                for (a, b) in results.iter().zip(expected) {
                    let difference = (a - b).abs();
                    let is_close = difference <= share * largest;
                    is_close.then_some(()).ok_or_else(|| format!("{}: {a} and {b}", function.name()))?;
                    worst = worst.max(if difference > 0.0 { difference / largest } else { 0.0 });
                }
                first += len;
            }
        }
        for command in COMMANDS {
            let count = command.results_len(robot.description());
            let numbers = found.split_off(..count + 1).ok_or("numbers are missing")?;
            compare_command(robot, &evaluate, command, given, &numbers[..count], numbers[count])?;
        }
    }
    if found.is_empty() { Ok(worst) } else { Err(format!("{} numbers more", found.len())) }
}

/// Compares the results of corrected commands, or of where one begins, and their status, with those
/// in Rust, to 1e-9 of a metre or a rad where the pose is reached, else to 1e-6.
///
/// # Errors
///
/// Returns the first difference that is too large.
pub fn compare_command(
    robot: &dyn Manipulator,
    evaluate: impl Fn(Function, &[f64]) -> Vec<f64>,
    signature: &Signature,
    given: &[f64],
    found: &[f64],
    status: f64,
) -> Result<(), String> {
    let description = robot.description();
    let name = &description.name;
    let evaluate = |function, given: &[f64]| Ok(evaluate(function, given));
    let (expected, own) = if signature.name == COMPENSATED.name {
        let done = compensated(robot, evaluate, given).unwrap();
        ([&done.q[..], &done.correction, &done.before, &done.after].concat(), done.status)
    } else {
        let begun = begun(robot, evaluate, given).unwrap();
        ([&begun.command[..], &begun.last, &begun.after].concat(), begun.status)
    };
    if status != f64::from(own.code()) {
        return Err(format!("{name} {}: status {status} and {own:?}", signature.name));
    }
    // Where the pose is not reached, a singular pose amplifies rounding errors.
    let tolerance = if own == Status::Reached { 1e-9 } else { 1e-6 };
    let metre = 1.0 / description.length.in_metres();
    let variables = description.variables.iter().map(|variable| variable.kind.either(1.0, metre));
    // One metre or one rad of each number.
    let units = signature.results.iter().flat_map(|array| match array.quantity {
        Quantity::Displacement => vec![metre, metre, metre, 1.0, 1.0, 1.0],
        _ => variables.clone().collect(),
    });
    for ((found, expected), unit) in found.iter().zip(expected).zip(units) {
        let is_close = (found - expected).abs() <= tolerance * unit;
        let differ = || format!("{name} {} {status}: {found} and {expected}", signature.name);
        is_close.then_some(()).ok_or_else(differ)?;
    }
    Ok(())
}

/// Computes the command that drives carry out where they stand, by the functions that `evaluate`
/// gives.
///
/// # Errors
///
/// Returns those of `evaluate`.
pub fn begun(
    robot: &dyn Manipulator,
    evaluate: impl Fn(Function, &[f64]) -> Result<Vec<f64>, Error>,
    given: &[f64],
) -> Result<Begun<Vec<f64>>, Error> {
    let description = robot.description();
    let count = description.variables.len();
    let given = arguments(robot, &BEGIN, given);
    let (given, rotations) = given.split_at(given.len() - 3);
    let (q, rest) = given.split_at(count);
    let parameters = description.parameters.len();
    let target = pose(&evaluate(Function::RealPose, given)?);
    let rotations = std::array::from_fn(|k| rotations[k]);
    begin(description, &target, &q.to_vec(), rotations, vec![[0.0; 6]; count], |q, columns| {
        let step = evaluate(Function::CompensatorStep, &[&q[..], rest].concat())?;
        columns.as_flattened_mut().copy_from_slice(&step[12..]);
        Ok(pose(&evaluate(Function::Pose, &[&q[..], &rest[..parameters]].concat())?))
    })
}

fn pose(numbers: &[f64]) -> Pose {
    Pose(std::array::from_fn(|i| std::array::from_fn(|j| numbers[3 * i + j])))
}

/// Computes the compensated commands of a configuration by the functions that `evaluate` gives.
///
/// # Errors
///
/// Returns those of `evaluate`.
pub fn compensated(
    robot: &dyn Manipulator,
    evaluate: impl Fn(Function, &[f64]) -> Result<Vec<f64>, Error>,
    given: &[f64],
) -> Result<Compensated<Vec<f64>>, Error> {
    let description = robot.description();
    let count = description.variables.len();
    let given = arguments(robot, &COMPENSATED, given);
    let (given, cycle) = given.split_at(given.len() - 3 * count - 3);
    let (q, rest) = given.split_at(count);
    let (last, cycle) = cycle.split_at(count);
    let (change, cycle) = cycle.split_at(count);
    let (largest, rotations) = cycle.split_at(count);
    let cycle = Cycle { last, change, largest, rotations: std::array::from_fn(|k| rotations[k]) };
    let configuration = &given[..count + description.parameters.len()];
    let target = pose(&evaluate(Function::Pose, configuration)?);
    compensate(description, &target, &q.to_vec(), &cycle, vec![[0.0; 6]; count], |q, columns| {
        let step = evaluate(Function::CompensatorStep, &[&q[..], rest].concat())?;
        let (real, twists) = step.split_at(12);
        columns.as_flattened_mut().copy_from_slice(twists);
        Ok(pose(real))
    })
}
