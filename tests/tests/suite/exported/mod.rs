//! Exports of an identified machine: each is read back independently and compared with the machine.
//!
//! `closed` covers machines with closed loops, `dh` DH tables, `urdf` robot descriptions and
//! calibrations, `slides` tables of machines with linear axes, `trunnion` those of a machine with
//! rotary axes that carry the workpiece.

mod closed;
mod dh;
mod slides;
mod trunnion;
mod urdf;

use abbe::analysis::{Workspace, random_joint_samples, sampling};
use abbe::{Manipulator, Pose, drawn_pose, repeatable_magnitudes};
use abbe_interpreter::Interpreter;
use abbe_manipulators::SHIPPED;
use abbe_spec::Spec;
use abbe_study::Machine;
use abbe_study::export::{Export, FORMATS, Format, Needs, Report, SAMPLES};
use nalgebra::{Isometry3, Matrix4, Translation3, UnitQuaternion, Vector3};

/// Returns a shipped spec with additional sources.
pub(crate) fn machine(name: &str, sources: &str) -> Machine {
    let shipped = SHIPPED.iter().find(|shipped| shipped.name == name).unwrap();
    let text = format!("{}\n{sources}", shipped.spec);
    Machine::of_spec(Spec::parse(&format!("{name}.toml"), &text).unwrap(), name)
}

#[test]
fn every_format_is_named_wherever_formats_are() {
    let root = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    for (file, quotes) in [
        ("docs/export.md", ["--to ", ""]),
        ("docs/python.md", ["`\"", "\"`"]),
        ("docs/reference/command.md", ["- ", ":"]),
        ("python/src/exchange.rs", ["\"", "\""]),
    ] {
        let text = std::fs::read_to_string(root.join(file)).unwrap();
        // The documentation alone, not the code.
        let text = match file.ends_with(".rs") {
            true => text.lines().filter(|line| line.trim_start().starts_with("///")).collect::<String>(),
            false => text,
        };
        for format in FORMATS {
            let [before, behind] = quotes;
            let name = format!("{before}{}{behind}", format.name);
            let mut ends = text.match_indices(&name).map(|(at, _)| text[at + name.len()..].chars().next());
            let is_whole =
                |next: Option<char>| next.is_none_or(|next| !next.is_alphanumeric() && next != '-');
            assert!(ends.any(is_whole), "{file} does not name {}", format.name);
        }
    }
    for format in FORMATS {
        let ends = abbe_study::export::Ends { base: None, tip: None };
        let robot = (format.needs == Needs::NominalRobot).then(|| "robot.urdf".into());
        let nodes = (format.needs == Needs::Nodes).then_some(5);
        let chosen = Format::choose(format.name, robot, ends, nodes);
        assert!(chosen.is_ok(), "{}", format.name);
    }
}

pub(crate) fn exported(machine: &Machine, format: Format) -> Report {
    Export { machine: machine.clone(), format, samples: SAMPLES, seed: 0 }.run(&mut ()).unwrap()
}

/// Returns the largest position and rotation difference between a model and the real tool, at other
/// configurations than those of the report.
pub(crate) fn difference(machine: &Machine, model: impl Fn(&[f64]) -> Matrix4<f64>) -> [f64; 2] {
    let arm = Interpreter::new(machine.spec.clone());
    let description = arm.description();
    let moved: Vec<usize> = (0..description.variables.len()).collect();
    let workspace = random_joint_samples(&arm, &moved, 300, 7).unwrap();
    let magnitudes = repeatable_magnitudes(description);
    let s = sampling::nominal_parameters(description);
    let u = sampling::nominal_inputs(description);
    let mut largest = [0.0_f64; 2];
    for index in 0..workspace.len() {
        let q = workspace.configuration(index).unwrap().q;
        let real = matrix(&drawn_pose(&arm, &q, &s, &u, &magnitudes).unwrap());
        let model = model(&q);
        let shift = (real - model).fixed_view::<3, 1>(0, 3).norm();
        let turn = (real - model).fixed_view::<3, 3>(0, 0).norm() / 2_f64.sqrt();
        largest = [largest[0].max(shift), largest[1].max(turn)];
    }
    largest
}

pub(crate) fn matrix(pose: &Pose) -> Matrix4<f64> {
    let rows = pose.rows();
    Matrix4::from_fn(|i, j| rows[i][j])
}

pub(crate) fn about(axis: Vector3<f64>, turn: f64, along: f64) -> Isometry3<f64> {
    let axis = nalgebra::Unit::new_normalize(axis);
    Isometry3::from_parts(
        Translation3::from(axis.into_inner() * along),
        UnitQuaternion::from_axis_angle(&axis, turn),
    )
}
