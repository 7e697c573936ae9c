//! The interpreter and the compiled code return the same numbers.

use std::sync::Arc;

use abbe::analysis::sampling::{arm_length, joint_sample, nominal_inputs, nominal_parameters};
use abbe::function::Array;
use abbe::{Error, Function, Manipulator, Pose};
use abbe_interpreter::Interpreter;
use abbe_manipulators::SHIPPED;
use abbe_spec::Spec;
use abbe_tests::languages::{arguments, configurations};
use abbe_tests::specs;

/// Returns all results of a manipulator at one configuration, row by row.
fn everything(robot: &dyn Manipulator, q: &[f64], s: &[f64], u: &[f64]) -> Result<Vec<Vec<f64>>, Error> {
    let description = robot.description();
    let mut rows = Vec::new();
    let keep_pose = |pose: Pose, rows: &mut Vec<Vec<f64>>| {
        rows.extend(pose.rows()[..3].iter().map(|row| row.to_vec()));
    };
    let keep_columns = |columns: &[[f64; 6]], rows: &mut Vec<Vec<f64>>| {
        rows.extend((0..6).map(|row| columns.iter().map(|column| column[row]).collect()));
    };
    let mut transforms = vec![Pose::IDENTITY; description.frames.len() + 1];
    robot.transforms(q, s, &mut transforms)?;
    for transform in transforms {
        keep_pose(transform, &mut rows);
    }
    let mut columns = vec![[0.0; 6]; 6 * description.frames.len()];
    keep_pose(robot.error_jacobian(q, s, &mut columns)?, &mut rows);
    keep_columns(&columns, &mut rows);
    let mut columns = vec![[0.0; 6]; description.variables.len()];
    keep_pose(robot.joint_jacobian(q, s, &mut columns)?, &mut rows);
    keep_columns(&columns, &mut rows);
    let mut columns = vec![[0.0; 6]; description.parameters.len()];
    keep_pose(robot.parameter_jacobian(q, s, &mut columns)?, &mut rows);
    keep_columns(&columns, &mut rows);
    let mut effects = vec![0.0; description.effects.len()];
    robot.effects(q, s, u, &mut effects)?;
    rows.push(effects);
    let mut errors = vec![[0.0; 6]; description.frames.len()];
    robot.generalized_errors(q, s, u, &mut errors)?;
    keep_columns(&errors, &mut rows);
    Ok(rows)
}

/// Returns the largest difference between two rows, in units in the last place of the row's largest
/// entry.
fn ulps(a: &[f64], b: &[f64]) -> f64 {
    assert_eq!(a.len(), b.len());
    assert!(a.iter().chain(b).all(|value| value.is_finite()), "{a:?} {b:?}");
    let largest = a.iter().fold(f64::MIN_POSITIVE, |largest, value| largest.max(value.abs()));
    let ulp = largest.next_up() - largest;
    a.iter().zip(b).fold(0.0, |worst, (a, b)| f64::max(worst, (a - b).abs() / ulp))
}

#[test]
fn equal_to_compiled_code_on_a_thousand_configurations() {
    for shipped in SHIPPED {
        let spec = Spec::parse(shipped.name, shipped.spec).unwrap();
        let interpreter = Interpreter::new(spec.clone());
        let description = interpreter.description();
        assert_eq!(description, shipped.compiled.description(), "{}", shipped.name);
        let (s, u) = (nominal_parameters(description), nominal_inputs(description));
        let arm = arm_length(&interpreter, &s).unwrap();
        let moved: Vec<usize> = (0..description.variables.len()).collect();
        let (mut worst, mut refused) = (0.0_f64, 0);
        for index in 0..1000 {
            let q = joint_sample(description, arm, &moved, index);
            match (everything(shipped.compiled, &q, &s, &u), everything(&interpreter, &q, &s, &u)) {
                (Ok(compiled), Ok(interpreted)) => {
                    assert_eq!(compiled.len(), interpreted.len());
                    for (a, b) in compiled.iter().zip(&interpreted) {
                        worst = worst.max(ulps(a, b));
                    }
                }
                (compiled, interpreted) => {
                    assert_eq!(compiled.err(), interpreted.err(), "{}", shipped.name);
                    refused += 1;
                }
            }
        }
        println!("{}: {worst} ulp, {refused} of 1000 refused", shipped.name);
        assert!(worst <= 4.0 && refused < 100, "{}: {worst} ulp, {refused} refused", shipped.name);
    }
}

/// A slice that is missing, too short or too long is refused alike by compiled code and by the
/// interpreter, for each array of each function; a further one is not looked at.
#[test]
fn slices_of_other_lengths_are_refused() {
    for shipped in SHIPPED {
        let interpreter = Interpreter::new(Spec::parse(shipped.name, shipped.spec).unwrap());
        let description = interpreter.description();
        let given = configurations(&interpreter, 1).remove(0);
        for function in Function::all(description) {
            let signature = function.signature();
            let lengths =
                |arrays: &[Array]| arrays.iter().map(|array| array.len(description)).collect::<Vec<_>>();
            let numbers = arguments(&interpreter, signature, &given);
            let [takes, fills] = [lengths(signature.arguments), lengths(signature.results)];
            let evaluate = |takes: &[usize], fills: &[usize]| {
                let all = [numbers.clone(), vec![0.0; 100]].concat();
                let mut rest = all.as_slice();
                let taken = takes.iter().map(|len| {
                    let (values, others) = rest.split_at(*len);
                    rest = others;
                    values
                });
                let taken: Vec<&[f64]> = taken.collect();
                let robots = [shipped.compiled as &dyn Manipulator, &interpreter];
                let [compiled, interpreted] = robots.map(|robot| {
                    let mut filled: Vec<Vec<f64>> = fills.iter().map(|len| vec![0.0; *len]).collect();
                    let mut filled: Vec<&mut [f64]> = filled.iter_mut().map(Vec::as_mut_slice).collect();
                    robot.evaluate(function, &taken, &mut filled)
                });
                assert_eq!(compiled, interpreted, "{}: {}", shipped.name, function.name());
                compiled
            };
            assert_eq!(evaluate(&takes, &fills), Ok(()), "{}: {}", shipped.name, function.name());
            assert_eq!(evaluate(&[&takes[..], &[1]].concat(), &[&fills[..], &[1]].concat()), Ok(()));
            let refused = |takes: &[usize], fills: &[usize]| {
                let found = evaluate(takes, fills);
                assert!(matches!(found, Err(Error::Count { .. })), "{}: {found:?}", function.name());
            };
            let other = |lengths: &[usize], i: usize, by: isize| {
                let mut lengths = lengths.to_vec();
                lengths[i] = lengths[i].saturating_add_signed(by);
                lengths
            };
            for by in [-1, 1, 12] {
                (0..takes.len())
                    .filter(|i| by > 0 || takes[*i] > 0)
                    .for_each(|i| refused(&other(&takes, i, by), &fills));
                (0..fills.len())
                    .filter(|i| by > 0 || fills[*i] > 0)
                    .for_each(|i| refused(&takes, &other(&fills, i, by)));
            }
            if takes.last().is_some_and(|len| *len > 0) {
                refused(&takes[..takes.len() - 1], &fills);
            }
            if fills.last().is_some_and(|len| *len > 0) {
                refused(&takes, &fills[..fills.len() - 1]);
            }
        }
    }
}

/// New values of parameters and inputs without compiling equal an interpreter that was compiled
/// with them, bit by bit.
#[test]
fn new_values_equal_a_new_interpreter() {
    let shipped =
        ["pps", "machine3"].map(|name| SHIPPED.iter().find(|shipped| shipped.name == name).unwrap());
    let specs = shipped.map(|shipped| Spec::parse(shipped.name, shipped.spec).unwrap());
    for spec in specs.into_iter().chain([Spec::read(specs::path("linkage")).unwrap()]) {
        let first = Interpreter::new(spec.clone());
        let mut changed = spec;
        changed.parameters.iter_mut().for_each(|parameter| parameter.value *= 1.01);
        changed.inputs.iter_mut().for_each(|input| input.value = 0.9 * input.value + 0.1 * input.range[0]);
        let changed = Arc::new(changed);
        let (found, expected) = (first.with_values(changed.clone()), Interpreter::new(changed));
        assert_eq!(found.description(), expected.description());
        assert_ne!(found.description(), first.description());
        for given in configurations(&expected, 5) {
            for function in Function::all(expected.description()) {
                let arguments = arguments(&expected, function.signature(), &given);
                let [found, expected] =
                    [&found, &expected].map(|robot| robot.evaluate_unchecked(function, &arguments));
                assert_eq!(found, expected, "{}", function.name());
            }
        }
    }
}

/// Derivatives by the parameters are those of central differences.
#[test]
fn parameters_have_derivatives() {
    let mut compared = 0;
    for shipped in SHIPPED {
        let robot = Interpreter::new(Spec::parse(shipped.name, shipped.spec).unwrap());
        let description = robot.description();
        let (count, arm) =
            (description.parameters.len(), arm_length(&robot, &nominal_parameters(description)).unwrap());
        for given in configurations(&robot, 3) {
            let (q, rest) = given.split_at(description.variables.len());
            let (s, rest) = rest.split_at(count);
            let u = &rest[..description.inputs.len()];
            for function in [
                Function::ErrorJacobian,
                Function::PredictedDisplacement,
                Function::SourceDisplacements,
                Function::RealPose,
            ] {
                let at = |s: &[f64]| -> Option<Vec<f64>> {
                    let arguments = [q, s, u];
                    robot.run(function, &arguments[..function.signature().arguments.len()]).ok()
                };
                let Some(values) = at(s) else { continue };
                let arguments = [q, s, u];
                let arguments = &arguments[..function.signature().arguments.len()];
                let Some(found) = robot.parameter_derivatives(function, arguments).unwrap() else {
                    assert!(description.has_loops() && function == Function::RealPose, "{}", shipped.name);
                    continue;
                };
                let has_margin = function.signature().has_margin(description.orientation);
                let results = values.len() - usize::from(has_margin);
                assert_eq!(found.len(), count * results);
                for parameter in 0..count {
                    let unit = if s[parameter] == 0.0 { arm } else { s[parameter].abs() };
                    let step = 1e-4 * unit;
                    let ends = [-step, step].map(|step| {
                        let mut s = s.to_vec();
                        s[parameter] += step;
                        at(&s)
                    });
                    let [Some(before), Some(after)] = ends else { continue };
                    let largest = values.iter().fold(0.0, |a: f64, b| a.max(b.abs())) / unit;
                    for (i, found) in found[parameter * results..][..results].iter().enumerate() {
                        let expected = (after[i] - before[i]) / (2.0 * step);
                        let difference = (found - expected).abs();
                        let name = &description.parameters[parameter].name;
                        assert!(
                            difference <= 1e-6 * largest.max(expected.abs()),
                            "{} {} by {name}, {i}: {found} and {expected}",
                            shipped.name,
                            function.name()
                        );
                        compared += usize::from(*found != 0.0);
                    }
                }
            }
        }
    }
    println!("{compared} derivatives that are not 0");
    assert!(compared > 1000, "{compared}");
}
