//! URDF descriptions of robots, and calibrations of Universal Robots arms.

use std::path::Path;

use abbe::Manipulator;
use abbe_interpreter::Interpreter;
use abbe_spec::Spec;
use abbe_study::export::{Export, Format};
use abbe_study::{Machine, import};
use nalgebra::{Isometry3, Translation3, UnitQuaternion, Vector3};

use super::{about, difference, exported, machine, matrix};

/// Robot with a lift, an arm with a mimic joint, a fixed mount in the middle, and a camera beside
/// the chain, in every notation of URDF.
const ROBOT: &str = "<?xml version=\"1.0\"?>\r
<!-- The arm of the east cell. -->\r
<robot name=\"arm\">
  <link name=\"base\"/><link name=\"carriage\"/>\t<link name=\"upper\"/>
  <link name=\"mount\"/><link name=\"fore\"/><link name=\"camera\"/><link name=\"wrist\"/><link name=\"tool\"/>
  <joint name=\"lift\" type=\"prismatic\">
    <parent link=\"base\"/><child link=\"carriage\"/>
    <axis xyz=\"0 0 1\"/><limit lower=\"0\" upper=\"0.8\" effort=\"1\" velocity=\"1\"/>   <!-- no origin -->
  </joint>
  <joint type='revolute' name='shoulder'>
    <parent link='carriage'/><child link='upper'/>
    <origin rpy='0.3 0 -1.5708' xyz='0.1   0.00 0.4' />
    <axis xyz='0 0.6 0.8'/><limit lower='-2.6' upper='2.6' effort='1' velocity='1'/>
  </joint>
  <joint name=\"plate\" type=\"fixed\"><parent link=\"upper\"/><child link=\"mount\"/><origin xyz=\"0.2 0 0\"/></joint>
  <joint name=\"elbow\" type=\"revolute\">
    <parent link=\"mount\"/><child link=\"fore\"/><origin rpy=\"3.14159265 3.0 -3.1\"/>
    <axis xyz=\"0 1 0\"/><limit lower=\"-2\" upper=\"2\" effort=\"1\" velocity=\"1\"/>
  </joint>
  <joint name=\"eye\" type=\"fixed\"><parent link=\"fore\"/><child link=\"camera\"/><origin xyz=\"0 0 0.1\"/></joint>
  <joint name=\"wrist\" type=\"revolute\">
    <parent link=\"fore\"/><child link=\"wrist\"/><origin xyz=\"0.4 0 0.05\" rpy=\"0 0 0\"/>
    <axis xyz=\"0 1 0\"/><mimic joint=\"elbow\" multiplier=\"-0.5\" offset=\"0.2\"/><limit effort=\"1\" velocity=\"1\"/>
  </joint>
  <joint name=\"flange\" type=\"fixed\"><parent link=\"wrist\"/><child link=\"tool\"/><origin xyz=\"0.15 0 0\"/></joint>
</robot>
";

/// Returns six constant errors of every frame, of both signs.
pub(super) fn all_errors(spec: &Spec) -> String {
    let mut text = String::new();
    for (i, frame) in spec.frames.iter().enumerate() {
        let value = |k: usize| f64::from(u32::try_from((7 * i + 3 * k + 2) % 11).unwrap()) / 5.0 - 1.0;
        let [x, y, z, s, r, p] = std::array::from_fn(value);
        let name = &frame.name;
        text += &format!(
            "\n[[source]]\nname = \"all of {name}\"\nclass = \"repeatable\"\nframe = \"{name}\"\ne_x = \"{x} mm\"\ne_y = \"{y} mm\"\n\
             e_z = \"{z} mm\"\ne_s = \"{s} mrad\"\ne_r = \"{r} mrad\"\ne_p = \"{p} mrad\"\n"
        );
    }
    text
}

/// Returns the spec of a file, imported by `abbe import`.
pub(crate) fn imported(file: &Path, format: import::Format) -> String {
    import::Import { file: file.to_owned(), format, round_angles: false }.run(&mut ()).unwrap().spec
}

fn urdf(file: &Path, fold: bool) -> String {
    imported(file, import::Format::Urdf { base: None, tip: Some("tool".to_owned()), fold })
}

/// Returns a text without the parts that may change: the numbers of origins.
fn without_origins(text: &str) -> String {
    let mut kept = String::new();
    let mut rest = text;
    while let Some((before, behind)) = rest.split_once("<origin") {
        kept += before;
        rest = behind.split_once("/>").unwrap().1;
    }
    kept + rest
}

#[test]
fn a_urdf_keeps_every_byte_but_its_origins_and_has_the_tool_where_it_is() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("robot.urdf");
    for fold in [false, true] {
        std::fs::write(&file, ROBOT).unwrap();
        let text = urdf(&file, fold);
        let nominal = Spec::parse("arm.toml", &text).unwrap();
        let zero =
            "\n[[source]]\nname = \"zero\"\nclass = \"repeatable\"\njoint = \"elbow\"\nerror = \"2 mrad\"\n";
        let found = Spec::parse("found.toml", &(text.clone() + &all_errors(&nominal) + zero)).unwrap();
        let machine = Machine::of_spec(found, "found.toml");
        let format = Format::Urdf { file: file.clone(), base: None, tip: Some("tool".to_owned()) };
        let report = exported(&machine, format.clone());
        assert!(report.before.position.largest > 2e-3, "{:?}", report.before);
        assert!(
            report.remains.position.largest < 1e-9 && report.remains.angle.largest < 1e-9,
            "{:?}",
            report.remains
        );

        let written = &report.files[0].text;
        // The joint without an origin has got one, on a line of its own.
        let added =
            if written.matches("<origin").count() > ROBOT.matches("<origin").count() { "    \n" } else { "" };
        let expected = without_origins(ROBOT)
            .replace("    <parent link=\"base\"", &format!("{added}    <parent link=\"base\""));
        assert_eq!(without_origins(written), expected);
        assert!(written.contains("<joint name=\"eye\" type=\"fixed\"><parent link=\"fore\"/><child link=\"camera\"/><origin xyz=\"0 0 0.1\"/></joint>"));

        // Read by `abbe import`, as any other file.
        std::fs::write(&file, written).unwrap();
        let read = Interpreter::new(Spec::parse("read.toml", &urdf(&file, false)).unwrap());
        let [shift, turn] = difference(&machine, |q| matrix(&read.pose(q, &[]).unwrap()));
        assert!(shift < 1e-9 && turn < 1e-9, "{shift:e} {turn:e}");

        // A second export changes nothing if the spec is that of the real robot.
        let real = Machine::of_spec(Spec::parse("real.toml", &urdf(&file, fold)).unwrap(), "real.toml");
        let again = exported(&real, format);
        assert_eq!((&again.files[0].text, again.changes.len()), (written, 0));
    }
}

/// Checks that catalog values, and the file of another robot, are refused.
#[test]
fn the_file_of_another_robot_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("robot.urdf");
    std::fs::write(&file, ROBOT).unwrap();
    let text = urdf(&file, false);
    let machine = Machine::of_spec(Spec::parse("arm.toml", &text).unwrap(), "arm.toml");
    for (old, new, tip, message) in [
        ("0.4 0 0.05", "0.5 0 0.05", "tool", "the robot of this file differs from that of the spec"),
        ("name", "name", "mount", "the chain between the links has"),
    ] {
        std::fs::write(&file, ROBOT.replace(old, new)).unwrap();
        let format = Format::Urdf { file: file.clone(), base: None, tip: Some(tip.to_owned()) };
        let job = Export { machine: machine.clone(), format, samples: 20, seed: 0 };
        let mistake = job.run(&mut ()).unwrap_err();
        assert!(mistake.list[0].message.contains(message), "{mistake:?}");
    }
}

/// Checks the six joints of a UR5 by independent formulas, with an error before the last of them.
#[test]
fn a_calibration_has_the_joints_where_they_are() {
    let nominal = machine("ur5", "");
    let report = exported(&nominal, Format::UrCalibration);
    assert!(report.remains.position.largest < 1e-9);
    // The numbers of the description itself, except for the differences of this arm.
    let lines = |text: &str| -> Vec<f64> {
        let lines = text.lines().filter(|line| line.starts_with("    "));
        lines.map(|line| line.trim().split_once(": ").unwrap().1.parse().unwrap()).collect()
    };
    let half = std::f64::consts::FRAC_PI_2;
    let expected = [
        [0.0, 0.0, 0.08916, 0.0, 0.0, 0.0],
        [0.0, 0.0, 0.0, half, 0.0, 0.0],
        [-0.425, 0.0, 0.0, 0.0, 0.0, 0.0],
        [-0.39225, 0.0, 0.10915, 0.0, 0.0, 0.0],
        [0.0, -0.09456, 0.0, half, 0.0, 0.0],
        [0.0, 0.1133, 0.0, -half, 0.0, 0.0],
    ];
    for (found, expected) in lines(&report.files[0].text).iter().zip(expected.as_flattened()) {
        assert!((found - expected).abs() < 1e-12, "{}", report.files[0].text);
    }

    let mut errors = all_errors(&nominal.spec);
    errors.truncate(errors.find("\n[[source]]\nname = \"all of wrist 3\"").unwrap());
    let real = machine("ur5", &errors);
    let report = exported(&real, Format::UrCalibration);
    assert!(report.before.position.largest > 1.0, "{:?}", report.before);
    let numbers = lines(&report.files[0].text);
    // From the last joint to the tool there is no error and no length: d6 belongs to the joint.
    let [shift, turn] = difference(&real, |q| {
        let mut pose = Isometry3::identity();
        for (origin, q) in numbers.chunks_exact(6).zip(q) {
            let [x, y, z, roll, pitch, yaw] = origin[..] else { panic!() };
            let placed = Translation3::new(1e3 * x, 1e3 * y, 1e3 * z)
                * UnitQuaternion::from_euler_angles(roll, pitch, yaw);
            pose *= placed * about(Vector3::z(), *q, 0.0);
        }
        pose.to_homogeneous()
    });
    assert!(shift < 1e-8 && turn < 1e-10, "{shift:e} {turn:e}");
    let job = Export { machine: machine("panda", ""), format: Format::UrCalibration, samples: 5, seed: 0 };
    assert!(job.run(&mut ()).unwrap_err().list[0].message.contains("7 revolute joints, not the six"));
}

/// Checks an arm whose table has lengths of 200 m, because two axes are nearly parallel.
#[test]
fn a_calibration_has_the_lengths_of_the_arm() {
    let spec = Spec::parse("arm.toml", crate::size::NEARLY_PARALLEL).unwrap();
    let report = exported(&Machine::of_spec(spec, "arm"), Format::UrCalibration);
    assert!(report.remains.position.largest < 1e-9, "{:?}", report.remains);
    let text = &report.files[0].text;
    let numbers = text.lines().filter_map(|line| line.trim().split_once(": ")?.1.parse::<f64>().ok());
    let lengths: Vec<f64> = numbers.enumerate().filter(|(i, _)| i % 6 < 3).map(|(_, v)| v).collect();
    assert!(lengths.len() == 18 && lengths.iter().all(|length| length.abs() < 1.0), "{text}");
}
