//! Functional mock-up units are valid, compile without a warning, and give what the command gives: FMPy simulates all of them.
//!
//! `PYTHON` names a Python that has FMPy, if `python3` has none.

use std::collections::HashMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, ExitCode, Output};

use abbe::compensator::compensate;
use abbe::{Class, Function, Manipulator, Pose, VariableKind};
use abbe_codegen::print::{Fmi, Language};
use abbe_codegen::spec::{MAGNITUDE, Spec};
use abbe_interpreter::Interpreter;
use abbe_manipulators::SHIPPED;
use abbe_tests::chains::long_chain;
use abbe_tests::languages::{NAMES, arguments, configurations};
use abbe_tests::needs::{Missing, python, run, tool};
use abbe_tests::specs;
use serde_json::{Value, json};
use tempfile::TempDir;

fn main() -> ExitCode {
    run([
        ("shipped_robots_compiled_by_cc", (|| shipped_robots("cc", &["2", "3"])) as _),
        ("shipped_robots_compiled_by_fmpy", shipped_robots_compiled_by_fmpy as _),
        ("others", others as _),
        ("what_is_wrong_is_said", what_is_wrong_is_said as _),
        ("the_chapter_says_what_happens", the_chapter_says_what_happens as _),
        ("several_machines_in_one_program", several_machines_in_one_program as _),
    ])
}

/// A spec without joints, where nothing can be corrected; two of its sources are the same to an identifier, and there is text that XML
/// cannot hold as it is.
const FIXED: &str = "[manipulator]\nname = \"fixed\"\nlength = \"m\"\ndescription = \"\\u0001 & <b>\"\n\
                     [inputs]\nheat = { value = \"1 K\", range = [\"0 K\", \"9 K\"], description = \"\\u0001 \\\"<\\n&\" }\n\
                     [[frame]]\nname = \"only\"\ntransform = \"Tz(1)\"\n[[source]]\nname = \"growth & <heat>\"\nclass = \"repeatable\"\n\
                     frame = \"only\"\ne_x = \"2e-5 m/K * heat\"\n\
                     [[source]]\nname = \"growth / [heat]\"\nclass = \"repeatable\"\nframe = \"only\"\ne_z = \"1e-5 m/K * heat\"\n\
                     magnitude = { value = 2 }\n";

fn shipped_robots(compiler: &str, versions: &[&str]) -> Result<(), Missing> {
    let python = found(compiler)?;
    for shipped in SHIPPED {
        let spec = Spec::parse(&format!("{}.toml", shipped.name), shipped.spec).unwrap();
        for version in versions {
            assert_alike(&python, compiler, version, shipped.name, spec.clone());
        }
    }
    Ok(())
}

/// Half of them by each version: CMake takes its time.
fn shipped_robots_compiled_by_fmpy() -> Result<(), Missing> {
    let python = found("fmpy")?;
    for (shipped, version) in SHIPPED.iter().zip(["3", "2"].into_iter().cycle()) {
        let spec = Spec::parse(&format!("{}.toml", shipped.name), shipped.spec).unwrap();
        assert_alike(&python, "fmpy", version, shipped.name, spec);
    }
    Ok(())
}

/// A long chain, tables, words of languages, and nothing that moves.
fn others() -> Result<(), Missing> {
    let python = found("cc")?;
    let folder = tempfile::tempdir().unwrap();
    let written = [("long", long_chain()), ("names", NAMES.to_owned()), ("fixed", FIXED.to_owned())];
    let written = written.map(|(name, text)| {
        let path = folder.path().join(format!("{name}.toml"));
        fs::write(&path, text).unwrap();
        path
    });
    for path in written.into_iter().chain([specs::path("measured")]) {
        assert_alike(&python, "cc", "3", path.to_str().unwrap(), Spec::read(&path).unwrap());
    }
    Ok(())
}

/// Values that cannot be, and a description of another machine.
fn what_is_wrong_is_said() -> Result<(), Missing> {
    let python = found("cc")?;
    let folder = tempfile::tempdir().unwrap();
    let spec = folder.path().join("fixed.toml");
    fs::write(&spec, FIXED).unwrap();
    for version in ["2", "3"] {
        let unit = unit(&folder, version, spec.to_str().unwrap(), "fixed");
        let said = script(&python, "refuse.py", &[&unit]);
        assert!(said.status.success(), "{}", String::from_utf8_lossy(&said.stderr));
    }
    Ok(())
}

/// Names that begin with the machine's do not meet, of neither version.
fn several_machines_in_one_program() -> Result<(), Missing> {
    tool("cc", "")?;
    let folder = tempfile::tempdir().unwrap();
    let mut objects = Vec::new();
    let mut main = "#include <stdio.h>\n".to_owned();
    let mut calls = String::new();
    for (name, fmi) in [("ur5", Fmi::Three), ("scara", Fmi::Three), ("stanford", Fmi::Two), ("wam", Fmi::Two)]
    {
        let shipped = SHIPPED.iter().find(|shipped| shipped.name == name).unwrap();
        let spec = Spec::parse(name, shipped.spec).unwrap();
        let at = folder.path().join(name);
        fs::create_dir(&at).unwrap();
        for file in Language::Fmu(fmi).files(&spec) {
            if let Some(source) = file.name.strip_prefix("sources/") {
                fs::write(at.join(source), file.text).unwrap();
            }
        }
        let fmi = fmi.name();
        let prefix = format!("-DFMI{fmi}_FUNCTION_PREFIX={name}_");
        for source in [format!("{name}.c"), format!("fmi-{fmi}.c")] {
            let object = folder.path().join(format!("{name}-{source}.o"));
            succeeds(Command::new("cc").args(["-c", &prefix, "-o"]).arg(&object).arg(at.join(source)));
            objects.push(object);
        }
        let function = format!("{name}_fmi{fmi}GetVersion");
        main += &format!("const char *{function}(void);\n");
        calls += &format!("    puts({function}());\n");
    }
    let [source, program] = ["main.c", "main"].map(|name| folder.path().join(name));
    fs::write(&source, format!("{main}int main(void)\n{{\n{calls}    return 0;\n}}\n")).unwrap();
    succeeds(Command::new("cc").arg("-o").arg(&program).arg(&source).args(&objects).arg("-lm"));
    assert_eq!(succeeds(&mut Command::new(&program)), "3.0\n3.0\n2.0\n2.0\n");
    Ok(())
}

/// What `docs/fmu.md` does with Python prints what stands there.
fn the_chapter_says_what_happens() -> Result<(), Missing> {
    let python = found("fmpy")?;
    let page = Path::new(env!("CARGO_MANIFEST_DIR")).join("../docs/fmu.md");
    let page = fs::read_to_string(page).unwrap();
    let blocks = page.split("```").skip(1).step_by(2).filter_map(|block| block.split_once('\n'));
    let folder = tempfile::tempdir().unwrap();
    let mut count = 0;
    for (language, block) in blocks {
        match language {
            "console" => {
                let line = block.lines().next().unwrap().strip_prefix("$ abbe ").unwrap();
                let run = Command::new(env!("CARGO_BIN_EXE_abbe"))
                    .args(line.split(' '))
                    .current_dir(&folder)
                    .output();
                assert!(run.unwrap().status.success(), "{line}");
            }
            "sh" => {
                for command in block.split("$ ").skip(1) {
                    let (line, expected) = command.split_once('\n').unwrap();
                    let line = line.replace("python ", &format!("'{python}' "));
                    let printed = succeeds(in_folder("sh", &python, &folder).args(["-c", &line]));
                    assert!(printed.contains(expected), "{line}: {printed}");
                    count += 1;
                }
            }
            "python" => {
                fs::write(folder.path().join("block.txt"), block).unwrap();
                succeeds(in_folder(&python, &python, &folder).args(["-m", "doctest", "block.txt"]));
                count += 1;
            }
            _ => {}
        }
    }
    assert_eq!(count, 8);
    Ok(())
}

/// A program in a folder; CMake, which may be one of Python's packages, is found.
fn in_folder(program: &str, python: &str, folder: &TempDir) -> Command {
    let mut command = Command::new(program);
    let beside = Path::new(python).parent().unwrap_or(Path::new("")).to_owned();
    let path = std::env::var_os("PATH").unwrap_or_default();
    let all = std::iter::once(beside).chain(std::env::split_paths(&path));
    command.env("PATH", std::env::join_paths(all).unwrap()).current_dir(folder);
    command
}

fn succeeds(command: &mut Command) -> String {
    let Output { status, stdout, stderr } = command.output().unwrap();
    let printed = String::from_utf8_lossy(&stdout).into_owned();
    assert!(status.success(), "{printed}{}", String::from_utf8_lossy(&stderr));
    printed
}

/// The Python that simulates, if all is there.
fn found(compiler: &str) -> Result<String, Missing> {
    tool("cc", "")?;
    match compiler {
        // CMake is one of Python's packages.
        "fmpy" => python("fmpy, cmake"),
        _ => python("fmpy"),
    }
}

fn script(python: &str, name: &str, arguments: &[&Path]) -> Output {
    let script = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/fmu").join(name);
    Command::new(python).arg("-B").arg(script).args(arguments).output().expect("Python has just run")
}

fn abbe(arguments: &[&str]) -> Vec<u8> {
    let output = Command::new(env!("CARGO_BIN_EXE_abbe")).args(arguments).output().unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    output.stdout
}

/// What the command writes.
fn unit(folder: &TempDir, version: &str, machine: &str, name: &str) -> PathBuf {
    let unit = folder.path().join(format!("{name}.{version}.fmu"));
    abbe(&["generate", machine, "--lang", "fmu", "--fmi", version, "--out", unit.to_str().unwrap()]);
    unit
}

/// One row: what is set.
struct Row {
    q: Vec<f64>,
    u: Vec<f64>,
    /// Of every enabled source in units of that of the spec, 0 of random ones.
    magnitudes: Vec<f64>,
    s: Vec<f64>,
}

/// As many rows as the drawing has it, then as many with other parameters and magnitudes.
const EACH: usize = 30;

/// So many of these are compared with the command itself.
const BY_COMMAND: usize = 5;

fn rows(robot: &Interpreter, classes: &[Class]) -> Vec<Row> {
    let given = configurations(robot, 2 * EACH);
    let row = |(index, given): (usize, &Vec<f64>)| {
        let u = arguments(robot, Function::RealPose, given);
        let (q, rest) = u.split_at(robot.description().variables.len());
        let (s, u) = rest.split_at(robot.description().parameters.len());
        let drawn = &given[given.len() - classes.len()..];
        let magnitude = |(class, drawn): (&Class, &f64)| match class {
            Class::Random(_) => 0.0,
            Class::Repeatable if index < EACH => 1.0,
            Class::Repeatable => *drawn,
        };
        let change = if index < EACH { 1.0 } else { 1.0 + 1e-4 * index as f64 };
        let magnitudes = classes.iter().zip(drawn).map(magnitude).collect();
        let s = s.iter().map(|value| value * change).collect();
        Row { q: q.to_vec(), u: u.to_vec(), magnitudes, s }
    };
    given.iter().enumerate().map(row).collect()
}

/// The unit gives what the command and the interpreter give, to 1e-12, by co-simulation and by model exchange; the
/// corrected commands to 1e-9, as in C.
fn assert_alike(python: &str, compiler: &str, version: &str, machine: &str, spec: Spec) {
    let folder = tempfile::tempdir().unwrap();
    let unit = unit(&folder, version, machine, &spec.name);
    let classes: Vec<Class> = spec.enabled_sources().map(|source| source.class).collect();
    let own = spec.enabled_sources().map(|source| source.magnitude.map_or(1.0, |magnitude| magnitude.value));
    let own: Vec<f64> = own.collect();
    let tunable = spec.with_magnitudes_as_inputs();
    let robot = Interpreter::new(spec);
    let rows = rows(&robot, &classes);

    let description = robot.description();
    let variables = description.variables.iter().map(|variable| format!("q.{}", variable.name));
    let inputs = description.inputs.iter().map(|input| format!("u.{}", input.name));
    let magnitudes = tunable.inputs[description.inputs.len()..].iter();
    let magnitudes =
        magnitudes.map(|input| format!("magnitude.{}", input.name.strip_prefix(MAGNITUDE).unwrap()));
    let parameters = description.parameters.iter().map(|parameter| format!("s.{}", parameter.name));
    let names: Vec<String> = variables.chain(inputs).chain(magnitudes).chain(parameters).collect();
    let set = |row: &Row| -> Vec<f64> {
        let all = row.magnitudes.iter().zip(&own).zip(&classes);
        let repeatable = all.filter(|(_, class)| **class == Class::Repeatable);
        let magnitudes: Vec<f64> = repeatable.map(|((magnitude, own), _)| magnitude * own).collect();
        [&row.q[..], &row.u, &magnitudes, &row.s].concat()
    };
    let given = json!({ "names": names, "rows": rows.iter().map(set).collect::<Vec<_>>() });
    let [input, output] = ["input", "output"].map(|name| folder.path().join(name));
    fs::write(&input, given.to_string()).unwrap();
    let run = script(python, "simulate.py", &[&unit, Path::new(compiler), &input, &output]);
    assert!(run.status.success(), "{machine}: {}", String::from_utf8_lossy(&run.stderr));
    let found: Value = serde_json::from_slice(&fs::read(&output).unwrap()).unwrap();
    for kind in ["CoSimulation", "ModelExchange"] {
        let names: Vec<&str> =
            found[kind][0].as_array().unwrap().iter().map(|name| name.as_str().unwrap()).collect();
        for (k, row) in rows.iter().enumerate() {
            let numbers = found[kind][1][k].as_array().unwrap();
            let found: HashMap<&str, f64> =
                names.iter().copied().zip(numbers.iter().map(|number| number.as_f64().unwrap())).collect();
            let place = format!("{machine} FMI {version} {compiler} {kind} {k}");
            assert_row(&place, &robot, row, &found);
            if k < BY_COMMAND {
                assert_command(&place, machine, row, &found);
            }
        }
    }
}

/// ΔX and pose as the command prints them.
fn assert_command(place: &str, machine: &str, row: &Row, found: &HashMap<&str, f64>) {
    let q: Vec<String> = row.q.iter().map(|value| format!("{value:?}")).collect();
    let q = format!("--q={}", q.join(","));
    let mut arguments = vec!["jacobian", machine, "--json"];
    if !row.q.is_empty() {
        arguments.push(&q);
    }
    let report: Value = serde_json::from_slice(&abbe(&arguments)).unwrap();
    let numbers = |value: &Value| -> Vec<f64> {
        value.as_array().unwrap().iter().map(|number| number.as_f64().unwrap()).collect()
    };
    let errors = numbers(&report["generalized_errors"]);
    for (name, columns) in
        numbers_of_rows(&report).into_iter().zip(report["error_jacobian"].as_array().unwrap())
    {
        let columns = numbers(columns);
        let products = columns.iter().zip(&errors).map(|(column, error)| column * error);
        let size: f64 = products.clone().map(f64::abs).sum();
        assert_near(place, &format!("displacement.{name}"), found, products.sum(), size);
    }
    for (axis, pose) in ["x", "y", "z"].iter().zip(report["pose"].as_array().unwrap()) {
        let pose = numbers(pose);
        assert_near(place, &format!("pose.{axis}"), found, pose[3], pose[3].abs());
    }
}

fn numbers_of_rows(report: &Value) -> Vec<String> {
    report["rows"].as_array().unwrap().iter().map(|name| name.as_str().unwrap().to_owned()).collect()
}

/// All outputs as the interpreter has them: ΔX source by source, the real pose as one that is drawn.
fn assert_row(place: &str, robot: &Interpreter, row: &Row, found: &HashMap<&str, f64>) {
    let Row { q, u, magnitudes, s } = row;
    let description = robot.description();
    let of = |function, arguments: &[&[f64]]| robot.evaluate(function, &arguments.concat()).unwrap();
    let by_source = of(Function::SourceDisplacements, &[q, s, u]);
    for (k, name) in description.orientation.rows().into_iter().enumerate() {
        let products = magnitudes.iter().enumerate().map(|(source, m)| m * by_source[6 * source + k]);
        let size: f64 = products.clone().map(f64::abs).sum();
        assert_near(place, &format!("displacement.{name}"), found, products.sum(), size);
    }
    let real = |q: &[f64]| of(Function::DrawnPose, &[q, s, u, magnitudes]);
    let ideal = of(Function::Pose, &[q, s]);
    for (output, pose) in [("pose", &ideal), ("real_pose", &real(q))] {
        let size = pose.iter().fold(0.0, |size: f64, value| size.max(value.abs()));
        for (k, value) in pose.iter().enumerate() {
            let name = match k {
                9.. => format!("{output}.{}", ["x", "y", "z"][k - 9]),
                _ => format!("{output}.R{}{}", k % 3 + 1, k / 3 + 1),
            };
            assert_near(place, &name, found, *value, size);
        }
    }
    if q.is_empty() {
        return assert!(!found.contains_key("correction"), "{place}");
    }
    let as_pose = |pose: &[f64]| Pose(std::array::from_fn(|i| std::array::from_fn(|j| pose[3 * i + j])));
    let corrected =
        compensate(description, &as_pose(&ideal), q, vec![[0.0; 6]; q.len()], |q: &Vec<f64>, columns| {
            let step = of(Function::CompensatorStep, &[q, s, u]);
            columns.as_flattened_mut().copy_from_slice(&step[12..]);
            Ok(as_pose(&real(q)))
        });
    let corrected = corrected.unwrap();
    assert_eq!(found["correction"], if corrected.converged { 0.0 } else { 4.0 }, "{place}");
    let metre = 1.0 / description.length.in_metres();
    for (variable, expected) in description.variables.iter().zip(corrected.q) {
        let unit = if variable.kind == VariableKind::Revolute { 1.0 } else { metre };
        let number = found[&*format!("corrected.{}", variable.name)];
        assert!(
            (number - expected).abs() <= 1e-9 * unit,
            "{place} {}: {number} and {expected}",
            variable.name
        );
    }
}

/// To 1e-12 of what it is the sum of.
fn assert_near(place: &str, name: &str, found: &HashMap<&str, f64>, expected: f64, size: f64) {
    let number = found[name];
    assert!((number - expected).abs() <= 1e-12 * size, "{place} {name}: {number} and {expected}");
}
