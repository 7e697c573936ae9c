//! Generated Structured Text is read by a parser that accepts what every dialect does, and run by
//! an interpreter that stops where a controller may stop. It has the bits of Rust: every function
//! of every shipped manipulator, of a long chain, of tables, and of names with a meaning. Only the
//! arctangent of two numbers differs, because the standard has none, by two units in the last
//! place.

mod chapter;
mod cycles;
mod guards;
mod plcopen;
mod rejected;
mod repeated;
mod support;

use abbe::{Function, Manipulator};
use abbe_codegen::print::Language;
use abbe_interpreter::Interpreter;
use abbe_manipulators::SHIPPED;
use abbe_spec::Spec;
use abbe_tests::chains::{coupled_joints, long_chain};
use abbe_tests::languages::{NAMES, arguments, configurations};
use abbe_tests::structured_text::{Instance, Program};
use abbe_tests::{is_tested, sample_size, specs};
use rand::SeedableRng;
use rand::seq::IndexedRandom;
use rand_xoshiro::Xoshiro256PlusPlus;

/// Returns the generated text of a spec.
fn text(spec: &Spec) -> String {
    Language::StructuredText.files(spec).remove(0).text
}

/// Parses the generated text of a spec; with the arctangent of Rust, everything has its bits.
fn program(spec: &Spec) -> Program {
    let mut program = Program::parse(&text(spec)).unwrap_or_else(|fault| panic!("{}: {fault}", spec.name));
    if !spec.variables.is_empty() {
        program.replace(&format!("{}_arctangent", prefix(spec)), f64::atan2);
    }
    program
}

/// Returns the first part of the names in a file.
fn prefix(spec: &Spec) -> &str {
    spec.name.trim_end_matches('_')
}

fn shipped(name: &str) -> Spec {
    let shipped = SHIPPED.iter().find(|shipped| shipped.name == name).unwrap();
    Spec::parse(&format!("{name}.toml"), shipped.spec).unwrap()
}

/// Sets the inputs of a block that the manipulator has.
fn set(instance: &mut Instance<'_>, name: &str, values: &[f64]) {
    let name = match name {
        "s" => "parameters",
        "u" => "inputs",
        name => name,
    };
    if !values.is_empty() {
        instance.set(name, values);
    }
}

/// Compares every function with Rust, bit by bit.
fn assert_equal(spec: Spec, count: usize) {
    let (program, prefix) = (program(&spec), prefix(&spec).to_owned());
    let robot = Interpreter::new(spec);
    let given = configurations(&robot, count);
    for function in Function::all(robot.description()) {
        compared(&program, &prefix, &robot, function, &given).unwrap_or_else(|fault| panic!("{fault}"));
    }
}

/// Returns an error where a function differs from Rust in a bit.
fn compared(
    program: &Program,
    prefix: &str,
    robot: &Interpreter,
    function: Function,
    given: &[Vec<f64>],
) -> Result<(), String> {
    let (description, signature) = (robot.description(), function.signature());
    let name = format!("{prefix}_{}", function.name());
    let mut instance = program.instance(&name);
    for given in given {
        let numbers = arguments(robot, signature, given);
        let mut rest = &numbers[..];
        for array in signature.arguments {
            let (values, others) = rest.split_at(array.len(description));
            set(&mut instance, array.name, values);
            rest = others;
        }
        instance.call().map_err(|fault| format!("{name} stops the controller: {fault}"))?;
        let mut expected = robot.evaluate_unchecked(function, &numbers).unwrap();
        let margin = signature.has_margin(description.orientation).then(|| expected.pop().unwrap());
        let status = if margin.is_some_and(|margin| margin < abbe::MINIMUM_MARGIN) { 2.0 } else { 0.0 };
        let found = instance.get("status")[0];
        if found != status {
            return Err(format!("{name}: status {found}, not {status}"));
        }
        let mut rest = &expected[..];
        for array in signature.results.iter().filter(|_| status == 0.0) {
            let (values, others) = rest.split_at(array.len(description));
            if !values.is_empty() && instance.get(array.name) != values {
                return Err(format!("{name} {}: {:?}, not {values:?}", array.name, instance.get(array.name)));
            }
            rest = others;
        }
        if margin.is_some_and(|margin| instance.get("margin") != [margin]) {
            return Err(format!("{name}: margin"));
        }
    }
    Ok(())
}

#[test]
fn shipped_manipulators_have_the_bits_of_rust() {
    for shipped in SHIPPED.iter().filter(|shipped| is_tested(shipped.name)) {
        let spec = Spec::parse(&format!("{}.toml", shipped.name), shipped.spec).unwrap();
        assert_equal(spec, sample_size(1000) / 10);
    }
}

#[test]
fn long_chains_have_the_bits_of_rust() {
    assert_equal(Spec::parse("long.toml", &long_chain()).unwrap(), 3);
    assert_equal(Spec::parse("coupled.toml", coupled_joints()).unwrap(), 3);
}

#[test]
fn loops_have_the_bits_of_rust() {
    for name in ["linkage", "planar"] {
        assert_equal(Spec::read(specs::path(name)).unwrap(), 5);
    }
}

#[test]
fn tables_have_the_bits_of_rust() {
    assert_equal(Spec::read(specs::path("measured")).unwrap(), sample_size(1000) / 10);
}

/// Names that differ in case only, are reserved, or end with an underscore.
#[test]
fn names_that_collide_are_distinct() {
    assert_equal(Spec::parse("names.toml", NAMES).unwrap(), 5);
    let text = r#"
[manipulator]
name = "st_"
length = "m"
[parameters]
Len = "0.3 m"
len = "0.2 m"
LEN_2 = "0.1 m"
S = 0.1
inputs = "0.05 m"
fault = 0.2
st_sine = "0.01 m"
run_pose = "0.02 m"
a__b = "0.03 m"
At_ = "0.04 m"
[inputs]
to = { value = "2 N", range = ["0 N", "3 N"] }
To = { value = "1 N", range = ["0 N", "3 N"] }
[[frame]]
name = "ends *) a comment, (* begins one, (*) both"
variable = { name = "R", kind = "revolute", limits = [-1, 1] }
transform = "Rz(R - S) Tx(Len + inputs)"
[[frame]]
name = "second"
variable = { name = "r", kind = "revolute", limits = [-1, 1] }
transform = "Rx(r*fault) Ty(len + st_sine + run_pose) Tz(LEN_2 + a__b + At_)"
[[source]]
name = "repeatable"
class = "repeatable"
frame = "second"
e_x = "1e-4 m/N*(to + To)*cos(R)"
"#;
    assert_equal(Spec::parse("st_.toml", text).unwrap(), 5);
}

/// Wrong operators are found: one of each kind in each function, at a place drawn by chance.
#[test]
fn mutants_are_caught() {
    let spec = shipped("pps");
    let (right, robot) = (text(&spec), Interpreter::new(spec.clone()));
    let mut given = configurations(&robot, 3);
    // A parameter or an input that is 0 hides what it multiplies.
    let (variables, parameters) = (spec.variables.len(), spec.parameters.len());
    for given in &mut given {
        let (s, rest) = given[variables..].split_at_mut(parameters);
        s.iter_mut().for_each(|s| *s = 1.1 * *s + 0.01);
        for (u, input) in rest.iter_mut().zip(&spec.inputs) {
            *u = input.range[0] + 0.6 * (input.range[1] - input.range[0]);
        }
    }
    let mut random = Xoshiro256PlusPlus::seed_from_u64(23);
    let mut caught = 0;
    for function in Function::ALL {
        let head = format!("FUNCTION_BLOCK pps_{}\n", function.name());
        let begin = right.find(&head).unwrap();
        let end = begin + right[begin..].find("END_FUNCTION_BLOCK").unwrap();
        // Statements that compute: no checks, and no declarations.
        let first = begin + right[begin..].find("END_IF;").unwrap();
        for (from, to) in [(" + ", " - "), (" - ", " + "), (" * ", " + "), (":= -", ":= ")] {
            let is_computed = |at: &usize| {
                let rest = right[*at..].lines().next().unwrap();
                !rest.contains("ABS(") && !rest.contains("LREAL#1.0E37)")
            };
            let places: Vec<usize> =
                right[first..end].match_indices(from).map(|(at, _)| first + at).collect();
            let places: Vec<usize> = places.into_iter().filter(is_computed).collect();
            let Some(at) = places.choose(&mut random) else { continue };
            let wrong = format!("{}{to}{}", &right[..*at], &right[at + from.len()..]);
            let line = right[..*at].matches('\n').count() + 1;
            let mut program = Program::parse(&wrong).unwrap();
            program.replace("pps_arctangent", f64::atan2);
            let is_equal = compared(&program, "pps", &robot, function, &given).is_ok();
            assert!(!is_equal, "pps_{}, line {line}: {from} → {to} is not caught", function.name());
            caught += 1;
        }
    }
    println!("{caught} of {caught} mutants");
    assert!(caught > 30, "{caught}");
}
