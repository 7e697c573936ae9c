//! Outputs and variables of a block persist from call to call: whatever was computed before, a call
//! gives what the first call of a new instance gives.

use abbe::function::{COMMANDS, COMPENSATED, Signature};
use abbe::{Description, Function, Manipulator};
use abbe_interpreter::Interpreter;
use abbe_manipulators::{MECHANISMS, SHIPPED};
use abbe_spec::Spec;
use abbe_tests::chains::{coupled_joints, long_chain};
use abbe_tests::languages::{arguments, configurations};
use abbe_tests::structured_text::Instance;
use abbe_tests::{is_tested, specs};

use super::{prefix, program, set};

/// Calls a block, and returns its status and, if it is valid, its results.
fn called(
    instance: &mut Instance<'_>,
    description: &Description,
    signature: &Signature,
    numbers: &[f64],
) -> (f64, Vec<f64>) {
    let mut rest = numbers;
    for array in signature.arguments {
        let (values, others) = rest.split_at(array.len(description));
        if array.name != "last" {
            set(instance, array.name, values);
        }
        rest = others;
    }
    if signature.name == COMPENSATED.name {
        instance.set("resume", &[1.0]);
        let q = instance.get("q");
        instance.set("standing", &q);
    }
    instance.call().unwrap_or_else(|fault| panic!("{} stops the controller: {fault}", signature.name));
    let status = instance.get("status")[0];
    let results = signature.results.iter().filter(|array| !array.is_empty(description));
    let is_valid = !(1.0..=3.0).contains(&status);
    (status, results.filter(|_| is_valid).flat_map(|array| instance.get(array.name)).collect())
}

/// Fails if a function gives something else after other calls.
fn assert_forgets(spec: Spec, count: usize) {
    let (program, prefix) = (program(&spec), prefix(&spec).to_owned());
    let robot = Interpreter::new(spec);
    let description = robot.description();
    let given = configurations(&robot, count);
    let commands = COMMANDS.into_iter().filter(|_| !description.variables.is_empty());
    for signature in Function::all(description).map(Function::signature).chain(commands) {
        let name = format!("{prefix}_{}", signature.name);
        let mut used = program.instance(&name);
        for given in &given {
            let numbers = arguments(&robot, signature, given);
            let expected = called(&mut program.instance(&name), description, signature, &numbers);
            let found = called(&mut used, description, signature, &numbers);
            assert_eq!(found, expected, "{name} at {numbers:?}");
        }
    }
}

#[test]
fn calls_of_shipped_machines_are_alike() {
    for shipped in SHIPPED.iter().filter(|shipped| is_tested(shipped.name)) {
        assert_forgets(Spec::parse(&format!("{}.toml", shipped.name), shipped.spec).unwrap(), 5);
    }
}

#[test]
fn calls_of_closed_loops_are_alike() {
    for (name, spec) in MECHANISMS {
        assert_forgets(Spec::parse(&format!("{name}.toml"), spec).unwrap(), 5);
    }
    assert_forgets(Spec::read(specs::path("linkage")).unwrap(), 5);
}

#[test]
fn calls_of_long_chains_and_tables_are_alike() {
    assert_forgets(Spec::parse("long.toml", &long_chain()).unwrap(), 3);
    assert_forgets(Spec::parse("coupled.toml", coupled_joints()).unwrap(), 3);
    assert_forgets(Spec::read(specs::path("measured")).unwrap(), 5);
}
