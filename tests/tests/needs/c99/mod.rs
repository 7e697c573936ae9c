//! Generated C equals Rust bit by bit: every function of every shipped robot, of a long chain, of
//! tables, and of names with a meaning in C. It is compiled with every warning as an error.

use std::fs;
use std::path::Path;
use std::process::Command;

use crate::random_loops::random_loops;
use abbe::function::COMMANDS;
use abbe::{Function, Manipulator, Orientation};
use abbe_codegen::print::{Language, Real};
use abbe_interpreter::Interpreter;
use abbe_manipulators::SHIPPED;
use abbe_spec::Spec;
use abbe_tests::chains::{coupled_joints, long_chain};
use abbe_tests::languages::{NAMES, arguments, compare_command, configurations, open_linkage};
use abbe_tests::needs::{Missing, Tests, tool};
use abbe_tests::{hostile, is_tested, specs, thorough};
use rayon::prelude::*;

use self::program::{STRICT, called, functions, succeeds, write, write_files};

mod arithmetic;
mod mutants;
pub(crate) mod program;
mod selected;
mod single;

pub(crate) const TESTS: Tests = &[
    ("shipped_robots", shipped_robots),
    ("long_chains", long_chains),
    ("loops", loops),
    ("small_code_has_the_same_bits", small_code_has_the_same_bits),
    ("tables_and_functions", tables_and_functions),
    ("names_that_mean_something", names_that_mean_something),
    ("hostile_names_compile", hostile_names_compile),
    ("headers_are_those_of_cpp_too", headers_are_those_of_cpp_too),
    ("poses_have_their_joints_in_both_precisions", single::poses_have_their_joints),
    ("single_precision_is_as_close_as_the_chapter_says", single::shipped_robots),
    ("single_precision_of_long_chains_and_tables", single::long_chains_and_tables),
    ("single_precision_of_mechanisms", single::mechanisms),
    ("single_precision_of_sines", single::sines),
    ("self_tests_pass_and_fail", single::self_tests),
    ("selected_functions_are_alone", selected::are_alone),
    ("arrays_of_corrected_commands_may_overlap", selected::arrays_may_overlap),
    ("finite_math_is_refused", arithmetic::finite_math_is_refused),
    ("a_broken_sine_is_found", arithmetic::a_broken_sine_is_found),
    ("the_named_flags_hold_the_bits", arithmetic::the_named_flags_hold_the_bits),
    ("huge_arguments_give_no_infinite_result", arithmetic::huge_arguments),
    ("mutants_are_found", mutants::are_found),
    ("the_code_of_the_chapter_keeps_its_bounds", the_code_of_the_chapter_keeps_its_bounds),
    ("departures_from_misra_are_listed", departures_from_misra_are_listed),
];

fn shipped_robots() -> Result<(), Missing> {
    tool("cc", "")?;
    for shipped in SHIPPED.iter().filter(|shipped| is_tested(shipped.name)) {
        let spec = Spec::parse(&format!("{}.toml", shipped.name), shipped.spec).unwrap();
        let source = Language::C(Real::Double).files(&spec).remove(1).text;
        // The self-test has expected values of every function.
        assert!(!source.contains("is not finite at this configuration"), "{}", spec.name);
        assert_equal(spec, 1000);
    }
    Ok(())
}

fn long_chains() -> Result<(), Missing> {
    tool("cc", "")?;
    assert_equal(Spec::parse("long.toml", &long_chain()).unwrap(), 50);
    assert_equal(Spec::parse("coupled.toml", coupled_joints()).unwrap(), 50);
    Ok(())
}

fn loops() -> Result<(), Missing> {
    tool("cc", "")?;
    assert_equal(Spec::read(specs::path("planar")).unwrap(), 1000);
    for (spec, given) in random_loops(1) {
        assert_equal_at(spec, &given);
    }
    let spec = Spec::read(specs::path("linkage")).unwrap();
    assert_equal(spec.clone(), 1000);
    // What does not close has the status `LINKAGE_NOT_CLOSED`.
    let folder = tempfile::tempdir().unwrap();
    write(folder.path(), &spec, Real::Double);
    let robot = Interpreter::new(spec);
    let found = called(&["cc"], folder.path(), &robot, Real::Double, &[open_linkage(&robot)]);
    let mut rest = &found[1..];
    for function in functions(&robot) {
        if matches!(function, Function::Passive | Function::Pose | Function::ErrorJacobian) {
            assert_eq!(rest[0], -1.0, "{}", function.name());
        }
        let count: usize =
            function.signature().results.iter().map(|array| array.len(robot.description())).sum();
        rest = &rest[1 + count..];
    }
    Ok(())
}

fn tables_and_functions() -> Result<(), Missing> {
    tool("cc", "")?;
    assert_equal(Spec::read(specs::path("measured")).unwrap(), 1000);
    Ok(())
}

fn names_that_mean_something() -> Result<(), Missing> {
    tool("cc", "")?;
    assert_equal(Spec::parse("names.toml", NAMES).unwrap(), 50);
    Ok(())
}

/// Compiles sources whose folder is searched for headers first, alone and in C++.
fn hostile_names_compile() -> Result<(), Missing> {
    tool("cc", "")?;
    let step = if thorough() { 1 } else { 7 };
    for (name, text) in hostile::specs(110).step_by(step) {
        // Units are no names.
        let Ok(spec) = Spec::parse(&format!("{name}.toml"), &text) else { continue };
        for real in Real::ALL {
            let folder = tempfile::tempdir().unwrap();
            let files = Language::C(real).files(&spec);
            let source = folder.path().join(&files[1].name);
            write_files(folder.path(), files);
            let mut compile = Command::new("cc");
            compile.args(STRICT).arg("-I").arg(folder.path()).args(["-c", "-o"]);
            succeeds(compile.arg(folder.path().join("object.o")).arg(&source));
        }
    }
    Ok(())
}

fn headers_are_those_of_cpp_too() -> Result<(), Missing> {
    tool("c++", "")?;
    let folder = tempfile::tempdir().unwrap();
    let spec = Spec::parse("names.toml", NAMES).unwrap();
    write(folder.path(), &spec, Real::Float);
    let source = folder.path().join("main.cpp");
    fs::write(&source, format!("#include \"{0}.h\"\nint main() {{ return {0}_self_test(); }}\n", spec.name))
        .unwrap();
    let object = folder.path().join("main.o");
    let flags = ["-Wall", "-Wextra", "-Wpedantic", "-Werror", "-c", "-o"];
    succeeds(Command::new("c++").args(flags).arg(&object).arg(&source));
    Ok(())
}

/// Code that is to be small has loops for zeros and one sine for all angles, and the same bits.
fn small_code_has_the_same_bits() -> Result<(), Missing> {
    tool("cc", "")?;
    let pps = SHIPPED.iter().find(|shipped| shipped.name == "pps").unwrap();
    let pps = Spec::parse("pps.toml", pps.spec).unwrap();
    let [measured, linkage] = ["measured", "linkage"].map(|name| Spec::read(specs::path(name)).unwrap());
    for spec in [pps, measured, linkage] {
        let folder = tempfile::tempdir().unwrap();
        write(folder.path(), &spec, Real::Double);
        let robot = Interpreter::new(spec);
        let given = configurations(&robot, 200);
        let found = called(&["cc", "-Os"], folder.path(), &robot, Real::Double, &given);
        assert_eq!(found[0], 0.0, "{}: the self-test", robot.description().name);
        compare(&robot, &given, &found[1..]).unwrap();
    }
    Ok(())
}

/// Drives the controller of the chapter through starts, faults and restarts.
const CONTROLLER: &str = include_str!("controller.c");

fn the_code_of_the_chapter_keeps_its_bounds() -> Result<(), Missing> {
    tool("cc", "")?;
    let page = Path::new(env!("CARGO_MANIFEST_DIR")).join("../docs/in-a-controller.md");
    let page = fs::read_to_string(page).unwrap();
    let blocks = page.split("```c\n").skip(1).map(|block| block.split("```").next().unwrap());
    let code: String = blocks.collect();
    let folder = tempfile::tempdir().unwrap();
    let shipped = SHIPPED.iter().find(|shipped| shipped.name == "pps").unwrap();
    let spec = Spec::parse("pps.toml", shipped.spec).unwrap();
    write_files(folder.path(), Language::C(Real::Double).files(&spec));
    let [source, program] = ["controller.c", "controller"].map(|name| folder.path().join(name));
    fs::write(&source, code + CONTROLLER).unwrap();
    succeeds(
        Command::new("cc")
            .args(STRICT)
            .args(["-Wshadow", "-o"])
            .args([&program, &source, &folder.path().join("pps.c")])
            .arg("-lm"),
    );
    assert_eq!(Command::new(program).status().unwrap().code(), Some(0), "the line of what is wrong");
    Ok(())
}

fn departures_from_misra_are_listed() -> Result<(), Missing> {
    tool("cppcheck", "")?;
    let page = Path::new(env!("CARGO_MANIFEST_DIR")).join("../docs/in-a-controller.md");
    let page = fs::read_to_string(page).unwrap();
    let (_, table) = page.split_once("**MISRA").unwrap();
    let listed: Vec<&str> = table
        .lines()
        .filter_map(|line| line.strip_prefix("| ")?.split(" |").next())
        .flat_map(|rules| rules.split(", "))
        .collect();
    let specs = ["pps", "puma560", "iiwa"].map(|name| {
        let shipped = SHIPPED.iter().find(|shipped| shipped.name == name).unwrap();
        Spec::parse(name, shipped.spec).unwrap()
    });
    let long = Spec::parse("long.toml", &long_chain()).unwrap();
    let [measured, linkage] = ["measured", "linkage"].map(|name| Spec::read(specs::path(name)).unwrap());
    let specs = specs.into_iter().filter(|spec| is_tested(&spec.name));
    let both = specs.chain([long, measured]).flat_map(|spec| Real::ALL.map(|real| (spec.clone(), real)));
    // Loops make the longest code: an ordinary run has it in one precision.
    let loops = Real::ALL.map(|real| (linkage.clone(), real)).into_iter();
    let loops = loops.filter(|(_, real)| thorough() || *real == Real::Double);
    let checks: Vec<(Spec, Real)> = loops.chain(both).collect();
    checks.into_par_iter().with_max_len(1).for_each(|(spec, real)| {
        let folder = tempfile::tempdir().unwrap();
        write(folder.path(), &spec, real);
        let source = folder.path().join(format!("{}.c", spec.name));
        // One processor each: checking every combination of macros takes minutes.
        let processor = if real == Real::Double { "-D__SSE2__" } else { "-D__ARM_FP" };
        let checked = Command::new("cppcheck")
            .args(["--std=c99", "--addon=misra", "--enable=warning,style", processor])
            .arg(&source)
            .output()
            .unwrap();
        let said = String::from_utf8_lossy(&checked.stderr);
        // Violations of MISRA rules are reported with the severity "style".
        let matters = |line: &&str| ["error: ", "warning: ", "misra"].iter().any(|what| line.contains(what));
        let found = said.lines().filter(matters);
        let is_listed =
            |line: &str| listed.iter().any(|rule| line.ends_with(&format!("[misra-c2012-{rule}]")));
        let (those, others): (Vec<&str>, Vec<&str>) = found.partition(|line| is_listed(line));
        assert!(others.is_empty(), "{}: {others:#?}", spec.name);
        // Products in sums occur everywhere: without one the addon has not run.
        assert!(those.iter().any(|line| line.ends_with("[misra-c2012-12.1]")), "{}: {said}", spec.name);
    });
    Ok(())
}

/// Compares `count` configurations with Rust bit by bit, compensated commands to 1e-9, and runs the
/// self-test.
fn assert_equal(spec: Spec, count: usize) {
    let given = configurations(&Interpreter::new(spec.clone()), count);
    assert_equal_at(spec, &given);
}

/// Compares given configurations; see [`assert_equal`].
fn assert_equal_at(spec: Spec, given: &[Vec<f64>]) {
    let folder = tempfile::tempdir().unwrap();
    write(folder.path(), &spec, Real::Double);
    let robot = Interpreter::new(spec);
    let found = called(&["cc"], folder.path(), &robot, Real::Double, given);
    assert_eq!(found[0], 0.0, "{}: the self-test", robot.description().name);
    compare(&robot, given, &found[1..]).unwrap();
}

/// Compares the numbers of every function and of compensated commands at every configuration, each
/// after its status, with Rust. Returns the first difference.
fn compare(robot: &Interpreter, given: &[Vec<f64>], found: &[f64]) -> Result<(), String> {
    let description = robot.description();
    let name = &description.name;
    let mut found = found.iter().copied();
    let mut next = || found.next().ok_or_else(|| format!("{name}: numbers are missing"));
    let evaluate = |function: Function, given: &[f64]| robot.evaluate_unchecked(function, given).unwrap();
    let euler = description.orientation != Orientation::RotationVector;
    for given in given {
        let is_refused = has_input_beyond_its_range(robot, given);
        for function in functions(robot) {
            let has_margin = function.signature().has_margin(description.orientation);
            if is_refused && function.signature().arguments.iter().any(|array| array.name == "u") {
                let numbers = function.signature().results_len(description) - usize::from(has_margin);
                refused(&mut next, numbers, function.name())?;
                continue;
            }
            let mut expected = evaluate(function, &arguments(robot, function.signature(), given));
            expected.truncate(expected.len() - usize::from(has_margin));
            let status = next()?;
            if !(status == 0.0 || euler && status == 2.0) {
                return Err(format!("{name} {}: {status}", function.name()));
            }
            for (k, expected) in expected.into_iter().enumerate() {
                let number = next()?;
                if !(number == expected || status != 0.0 && !expected.is_finite()) {
                    return Err(format!("{name} {} {k}: {number:e} and {expected:e}", function.name()));
                }
            }
        }
        for command in COMMANDS {
            let count = command.results_len(description);
            if is_refused {
                refused(&mut next, count, command.name)?;
                continue;
            }
            let status = next()?;
            let numbers: Result<Vec<f64>, String> = (0..count).map(|_| next()).collect();
            compare_command(robot, evaluate, command, given, &numbers?, status)?;
        }
    }
    match found.next() {
        None => Ok(()),
        Some(_) => Err(format!("{name}: too many numbers")),
    }
}

/// Skips the numbers of a function. Returns an error if its status is not that of an input beyond
/// its range.
fn refused(
    next: &mut impl FnMut() -> Result<f64, String>,
    numbers: usize,
    function: &str,
) -> Result<(), String> {
    let status = next()?;
    (0..numbers).try_for_each(|_| next().map(|_| ()))?;
    if status == 3.0 { Ok(()) } else { Err(format!("{function}: {status} for an input beyond its range")) }
}

fn has_input_beyond_its_range(robot: &Interpreter, given: &[f64]) -> bool {
    let description = robot.description();
    let first = description.variables.len() + description.parameters.len();
    let inputs = description.inputs.iter().zip(&given[first..]);
    inputs.into_iter().any(|(input, value)| *value < input.range[0] || *value > input.range[1])
}
