//! Long chains are generated as loops over their frames, which equal the straight-line programs,
//! for single configurations and in batches, and obey the laws.

use abbe::lanes::{Batches, InstructionSet, Tiles};
use abbe::{Function, Manipulator, Pose};
use abbe_interpreter::Interpreter;
use abbe_spec::Spec;
use abbe_tests::chains::long_chain;
use abbe_tests::golden::long::{FRAMES, Long, PARAMETERS, VARIABLES};

/// Number of configurations: more than one register holds, and no multiple of that.
const COUNT: usize = 21;

/// Returns deterministic numbers from −1 to 1.
fn number(index: usize) -> f64 {
    (index as f64 * 0.618 + 0.1).sin()
}

fn spec() -> Spec {
    Spec::parse("long.toml", &long_chain()).unwrap()
}

/// Checks equality to 1e-12 of the largest number.
fn assert_close(what: &str, actual: &[f64], expected: &[f64]) {
    assert_eq!(actual.len(), expected.len());
    let largest = expected.iter().fold(0.0, |largest: f64, value| largest.max(value.abs()));
    for (i, (a, b)) in actual.iter().zip(expected).enumerate() {
        assert!((a - b).abs() <= 1e-12 * largest, "{what}: {a} instead of {b} at {i}");
    }
}

#[test]
fn batches_are_those_of_the_straight_line_program() {
    let spec = spec();
    let straight = Interpreter::without_loops(spec.clone());
    let description = straight.description();
    assert_eq!(description, Long.description());
    for set in InstructionSet::all() {
        for function in Function::ALL {
            let signature = function.signature();
            let mut arguments = Tiles::new(set, signature.arguments_len(description), COUNT);
            for configuration in 0..COUNT {
                for row in 0..arguments.rows() {
                    // Parameters, inputs and variances are positive.
                    let value = number(row + 31 * configuration);
                    let value = if row < VARIABLES { value } else { 0.1 + value * value };
                    arguments.set_value(row, configuration, value);
                }
            }
            let mut results = [(); 2].map(|()| Tiles::new(set, signature.results_len(description), COUNT));
            let [looped, straight_line] = &mut results;
            Long.batch(function, &arguments, looped).unwrap();
            straight.batch(function, &arguments, straight_line).unwrap();
            for configuration in 0..COUNT {
                let [looped, expected] = results.each_ref().map(|results| {
                    let mut values = vec![0.0; results.rows()];
                    results.copy_rows(0..results.rows(), configuration, &mut values);
                    values
                });
                let what = format!("{set:?}, {}", function.name());
                assert!(expected.iter().any(|value| *value != 0.0), "{what}: nothing to compare");
                assert_close(&what, &looped, &expected);
            }
        }
    }
}

#[test]
fn single_configurations_are_those_of_the_straight_line_program() {
    let spec = spec();
    let straight = Interpreter::without_loops(spec.clone());
    for sample in 0..COUNT {
        let q: Vec<f64> = (0..VARIABLES).map(|i| number(i + 57 * sample)).collect();
        let s: Vec<f64> = (0..PARAMETERS).map(|i| 0.4 + 0.1 * number(i + sample)).collect();
        let [mut looped, mut expected] = [(); 2].map(|()| vec![Pose::IDENTITY; FRAMES + 1]);
        Long.transforms(&q, &s, &mut looped).unwrap();
        straight.transforms(&q, &s, &mut expected).unwrap();
        let flat = |poses: &[Pose]| poses.iter().flat_map(|pose| pose.0.concat()).collect::<Vec<f64>>();
        assert_close("transforms", &flat(&looped), &flat(&expected));
        let [mut looped, mut expected] = [(); 2].map(|()| vec![[0.0; 6]; VARIABLES]);
        Long.joint_jacobian(&q, &s, &mut looped).unwrap();
        straight.joint_jacobian(&q, &s, &mut expected).unwrap();
        assert_close("joint Jacobian", looped.as_flattened(), expected.as_flattened());
        let [mut looped, mut expected] = [(); 2].map(|()| vec![[0.0; 6]; PARAMETERS]);
        Long.parameter_jacobian(&q, &s, &mut looped).unwrap();
        straight.parameter_jacobian(&q, &s, &mut expected).unwrap();
        assert_close("parameter Jacobian", looped.as_flattened(), expected.as_flattened());
    }
}

/// Compares the interpreter's loops with the straight-line program.
#[test]
fn interpreted_loops_are_those_of_the_straight_line_program() {
    let (looped, straight) = (Interpreter::new(spec()), Interpreter::without_loops(spec()));
    for function in Function::ALL {
        let count = function.signature().arguments_len(straight.description());
        for sample in 0..COUNT {
            let arguments: Vec<f64> = (0..count).map(|i| number(i + 31 * sample)).collect();
            let [found, expected] =
                [&looped, &straight].map(|robot| robot.evaluate_unchecked(function, &arguments).unwrap());
            assert!(expected.iter().any(|value| *value != 0.0), "{}: nothing to compare", function.name());
            assert_close(function.name(), &found, &expected);
        }
    }
}

#[test]
fn loops_obey_the_laws() {
    abbe::laws::all(&Long, 60).unwrap_or_else(|failure| panic!("{failure}"));
}
