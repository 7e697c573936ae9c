//! The ROS 2 example: the parts that do not depend on ROS are compiled and run, and bring the real
//! tool to the target.

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;
use std::process::Command;

use abbe::analysis::sampling;
use abbe::{Function, Manipulator};
use abbe_codegen::print::{Language, Real};
use abbe_interpreter::Interpreter;
use abbe_manipulators::SHIPPED;
use abbe_spec::Spec;
use abbe_tests::needs::{Missing, Tests, tool};

/// Joints of `test/check.cpp` in the order of the spec, with their values in m and rad.
const WANTED: [(&str, f64); 6] = [
    ("lateral", 0.5),
    ("vertical", 0.2),
    ("longitudinal", 0.3),
    ("spin", 0.4),
    ("roll", -0.02),
    ("pitch", 0.01),
];

pub(crate) const TESTS: Tests = &[("a_trajectory_is_corrected", a_trajectory_is_corrected)];

fn succeeds(command: &mut Command) -> String {
    let output = command.output().unwrap();
    assert!(output.status.success(), "{command:?}: {}", String::from_utf8_lossy(&output.stderr));
    String::from_utf8(output.stdout).unwrap()
}

fn a_trajectory_is_corrected() -> Result<(), Missing> {
    tool("cc", "")?;
    tool("c++", "")?;
    let folder = tempfile::tempdir().unwrap();
    let at = |name: &str| folder.path().join(name);
    let shipped = SHIPPED.iter().find(|shipped| shipped.name == "pps").unwrap();
    let spec = Spec::parse("pps.toml", shipped.spec).unwrap();
    for file in Language::C(Real::Double).files(&spec) {
        fs::write(at(&file.name), file.text).unwrap();
    }
    let example = Path::new(env!("CARGO_MANIFEST_DIR")).join("../examples/ros2");
    let flags = ["-ffp-contract=off", "-c", "-o"];
    succeeds(Command::new("cc").args(["-std=c99"]).args(flags).arg(at("pps.o")).arg(at("pps.c")));
    succeeds(
        Command::new("c++")
            .args(["-std=c++17", "-Wall", "-Wextra", "-Wpedantic", "-Wconversion", "-Werror"])
            .arg("-I")
            .arg(folder.path())
            .arg("-I")
            .arg(example.join("src"))
            .args([example.join("src/machine.cpp"), example.join("test/check.cpp"), at("pps.o")])
            .args(["-lm", "-o"])
            .arg(at("check")),
    );
    let printed = succeeds(&mut Command::new(at("check")));
    let corrected: BTreeMap<&str, f64> = printed
        .lines()
        .filter_map(|line| line.split_once(' '))
        .map(|(name, value)| (name, value.parse().unwrap()))
        .collect();
    let machine = Interpreter::new(spec);
    let s = sampling::nominal_parameters(machine.description());
    let u = sampling::nominal_inputs(machine.description());
    // Values in mm and rad.
    let scale = |i: usize| if i < 3 { 1e3 } else { 1.0 };
    let wanted: Vec<f64> = WANTED.iter().enumerate().map(|(i, (_, value))| value * scale(i)).collect();
    let given: Vec<f64> =
        WANTED.iter().enumerate().map(|(i, (name, _))| corrected[name] * scale(i)).collect();
    let off = |q: &[f64]| {
        let ideal = machine.pose(&wanted, &s).unwrap().0[3];
        let real = machine.evaluate_unchecked(Function::RealPose, &[q, &s, &u].concat()).unwrap();
        (0..3).map(|i| (ideal[i] - real[9 + i]).powi(2)).sum::<f64>().sqrt()
    };
    assert!(off(&wanted) > 1.0, "there is something to correct: {} mm", off(&wanted));
    assert!(off(&given) < 1e-3, "{} mm are left", off(&given));
    Ok(())
}
