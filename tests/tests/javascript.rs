//! Generated JavaScript gives what Rust gives, to 1e-13 of the largest number of a result: every function of every
//! shipped robot, of a long chain, and of one whose names mean something in JavaScript.

use std::fs;
use std::path::Path;
use std::process::{Command, ExitCode};

use abbe::{Function, Manipulator};
use abbe_codegen::print::Language;
use abbe_codegen::spec::Spec;
use abbe_interpreter::Interpreter;
use abbe_manipulators::SHIPPED;
use abbe_tests::chains::{coupled_joints, long_chain};
use abbe_tests::languages::{NAMES, arguments, configurations};
use abbe_tests::needs::{Missing, run, tool};
use abbe_tests::specs;

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
    let (name, module) = (spec.name.clone(), Language::JavaScript.files(&spec).remove(0).text);
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
