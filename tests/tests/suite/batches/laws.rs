//! Every function in batches equals single evaluations, the interpreter, and any other division of
//! the batch.

use abbe::analysis::sampling::{halton, joint_sample, nominal_inputs, nominal_parameters};
use abbe::lanes::{Batches, InstructionSet, Tiles};
use abbe::{Function, Manipulator, Quantity, laws};
use abbe_interpreter::Interpreter;
use abbe_manipulators::SHIPPED;
use abbe_spec::Spec;

use super::COMPILED;

/// Returns the arguments of a function at spread configurations.
fn arguments(robot: &dyn Batches, function: Function, set: InstructionSet, count: usize) -> Tiles {
    let description = robot.description();
    let (s, u) = (nominal_parameters(description), nominal_inputs(description));
    let moved: Vec<usize> = (0..description.variables.len()).collect();
    let signature = function.signature();
    let mut arguments = Tiles::new(set, signature.arguments_len(description), count);
    for i in 0..count {
        let given = signature.arguments.iter().flat_map(|array| match array.quantity {
            Quantity::Variables => joint_sample(description, 1.0, &moved, i),
            Quantity::Parameters => s.clone(),
            Quantity::Inputs => u.clone(),
            // Errors, or variances.
            _ => (0..array.len(description)).map(|k| 1e-3 * halton(i + 1, k % 30)).collect(),
        });
        given.enumerate().for_each(|(row, value)| arguments.set_value(row, i, value));
    }
    arguments.pad();
    arguments
}

fn results(robot: &dyn Batches, function: Function, arguments: &Tiles) -> Tiles {
    let rows = function.signature().results_len(robot.description());
    let mut results = Tiles::new(arguments.instruction_set(), rows, arguments.count());
    robot.batch(function, arguments, &mut results).unwrap();
    results
}

#[test]
fn batches_are_the_single_evaluations() {
    for robot in COMPILED {
        let discrepancy = laws::batches(robot, laws::SAMPLES)
            .and_then(|discrepancy| discrepancy.within("batches", laws::ROUNDING_TOLERANCE));
        discrepancy.unwrap_or_else(|failure| panic!("{}: {failure}", robot.description().name));
    }
}

/// Checks equality to the last bit where the compiler keeps the order of operations, otherwise to a
/// few units in the last place.
#[test]
fn batches_are_those_of_the_interpreter_on_every_instruction_set() {
    // More than two blocks of lanes, and a remainder.
    let count = 150;
    for compiled in COMPILED {
        let name = &*compiled.description().name;
        let shipped = SHIPPED.iter().find(|shipped| shipped.name == name).expect("a shipped robot");
        let robot = Interpreter::new(Spec::parse(shipped.name, shipped.spec).unwrap());
        assert_eq!(robot.description(), compiled.description(), "{}", shipped.name);
        for set in InstructionSet::all() {
            for function in Function::ALL {
                let arguments = arguments(&robot, function, set, count);
                let compiled = results(compiled, function, &arguments);
                let interpreted = results(&robot, function, &arguments);
                for i in 0..count {
                    for row in 0..compiled.rows() {
                        let (a, b) = (compiled.get(row, i), interpreted.get(row, i));
                        assert!(a == b, "{} {function:?} {set:?}: {a} and {b}", shipped.name);
                    }
                }
            }
        }
    }
}

/// Checks that the results of a configuration do not depend on the others of the batch.
#[test]
fn any_split_of_a_batch_gives_the_same_to_the_last_bit() {
    for robot in COMPILED {
        for set in InstructionSet::all() {
            for function in Function::ALL {
                let whole = results(robot, function, &arguments(robot, function, set, 37));
                for count in [1, 2, 7, 19] {
                    let part = results(robot, function, &arguments(robot, function, set, count));
                    for i in 0..count {
                        for row in 0..part.rows() {
                            let (a, b) = (whole.get(row, i), part.get(row, i));
                            let name = &robot.description().name;
                            assert_eq!(a.to_bits(), b.to_bits(), "{name} {function:?} {set:?}");
                        }
                    }
                }
            }
        }
    }
}
