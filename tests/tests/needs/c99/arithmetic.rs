//! Generated C under compiler options that change arithmetic, with a broken sine, and at arguments
//! whose results overflow.

use std::fs;
use std::path::Path;
use std::process::Command;

use abbe::Manipulator;
use abbe_codegen::print::{Language, Real};
use abbe_interpreter::Interpreter;
use abbe_manipulators::SHIPPED;
use abbe_spec::Spec;
use abbe_tests::chains::long_chain;
use abbe_tests::languages::configurations;
use abbe_tests::needs::{Missing, tool};
use abbe_tests::{is_tested, specs, thorough};

use super::program::{called, functions, self_test, self_test_sources, write, write_files};

fn shipped() -> impl Iterator<Item = Spec> {
    let tested = SHIPPED.iter().filter(|shipped| is_tested(shipped.name));
    tested.map(|shipped| Spec::parse(&format!("{}.toml", shipped.name), shipped.spec).unwrap())
}

/// Compilers that are installed.
fn compilers() -> Result<Vec<&'static str>, Missing> {
    tool("gcc", "")?;
    Ok(["gcc", "clang"].into_iter().filter(|compiler| tool(compiler, "").is_ok()).collect())
}

/// Checks that compilation or the self-test fails for options that break the checks of numbers, or
/// the order of sums. Without optimization such options have no effect.
pub(crate) fn finite_math_is_refused() -> Result<(), Missing> {
    let compilers = compilers()?;
    let options: [&[&str]; 4] = [
        &["-ffast-math"],
        &["-ffinite-math-only"],
        &["-funsafe-math-optimizations"],
        &["-fassociative-math", "-fno-signed-zeros", "-fno-trapping-math"],
    ];
    for spec in shipped() {
        for real in Real::ALL {
            let folder = tempfile::tempdir().unwrap();
            let language = Language::C(real);
            write_files(folder.path(), language.files_of(&spec, &["compensated"]));
            for compiler in &compilers {
                let levels = if thorough() { &["-O1", "-O2", "-O3"][..] } else { &["-O2"] };
                for (level, options) in levels.iter().flat_map(|level| options.map(|o| (level, o))) {
                    assert!(
                        is_refused(folder.path(), &spec.name, compiler, level, options),
                        "{} {real} {compiler} {level} {options:?}",
                        spec.name
                    );
                }
            }
        }
    }
    Ok(())
}

fn is_refused(folder: &Path, name: &str, compiler: &str, level: &str, options: &[&str]) -> bool {
    let program = folder.join("program");
    let mut compile = Command::new(compiler);
    compile.args(["-std=c99", level]).args(options).arg("-o").arg(&program);
    let compiled = compile.args(self_test_sources(folder, name)).arg("-lm").output().unwrap();
    if !compiled.status.success() {
        let errors = String::from_utf8_lossy(&compiled.stderr);
        return errors.contains("#error") || errors.contains("error: \"This code");
    }
    Command::new(&program).status().unwrap().code() != Some(0)
}

/// Changes each coefficient of the sine, and each of its decisions: the self-test fails.
pub(crate) fn a_broken_sine_is_found() -> Result<(), Missing> {
    tool("gcc", "")?;
    let spec = shipped().next().unwrap();
    for real in Real::ALL {
        let folder = tempfile::tempdir().unwrap();
        write(folder.path(), &spec, real);
        let source = folder.path().join(format!("{}.c", spec.name));
        let text = fs::read_to_string(&source).unwrap();
        let mut changed = Vec::new();
        for (begin, _) in text.match_indices("static void sin_cos") {
            let end = begin + text[begin..].find("\n}\n").unwrap();
            // Processors without vectors take the other branch.
            let end = begin + text[begin..end].find("#else").unwrap_or(end - begin);
            let mut at = begin;
            for line in text[begin..end].split_inclusive('\n') {
                let after = at + line.len();
                changed.extend(
                    mutants(line).into_iter().map(|mutant| [&text[..at], &mutant, &text[after..]].concat()),
                );
                at = after;
            }
        }
        assert!(changed.len() > 30, "{}", changed.len());
        for mutant in changed {
            fs::write(&source, &mutant).unwrap();
            assert_eq!(self_test(folder.path(), &spec.name, &["gcc", "-w", "-O0"]), 254, "{real}: {mutant}");
        }
    }
    Ok(())
}

/// Returns a line with other coefficients, quadrants or signs. Parts of π/2 that no angle of the
/// range can tell are left alone.
fn mutants(line: &str) -> Vec<String> {
    // Of the highest powers in single precision, 1 % is less than a rounding error.
    let factor = if line.contains("f;") { 1.2 } else { 1.01 };
    let mut mutants = Vec::new();
    for (name, digits) in [("z * s + ", 14), ("z * c + ", 14), ("z * ", 14), ("turns * ", 14), ("s = ", 4)] {
        let Some((before, number)) = line.split_once(name) else { continue };
        let end = number.find([';', ' ']).unwrap_or(number.len());
        let (number, rest) = number.split_at(end);
        let plain = number.trim_end_matches('f');
        let Ok(value) = plain.parse::<f64>() else { continue };
        let is_detectable = !(name == "turns * " && value.abs() < 1e-16 || plain == "2.563344e-12");
        if is_detectable {
            let suffix = &number[plain.len()..];
            mutants.push(format!("{before}{name}{:.digits$e}{suffix}{rest}", value * factor));
        }
    }
    for (from, to) in [
        ("!= 0U", "== 0U"),
        ("? -s : s", "? s : s"),
        ("? -c : c", "? c : c"),
        ("*sine = sin", "*sine = cos"),
        ("(odd > 0.5) ? c : s", "s"),
        ("const double sign = 1.0 - ", "const double sign = 1.0 + "),
        ("const float sign = 1.0f - ", "const float sign = 1.0f + "),
    ] {
        if line.contains(from) {
            mutants.push(line.replace(from, to));
        }
    }
    mutants
}

/// Flags that the header names.
fn named_flags(compiler: &str) -> &'static [&'static str] {
    match compiler {
        "gcc" => &["-ffp-contract=off", "-fno-tree-slp-vectorize"],
        _ => &["-ffp-contract=off"],
    }
}

/// Compares the results under optimizations that use fused multiply-add with those without, bit by
/// bit.
pub(crate) fn the_named_flags_hold_the_bits() -> Result<(), Missing> {
    let compilers = compilers()?;
    for spec in shipped() {
        let robot = Interpreter::new(spec.clone());
        let given = configurations(&robot, 100);
        let numbers = |compiler: &[&str]| {
            let folder = tempfile::tempdir().unwrap();
            write(folder.path(), &spec, Real::Double);
            let header = fs::read_to_string(folder.path().join(format!("{}.h", spec.name))).unwrap();
            assert!(named_flags(compiler[0]).iter().all(|flag| header.contains(flag)));
            let found = called(compiler, folder.path(), &robot, Real::Double, &given);
            found.into_iter().map(f64::to_bits).collect::<Vec<_>>()
        };
        let plain = numbers(&["gcc", "-O0"]);
        for compiler in &compilers {
            let all =
                [["-O2", "-mfma"], ["-O3", "-march=native"], ["-O3", "-mfma"], ["-O2", "-march=native"]];
            for options in &all[..if thorough() { 4 } else { 2 }] {
                let command = [&[*compiler][..], options, named_flags(compiler)].concat();
                let differ = numbers(&command).iter().zip(&plain).filter(|(a, b)| a != b).count();
                assert_eq!(differ, 0, "{} {command:?}", spec.name);
            }
        }
    }
    Ok(())
}

/// Gives functions numbers up to the largest ones: a result that is not finite never comes with the
/// status of valid results, and finite results are never refused.
pub(crate) fn huge_arguments() -> Result<(), Missing> {
    tool("gcc", "")?;
    let others =
        [Spec::parse("long.toml", &long_chain()).unwrap(), Spec::read(specs::path("measured")).unwrap()];
    let mut refused = 0;
    for spec in shipped().chain(others) {
        let robot = Interpreter::new(spec.clone());
        let arguments = configurations(&robot, 200).into_iter().enumerate();
        let given: Vec<Vec<f64>> = arguments.map(|(k, given)| huge(k, given, &robot)).collect();
        let folder = tempfile::tempdir().unwrap();
        write(folder.path(), &spec, Real::Double);
        let mut found = called(&["gcc"], folder.path(), &robot, Real::Double, &given).into_iter();
        assert_eq!(found.next(), Some(0.0), "{}: the self-test", spec.name);
        let description = robot.description();
        for _ in &given {
            for function in functions(&robot) {
                let status = found.next().unwrap();
                let len: usize =
                    function.signature().results.iter().map(|array| array.len(description)).sum();
                let results: Vec<f64> = found.by_ref().take(len).collect();
                if status == 0.0 {
                    assert!(
                        results.iter().all(|value| value.is_finite()),
                        "{}: {}",
                        spec.name,
                        function.name()
                    );
                }
                refused += usize::from(status == 1.0);
            }
            for command in abbe::function::COMMANDS {
                let status = found.next().unwrap();
                let results: Vec<f64> = found.by_ref().take(command.results_len(description)).collect();
                let is_valid = status == 0.0 || status >= 4.0;
                assert!(
                    !is_valid || results.iter().all(|value| value.is_finite()),
                    "{}: {status}",
                    spec.name
                );
            }
        }
    }
    assert!(refused > 100, "{refused}");
    Ok(())
}

/// Multiplies a few of the numbers by powers of ten.
fn huge(index: usize, mut given: Vec<f64>, robot: &Interpreter) -> Vec<f64> {
    let powers = [20, 50, 99, 100, 101, 150, 155, 200, 300, 308];
    let factor = 10_f64.powi(powers[index % powers.len()]);
    let description = robot.description();
    let first = description.variables.len();
    let taken =
        first + description.parameters.len() + description.inputs.len() + 12 * description.frames.len();
    for k in 0..=index % 4 {
        let at = if index.is_multiple_of(3) { first } else { 0 };
        let number = &mut given[at + (index * 31 + k * 17) % (taken - at)];
        *number = (*number * factor).clamp(-f64::MAX, f64::MAX);
    }
    given
}
