//! Compares the outputs of FMUs with the command and the interpreter.

use std::collections::HashMap;
use std::fs;
use std::path::Path;

use abbe::compensator::{Cycle, Status, compensate};
use abbe::{Class, Function, Manipulator, Pose, VariableKind};
use abbe_interpreter::Interpreter;
use abbe_spec::{MAGNITUDE, Spec};
use abbe_tests::languages::{arguments, configurations};
use serde_json::{Value, json};

use super::{abbe, script, unit};

/// Values set in one run of a unit.
struct Row {
    q: Vec<f64>,
    u: Vec<f64>,
    /// Magnitude of each enabled source relative to the spec; 0 for random sources.
    magnitudes: Vec<f64>,
    s: Vec<f64>,
}

/// Number of rows with nominal inputs, parameters and magnitudes, and number of rows with others.
const EACH: usize = 30;

/// Number of rows compared with the command itself.
const BY_COMMAND: usize = 5;

fn rows(robot: &Interpreter, classes: &[Class]) -> Vec<Row> {
    let given = configurations(robot, 2 * EACH);
    let row = |(index, given): (usize, &Vec<f64>)| {
        let u = arguments(robot, Function::RealPose.signature(), given);
        let (q, rest) = u.split_at(robot.description().variables.len());
        let (s, u) = rest.split_at(robot.description().parameters.len());
        let nominal: Vec<f64> = robot.description().inputs.iter().map(|input| input.nominal).collect();
        let u = if index < EACH { &nominal } else { u };
        let drawn = arguments(robot, Function::DrawnPose.signature(), given);
        let drawn = &drawn[drawn.len() - classes.len()..];
        let magnitude = |(class, drawn): (&Class, &f64)| match class {
            Class::Tolerance(_) | Class::Random(_) => 0.0,
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

/// Asserts that the unit agrees with the command and the interpreter to 1e-12, by co-simulation and
/// by model exchange; corrected commands to 1e-9, as in C.
pub(super) fn assert_agreement(python: &str, compiler: &str, version: &str, machine: &str, spec: Spec) {
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

/// Compares ΔX and pose with the output of the command.
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

/// Compares all outputs with the interpreter: ΔX source by source, the real pose as a drawn pose.
fn assert_row(place: &str, robot: &Interpreter, row: &Row, found: &HashMap<&str, f64>) {
    let Row { q, u, magnitudes, s } = row;
    let description = robot.description();
    let of =
        |function, arguments: &[&[f64]]| robot.evaluate_unchecked(function, &arguments.concat()).unwrap();
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
    let cycle = Cycle::<[f64; 0]>::UNBOUNDED;
    let corrected = compensate(
        description,
        &as_pose(&ideal),
        q,
        &cycle,
        vec![[0.0; 6]; q.len()],
        |q: &Vec<f64>, columns| {
            let step = of(Function::CompensatorStep, &[q, s, u]);
            columns.as_flattened_mut().copy_from_slice(&step[12..]);
            Ok(as_pose(&real(q)))
        },
    );
    let corrected = corrected.unwrap();
    assert_eq!(found["correction"], f64::from(corrected.status.code()), "{place}");
    let metre = 1.0 / description.length.in_metres();
    // Where the pose is not reached, a singular pose amplifies rounding errors.
    let tolerance = if corrected.status == Status::Reached { 1e-9 } else { 1e-6 };
    for (variable, expected) in description.variables.iter().zip(corrected.q) {
        let unit = if variable.kind == VariableKind::Revolute { 1.0 } else { metre };
        let number = found[&*format!("corrected.{}", variable.name)];
        assert!(
            (number - expected).abs() <= tolerance * unit,
            "{place} {}: {number} and {expected}",
            variable.name
        );
    }
}

/// Asserts agreement to 1e-12 relative to `size`, the size of the summands.
fn assert_near(place: &str, name: &str, found: &HashMap<&str, f64>, expected: f64, size: f64) {
    let number = found[name];
    assert!((number - expected).abs() <= 1e-12 * size, "{place} {name}: {number} and {expected}");
}
