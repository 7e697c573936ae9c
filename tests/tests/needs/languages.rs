//! Code generated for JavaScript, NumPy and Octave equals Rust to 1e-13 of the largest number of a
//! result: every function of every shipped robot, of a long chain, of loops, and of a robot with
//! names that have a meaning in these languages. Compensated commands are equal to 1e-9 of a metre
//! or a rad.
//!
//! `PYTHON` names a Python that has NumPy, if `python3` has none. Octave is slow and evaluates 20
//! configurations; `CONFIGURATIONS=1000` sets the number for all.

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;
use std::process::{Command, Stdio};

use abbe::function::{Array, COMMANDS, Signature};
use abbe::{Function, Manipulator};
use abbe_codegen::print::{Language, SourceFile};
use abbe_interpreter::Interpreter;
use abbe_manipulators::SHIPPED;
use abbe_spec::Spec;
use abbe_tests::chains::{coupled_joints, long_chain};
use abbe_tests::languages::{NAMES, compare, configurations, given_arrays, open_linkage};
use abbe_tests::mutants::{Mutant, WITHOUT_EFFECT, mutants};
use abbe_tests::needs::{Missing, Tests, python, succeeds_in_time, tool};
use abbe_tests::{is_tested, specs};
use serde_json::{Value, json};

use crate::random_loops::random_loops;

pub(crate) const TESTS: Tests = &[
    ("javascript", (|| in_all(Language::JavaScript, 1000))),
    ("python", (|| in_all(Language::Python, 1000))),
    ("octave", (|| in_all(Language::Matlab, 20))),
    ("types_of_javascript", types_of_javascript),
    ("refusals_of_javascript", refusals_of_javascript),
    ("mutants_in_javascript", (|| mutants_of(Language::JavaScript))),
    ("mutants_in_python", (|| mutants_of(Language::Python))),
    ("mutants_in_octave", (|| mutants_of(Language::Matlab))),
];

/// Largest difference relative to the largest number of a result.
const EQUAL: f64 = 1e-13;
/// Largest relative difference of random loops, which may be nearly singular.
const NEARLY_EQUAL: f64 = 1e-9;

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
    for name in ["linkage", "planar"] {
        assert_equal(language, &command, Spec::read(specs::path(name)).unwrap(), few);
    }
    for (spec, given) in random_loops(2) {
        let (file, robot) = (language.files(&spec).remove(0), Interpreter::new(spec));
        let worst = compare_source(language, &command, &robot, &file, &given, NEARLY_EQUAL).unwrap();
        println!("{}: {worst:e}", robot.description().name);
    }
    assert_open_loops_are_nan(language, &command);
    assert_equal(language, &command, Spec::parse("names.toml", NAMES).unwrap(), few);
    Ok(())
}

/// TypeScript reads the types of arguments and results from the comments, and refuses others.
fn types_of_javascript() -> Result<(), Missing> {
    let modules = std::env::var("NODE_PATH").unwrap_or_default();
    let compiler = Path::new(&modules).join(".bin/tsc");
    tool(&compiler.display().to_string(), "")?;
    let folder = tempfile::tempdir().unwrap();
    for shipped in SHIPPED.iter().filter(|shipped| is_tested(shipped.name)) {
        let spec = Spec::parse(&format!("{}.toml", shipped.name), shipped.spec).unwrap();
        fs::write(folder.path().join("machine.js"), Language::JavaScript.files(&spec).remove(0).text)
            .unwrap();
        let compiles = |line: &str| {
            let text = format!(
                "import {{ compensated, error_jacobian, pose, description }} from './machine.js';\n\
                 const [q, s, u] = [description.variables, description.parameters, description.inputs].map((list) => new Float64Array(list.length));\n\
                 {line}\n"
            );
            fs::write(folder.path().join("user.ts"), text).unwrap();
            let mut run = Command::new(&compiler);
            run.args(["--strict", "--noEmit", "--allowJs", "--checkJs", "false", "--target", "es2020"]);
            run.args(["--module", "es2020", "--moduleResolution", "bundler", "user.ts"])
                .current_dir(folder.path());
            let output = run.output().unwrap();
            (output.status.success(), String::from_utf8_lossy(&output.stdout).into_owned())
        };
        for right in [
            "const tool: Float64Array = pose(q, s); tool[9].toFixed();",
            "const { columns }: { columns: Float64Array } = error_jacobian(q, s); columns.length;",
            "const { corrected, status } = compensated(q, s, u); corrected[0] * status;",
            "compensated(q, s, u, q, q, q, new Float64Array(3)).after.length;",
        ] {
            let (compiles, said) = compiles(right);
            assert!(compiles, "{}: {right}: {said}", spec.name);
        }
        for wrong in [
            "pose(q);",
            "pose('q', s);",
            "pose(q, s).columns;",
            "const status: string = compensated(q, s, u).status;",
            "compensated(q, s, u).corected;",
        ] {
            assert!(!compiles(wrong).0, "{}: {wrong}", spec.name);
        }
    }
    Ok(())
}

/// Every function of JavaScript refuses arguments of another length, numbers that are not finite
/// and inputs outside their ranges.
fn refusals_of_javascript() -> Result<(), Missing> {
    tool("node", "")?;
    let folder = tempfile::tempdir().unwrap();
    let spec = SHIPPED.iter().find(|shipped| shipped.name == "pps").unwrap();
    let spec = Spec::parse("pps.toml", spec.spec).unwrap();
    fs::write(folder.path().join("pps.mjs"), Language::JavaScript.files(&spec).remove(0).text).unwrap();
    let robot = Interpreter::new(spec);
    let exported = Function::all(robot.description()).map(Function::signature).chain(COMMANDS);
    let functions: BTreeMap<&str, Vec<(&str, usize)>> = exported
        .map(|signature| {
            let given = signature
                .arguments
                .iter()
                .filter(|array| !matches!(array.name, "last" | "change" | "largest"));
            (signature.name, given.map(|array| (array.name, array.len(robot.description()))).collect())
        })
        .collect();
    let script = format!(
        "import * as pps from './pps.mjs';\n\
         const nominal = {{ q: pps.description.variables.map((one) => one.home), s: pps.description.parameters.map((one) => one.nominal), \
         u: pps.description.inputs.map((one) => one.nominal), rotations: [1, 1, 1] }};\n\
         let count = 0;\n\
         for (const [name, given] of Object.entries({})) {{\n\
             const order = pps[name].length && given;\n\
             const right = order.map(([own, len]) => Float64Array.from(nominal[own] ?? Array(len).fill(0.5)));\n\
             const call = (list) => name === 'compensated' ? pps[name](...list.slice(0, 3), undefined, undefined, undefined, list[3]) : pps[name](...list);\n\
             call(right);\n\
             right.forEach((array, k) => {{\n\
                 const changed = (edit) => right.map((own, i) => (i === k ? edit(own) : own));\n\
                 const wrong = [(own) => own.slice(1), () => undefined, (own) => own.map(() => NaN), (own) => own.map(() => Infinity)];\n\
                 if (given[k][0] === 'u') wrong.push((own) => own.map(() => -1e9));\n\
                 for (const edit of wrong) {{\n\
                     if (given[k][0] === 'rotations' && edit(array) === undefined) continue;\n\
                     try {{ call(changed(edit)); }} catch (error) {{ if (error instanceof RangeError) {{ count++; continue; }} }}\n\
                     throw new Error(`${{name}} takes a wrong ${{given[k][0]}}`);\n\
                 }}\n\
             }});\n\
         }}\n\
         console.log(count);\n",
        json!(functions)
    );
    fs::write(folder.path().join("run.mjs"), script).unwrap();
    let output = Command::new("node").arg("run.mjs").current_dir(folder.path()).output().unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let count: usize = String::from_utf8_lossy(&output.stdout).trim().parse().unwrap();
    println!("{count} wrong arguments in {} functions", functions.len());
    assert!(count > 8 * functions.len(), "{count}");
    Ok(())
}

/// Returns the command that runs a script of the language.
pub(crate) fn command(language: Language) -> Result<Vec<String>, Missing> {
    let words = |words: &[&str]| words.iter().map(|word| (*word).to_owned()).collect();
    match language {
        Language::JavaScript => tool("node", "").map(|_| words(&["node"])),
        Language::Python => python("numpy").map(|python| words(&[&python])),
        Language::Matlab => tool("octave", "").map(|_| words(&["octave", "--no-gui", "--quiet", "--norc"])),
        other => panic!("no command runs {other:?}"),
    }
}

/// Returns the interface that scripts of other languages call: the arguments with their shapes, and
/// the name, arguments, results and margin of every function.
pub(crate) fn called(robot: &dyn Manipulator) -> Value {
    let description = robot.description();
    let shape = |array: &Array| array.shape.iter().map(|count| count.value(description)).collect::<Vec<_>>();
    let arrays = given_arrays();
    let arrays = arrays.iter().map(|array| json!({ "name": array.name, "shape": shape(array) }));
    let names = |arrays: &[Array]| arrays.iter().map(|array| array.name).collect::<Vec<_>>();
    let one = |signature: &Signature, behind: Option<&'static str>| {
        let results: Vec<_> = names(signature.results).into_iter().chain(behind).collect();
        json!([signature.name, names(signature.arguments), results])
    };
    let functions = Function::all(description)
        .map(Function::signature)
        .map(|signature| one(signature, signature.has_margin(description.orientation).then_some("margin")));
    let functions = functions.chain(COMMANDS.map(|command| one(command, Some("status"))));
    json!({ "arrays": arrays.collect::<Vec<_>>(), "functions": functions.collect::<Vec<_>>() })
}

/// Compares `count` configurations with Rust.
fn assert_equal(language: Language, command: &[String], spec: Spec, count: usize) {
    let (name, file) = (spec.name.clone(), language.files(&spec).remove(0));
    let robot = Interpreter::new(spec);
    let given = configurations(&robot, count);
    let worst = compare_source(language, command, &robot, &file, &given, EQUAL).unwrap();
    println!("{name}: {worst:e} in {count} configurations");
}

/// Checks that passive variables are NaN where the loops do not close.
fn assert_open_loops_are_nan(language: Language, command: &[String]) {
    let spec = Spec::read(specs::path("linkage")).unwrap();
    let file = language.files(&spec).remove(0);
    let robot = Interpreter::new(spec);
    let mut called = called(&robot);
    called["functions"].as_array_mut().unwrap().retain(|function| function[0] == "passive");
    let given = [open_linkage(&robot)];
    let found = results(language, command, &called, &file, &given).unwrap();
    assert!(found.len() == 3 && found.iter().all(|value| value.is_nan()), "{found:?}");
}

/// Runs a source and compares its results with Rust, to a share of the largest number of a result.
/// Returns the largest difference, or what is wrong.
fn compare_source(
    language: Language,
    command: &[String],
    robot: &Interpreter,
    file: &SourceFile,
    given: &[Vec<f64>],
    share: f64,
) -> Result<f64, String> {
    let found = results(language, command, &called(robot), file, given)?;
    let evaluate = |function: Function, given: &[f64]| robot.evaluate_unchecked(function, given).unwrap();
    compare(robot, evaluate, given, &found, share)
}

/// Runs a source and returns the results of all functions that are called, one configuration after
/// the other, or its error messages.
fn results(
    language: Language,
    command: &[String],
    called: &Value,
    file: &SourceFile,
    given: &[Vec<f64>],
) -> Result<Vec<f64>, String> {
    let folder = tempfile::tempdir().unwrap();
    let script = match language {
        Language::JavaScript => "run.mjs",
        Language::Python => "run.py",
        Language::Matlab => "run.m",
        other => panic!("no script runs {other:?}"),
    };
    let source = folder.path().join(if language == Language::JavaScript { "module.mjs" } else { &file.name });
    let [input, output, functions] = ["input", "output", "functions"].map(|name| folder.path().join(name));
    fs::write(&source, &file.text).unwrap();
    fs::write(&input, given.concat().iter().flat_map(|value| value.to_ne_bytes()).collect::<Vec<u8>>())
        .unwrap();
    fs::write(&functions, called.to_string()).unwrap();
    let script = Path::new(env!("CARGO_MANIFEST_DIR")).join("languages").join(script);
    let errors = folder.path().join("errors");
    let mut run = Command::new(&command[0]);
    run.args(&command[1..]).arg(script).args([&source, &functions, &input, &output]);
    run.stdin(Stdio::null()).stdout(Stdio::null()).stderr(fs::File::create(&errors).unwrap());
    if !succeeds_in_time(&mut run) {
        return Err(format!("{}: {}", file.name, fs::read_to_string(&errors).unwrap()));
    }
    let bytes = fs::read(&output).unwrap();
    Ok(bytes.chunks_exact(8).map(|bytes| f64::from_ne_bytes(bytes.try_into().unwrap())).collect())
}

/// Checks that the comparison finds every mutant of a source: one of each kind in each function in
/// a thorough run, and a tenth of them otherwise. Functions that all sources share are mutated for
/// three joints and for six, which take different branches; one of the two has to tell.
fn mutants_of(language: Language) -> Result<(), Missing> {
    let command = command(language)?;
    let six_joints = SHIPPED.iter().find(|shipped| shipped.name == "pps").unwrap();
    let six_joints = Spec::parse("pps.toml", six_joints.spec).unwrap();
    let survivors = |spec: &Spec, is_mutated: &dyn Fn(&str) -> bool| {
        let file = language.files(spec).remove(0);
        let robot = Interpreter::new(spec.clone());
        // Octave is slow.
        let given = configurations(&robot, if language == Language::Matlab { 8 } else { 40 });
        let all = mutants(&file.text, 1, is_mutated);
        let chosen: Vec<&Mutant> = all.iter().filter(|mutant| mutant.is_tried("")).collect();
        println!("{}: {} mutants in {}", spec.name, chosen.len(), language.name());
        let survives = |mutant: &&Mutant| {
            let file = SourceFile { name: file.name.clone(), text: mutant.text.clone() };
            compare_source(language, &command, &robot, &file, &given, EQUAL).is_ok()
        };
        let named = |Mutant { function, kind, line, .. }: &Mutant| ((function.clone(), *kind), line.clone());
        chosen.into_iter().filter(|mutant| survives(mutant)).map(named).collect::<BTreeMap<_, _>>()
    };
    let measured = Spec::read(specs::path("measured")).unwrap();
    let is_own =
        |name: &str| Function::ALL.iter().any(|function| function.name() == name.trim_start_matches('_'));
    let is_shared =
        |name: &str| !is_own(name) && !matches!(name.trim_start_matches('_'), "given" | "are_given");
    let own = survivors(&measured, &is_own);
    assert!(own.is_empty(), "{own:#?}");
    let [three, mut six] = [&measured, &six_joints].map(|spec| survivors(spec, &is_shared));
    let is_equal = |(function, kind): &(String, &'static str)| {
        let mutant = (function.trim_start_matches('_'), *kind);
        // In Python `ideal[k - 6]` of twelve numbers is `ideal[k + 6]`.
        let is_wrapped = language == Language::Python && mutant == ("deviation", "sum");
        WITHOUT_EFFECT.contains(&mutant) || is_wrapped
    };
    six.retain(|mutant, _| three.contains_key(mutant) && !is_equal(mutant));
    assert!(six.is_empty(), "{six:#?}");
    Ok(())
}
