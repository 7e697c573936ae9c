//! Generated JavaScript gives what Rust gives, to 1e-13 of the largest number of a result: every function of every
//! shipped robot, of a long chain, and of one whose names mean something in JavaScript.

use std::fs;
use std::path::Path;
use std::process::{Command, ExitCode};

use abbe::analysis::sampling::{arm_length, halton, joint_sample, nominal_inputs, nominal_parameters};
use abbe::{Function, Manipulator};
use abbe_codegen::print::Language;
use abbe_codegen::spec::Spec;
use abbe_interpreter::Interpreter;
use abbe_manipulators::SHIPPED;
use abbe_tests::chains::{coupled_joints, long_chain};
use abbe_tests::needs::{Missing, run, tool};
use abbe_tests::specs;

/// Words of JavaScript, and names that its functions use.
const NAMES: &str = r#"
[manipulator]
name = "arguments"
title = "Comments end here: */ or `not`"
length = "m"
[parameters]
function = "0.3 m"
Math = 2
pose = 0.1
class = "0.2 m"
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
transform = "Tx(-function^1.5/abs(class)^0.5)"
[[source]]
name = "repeatable"
class = "repeatable"
frame = "second"
e_x = "1e-4 m/N*NaN*cos(new)"
e_r = "-1e-3*atan2(function, class)*sqrt(Math)"
"#;

fn main() -> ExitCode {
    run([
        ("shipped_robots", shipped_robots as _),
        ("long_chains", long_chains as _),
        ("tables_and_functions", tables_and_functions as _),
        ("names_that_mean_something", names_that_mean_something as _),
    ])
}

fn shipped_robots() -> Result<(), Missing> {
    tool("node", "")?;
    for shipped in SHIPPED {
        assert_equal(Spec::parse(&format!("{}.toml", shipped.name), shipped.spec).unwrap(), 1000);
    }
    Ok(())
}

fn long_chains() -> Result<(), Missing> {
    tool("node", "")?;
    assert_equal(Spec::parse("long.toml", &long_chain()).unwrap(), 50);
    assert_equal(Spec::parse("coupled.toml", coupled_joints()).unwrap(), 50);
    Ok(())
}

fn tables_and_functions() -> Result<(), Missing> {
    tool("node", "")?;
    assert_equal(Spec::read(specs::path("measured")).unwrap(), 1000);
    Ok(())
}

fn names_that_mean_something() -> Result<(), Missing> {
    tool("node", "")?;
    assert_equal(Spec::parse("names.toml", NAMES).unwrap(), 50);
    Ok(())
}

/// Equal to Rust in so many configurations.
fn assert_equal(spec: Spec, count: usize) {
    let (name, module) = (spec.name.clone(), Language::JavaScript.print(&spec));
    let robot = Interpreter::new(spec);
    let given = configurations(&robot, count);
    let found = called(&module, &given.concat());
    let mut found = &found[..];
    let mut worst: f64 = 0.0;
    for given in &given {
        for function in Function::ALL {
            let expected = robot.evaluate(function, &arguments(&robot, function, given)).unwrap();
            let (results, rest) = found.split_at(expected.len());
            found = rest;
            let mut first = 0;
            let arrays = function.signature().results.iter().map(|array| array.len(robot.description()));
            for len in arrays.chain([1]) {
                let range = first..(first + len).min(expected.len());
                let (results, expected) = (&results[range.clone()], &expected[range]);
                let largest = expected.iter().fold(0.0, |largest: f64, value| largest.max(value.abs()));
                for (a, b) in results.iter().zip(expected) {
                    let difference = (a - b).abs();
                    assert!(difference <= 1e-13 * largest, "{name} {}: {a} and {b}", function.name());
                    worst = worst.max(if difference > 0.0 { difference / largest } else { 0.0 });
                }
                first += len;
            }
        }
    }
    assert!(found.is_empty(), "{name}: {} numbers more", found.len());
    println!("{name}: {worst:e} in {count} configurations");
}

/// q, s, u, errors, variances and magnitudes.
fn configurations(robot: &Interpreter, count: usize) -> Vec<Vec<f64>> {
    let description = robot.description();
    let (s, u) = (nominal_parameters(description), nominal_inputs(description));
    let arm = arm_length(robot, &s).unwrap();
    let moved: Vec<usize> = (0..description.variables.len()).collect();
    let errors = 6 * description.frames.len();
    let configuration = |index| {
        let small = (0..2 * errors).map(|k| 1e-3 * halton(index + 1, k % 30));
        let magnitudes = (0..description.sources.len()).map(|k| 2.0 * halton(index + 1, k % 30) - 1.0);
        joint_sample(description, arm, &moved, index)
            .into_iter()
            .chain(s.clone())
            .chain(u.clone())
            .chain(small)
            .chain(magnitudes)
            .collect()
    };
    (0..count).map(configuration).collect()
}

/// What a function takes of that.
fn arguments(robot: &Interpreter, function: Function, given: &[f64]) -> Vec<f64> {
    let description = robot.description();
    let errors = 6 * description.frames.len();
    let sizes = [
        ("q", description.variables.len()),
        ("s", description.parameters.len()),
        ("u", description.inputs.len()),
        ("errors", errors),
        ("variances", errors),
        ("magnitudes", description.sources.len()),
    ];
    let mut first = 0;
    let mut taken = Vec::new();
    for (name, size) in sizes {
        if function.signature().arguments.iter().any(|array| array.name == name) {
            taken.extend(&given[first..first + size]);
        }
        first += size;
    }
    taken
}

/// What the functions of a module give, by node.
fn called(module: &str, given: &[f64]) -> Vec<f64> {
    let folder = tempfile::tempdir().unwrap();
    let [source, input, output] = ["module.mjs", "input", "output"].map(|name| folder.path().join(name));
    fs::write(&source, module).unwrap();
    fs::write(&input, given.iter().flat_map(|value| value.to_ne_bytes()).collect::<Vec<u8>>()).unwrap();
    let names = |function: Function| {
        let arguments: Vec<&str> = function.signature().arguments.iter().map(|array| array.name).collect();
        (function.name(), arguments)
    };
    let functions = serde_json::to_string(&Function::ALL.map(names)).unwrap();
    let script = Path::new(env!("CARGO_MANIFEST_DIR")).join("javascript/run.mjs");
    let run = Command::new("node").arg(script).arg(&source).arg(functions).args([&input, &output]).output();
    let run = run.expect("node is there");
    assert!(run.status.success(), "{}", String::from_utf8_lossy(&run.stderr));
    let bytes = fs::read(&output).unwrap();
    bytes.chunks_exact(8).map(|bytes| f64::from_ne_bytes(bytes.try_into().unwrap())).collect()
}
