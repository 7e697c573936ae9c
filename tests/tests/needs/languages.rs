//! Code generated for JavaScript, NumPy and Octave equals Rust to 1e-13 of the largest number of a
//! result: every function of every shipped robot, of a long chain, and of a robot with names that
//! have a meaning in these languages. Compensated commands are equal to 1e-9 of a metre or a rad.
//!
//! `PYTHON` names a Python that has NumPy, if `python3` has none. Octave is slow and evaluates 20
//! configurations; `CONFIGURATIONS=1000` sets the number for all.

use std::fs;
use std::path::Path;
use std::process::Command;

use abbe::function::{Array, COMPENSATED, Signature};
use abbe::{Function, Manipulator};
use abbe_codegen::print::Language;
use abbe_interpreter::Interpreter;
use abbe_manipulators::SHIPPED;
use abbe_spec::Spec;
use abbe_tests::chains::{coupled_joints, long_chain};
use abbe_tests::languages::{NAMES, assert_alike, configurations, given_arrays};
use abbe_tests::needs::{Missing, Tests, python, tool};
use abbe_tests::{is_tested, specs};
use serde_json::{Value, json};

pub(crate) const TESTS: Tests = &[
    ("javascript", (|| in_all(Language::JavaScript, 1000))),
    ("python", (|| in_all(Language::Python, 1000))),
    ("octave", (|| in_all(Language::Matlab, 20))),
];

/// Checks all robots in a language, at this number of configurations unless `CONFIGURATIONS` is
/// set.
fn in_all(language: Language, usual: usize) -> Result<(), Missing> {
    let command = command(language)?;
    let asked = std::env::var("CONFIGURATIONS").ok().and_then(|count| count.parse().ok());
    let count = asked.unwrap_or(usual);
    let few = count.min(50);
    for shipped in SHIPPED.iter().filter(|shipped| is_tested(shipped.name)) {
        let spec = Spec::parse(&format!("{}.toml", shipped.name), shipped.spec).unwrap();
        assert_equal(language, &command, spec, count);
    }
    assert_equal(language, &command, Spec::parse("long.toml", &long_chain()).unwrap(), few);
    assert_equal(language, &command, Spec::parse("coupled.toml", coupled_joints()).unwrap(), few);
    assert_equal(language, &command, Spec::read(specs::path("measured")).unwrap(), count);
    assert_equal(language, &command, Spec::parse("names.toml", NAMES).unwrap(), few);
    Ok(())
}

/// Returns the command that runs a script of the language.
fn command(language: Language) -> Result<Vec<String>, Missing> {
    let words = |words: &[&str]| words.iter().map(|word| (*word).to_owned()).collect();
    match language {
        Language::JavaScript => tool("node", "").map(|_| words(&["node"])),
        Language::Python => python("numpy").map(|python| words(&[&python])),
        _ => tool("octave", "").map(|_| words(&["octave", "--no-gui", "--quiet", "--norc"])),
    }
}

/// Returns the interface that scripts of other languages call: the arguments with their shapes, and
/// the name, arguments, results and margin of every function.
fn called(robot: &dyn Manipulator) -> Value {
    let description = robot.description();
    let shape = |array: &Array| array.shape.iter().map(|count| count.value(description)).collect::<Vec<_>>();
    let arrays = given_arrays();
    let arrays = arrays.iter().map(|array| json!({ "name": array.name, "shape": shape(array) }));
    let names = |arrays: &[Array]| arrays.iter().map(|array| array.name).collect::<Vec<_>>();
    let one = |signature: &Signature, behind: Option<&'static str>| {
        let results: Vec<_> = names(signature.results).into_iter().chain(behind).collect();
        json!([signature.name, names(signature.arguments), results])
    };
    let functions = Function::ALL.map(Function::signature);
    let functions = functions
        .into_iter()
        .map(|signature| one(signature, signature.has_margin(description.orientation).then_some("margin")));
    let functions = functions.chain([one(&COMPENSATED, Some("status"))]);
    json!({ "arrays": arrays.collect::<Vec<_>>(), "functions": functions.collect::<Vec<_>>() })
}

/// Compares `count` configurations with Rust.
fn assert_equal(language: Language, command: &[String], spec: Spec, count: usize) {
    let (name, file) = (spec.name.clone(), language.files(&spec).remove(0));
    let robot = Interpreter::new(spec);
    let given = configurations(&robot, count);
    let folder = tempfile::tempdir().unwrap();
    let script = match language {
        Language::JavaScript => "run.mjs",
        Language::Python => "run.py",
        _ => "run.m",
    };
    let source = folder.path().join(if language == Language::JavaScript { "module.mjs" } else { &file.name });
    let [input, output, functions] = ["input", "output", "functions"].map(|name| folder.path().join(name));
    fs::write(&source, &file.text).unwrap();
    fs::write(&input, given.concat().iter().flat_map(|value| value.to_ne_bytes()).collect::<Vec<u8>>())
        .unwrap();
    fs::write(&functions, called(&robot).to_string()).unwrap();
    let script = Path::new(env!("CARGO_MANIFEST_DIR")).join("languages").join(script);
    let mut run = Command::new(&command[0]);
    let run = run.args(&command[1..]).arg(script).args([&source, &functions, &input, &output]).output();
    let run = run.expect("the command is there");
    assert!(run.status.success(), "{name}: {}", String::from_utf8_lossy(&run.stderr));
    let bytes = fs::read(&output).unwrap();
    let found: Vec<f64> =
        bytes.chunks_exact(8).map(|bytes| f64::from_ne_bytes(bytes.try_into().unwrap())).collect();
    let evaluate = |function: Function, given: &[f64]| robot.evaluate(function, given).unwrap();
    let worst = assert_alike(&robot, evaluate, &given, &found);
    println!("{name}: {worst:e} in {count} configurations");
}
