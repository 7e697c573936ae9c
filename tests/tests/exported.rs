//! What was found of a machine in other formats: each read back by other means, and held against the machine.

use std::path::Path;

use abbe::analysis::{Workspace, random_joint_samples, sampling};
use abbe::{Manipulator, Pose, drawn_pose, repeatable_magnitudes};
use abbe_codegen::spec::{DhConvention, Spec};
use abbe_interpreter::Interpreter;
use abbe_manipulators::SHIPPED;
use abbe_study::export::{Export, Format, Report, SAMPLES};
use abbe_study::import;
use abbe_study::{Changes, Machine, Notes};
use nalgebra::{Isometry3, Matrix4, Translation3, UnitQuaternion, Vector3};

/// A shipped spec with sources of its own.
fn machine(name: &str, sources: &str) -> Machine {
    let shipped = SHIPPED.iter().find(|shipped| shipped.name == name).unwrap();
    let text = format!("{}\n{sources}", shipped.spec);
    Machine::of_spec(Spec::parse(&format!("{name}.toml"), &text).unwrap(), name)
}

fn exported(machine: &Machine, format: Format) -> Report {
    Export { machine: machine.clone(), format, samples: SAMPLES, seed: 0 }.run(&mut ()).unwrap()
}

/// The largest distance and turn between a model and the real tool, at other configurations than those of the report.
fn difference(machine: &Machine, model: impl Fn(&[f64]) -> Matrix4<f64>) -> [f64; 2] {
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

fn matrix(pose: &Pose) -> Matrix4<f64> {
    let rows = pose.rows();
    Matrix4::from_fn(|i, j| rows[i][j])
}

fn about(axis: Vector3<f64>, turn: f64, along: f64) -> Isometry3<f64> {
    let axis = nalgebra::Unit::new_normalize(axis);
    Isometry3::from_parts(
        Translation3::from(axis.into_inner() * along),
        UnitQuaternion::from_axis_angle(&axis, turn),
    )
}

/// The tool by a table of numbers, multiplied by hand.
fn by_table(text: &str, q: &[f64], is_standard: bool) -> Matrix4<f64> {
    let mut q = q.iter();
    let mut pose = Isometry3::identity();
    for line in text.lines().filter(|line| !line.starts_with('#')).skip(1) {
        let cells: Vec<&str> = line.split(',').collect();
        let numbers: Vec<f64> = cells[2..].iter().map(|cell| cell.parse().unwrap()).collect();
        let [sign, mut theta, mut d, a, alpha] = numbers[..] else { panic!("{line}") };
        match cells[1] {
            "revolute" => theta += sign * q.next().unwrap(),
            "prismatic" => d += sign * q.next().unwrap(),
            other => assert_eq!(other, "fixed"),
        }
        let (z, x) = (about(Vector3::z(), theta, d), about(Vector3::x(), alpha, a));
        pose *= if is_standard { z * x } else { x * z };
    }
    assert!(q.next().is_none());
    pose.to_homogeneous()
}

/// Errors of the numbers themselves: all of them are in the table.
#[test]
fn numbers_that_are_off_are_in_the_table() {
    let standard = machine(
        "ur5",
        "[[source]]\nname = \"as built\"\nclass = \"repeatable\"\nframe = \"shoulder\"\ndh = { theta = \"0.4 mrad\", a = \"0.3 mm\", alpha = \"-0.5 mrad\" }\n\
         [[source]]\nname = \"elbow zero\"\nclass = \"repeatable\"\njoint = \"q3\"\nerror = \"-0.7 mrad\"\n\
         [[source]]\nname = \"wrist\"\nclass = \"repeatable\"\nframe = \"wrist 2\"\ndh = { d = \"-0.2 mm\", alpha = \"0.3 mrad\" }\n",
    );
    let modified = machine(
        "panda",
        "[[source]]\nname = \"zero\"\nclass = \"repeatable\"\njoint = \"q4\"\nerror = \"0.6 mrad\"\n",
    );
    for (machine, is_standard) in [(standard, true), (modified, false)] {
        let report = exported(&machine, Format::Dh);
        let unit = machine.spec.length.in_metres();
        assert!(report.before.position.largest * unit > 2e-4, "{report:?}");
        assert!(
            report.remains.position.largest * unit < 1e-9 && report.remains.angle.largest < 1e-9,
            "{report:?}"
        );
        // The tool behind the flange comes beside the table.
        let tool = if is_standard { 0.0 } else { 0.107 };
        let tool = Matrix4::new_translation(&Vector3::new(0.0, 0.0, tool));
        let [shift, turn] = difference(&machine, |q| by_table(&report.files[0].text, q, is_standard) * tool);
        assert!(shift * unit < 1e-9 && turn < 1e-9, "{shift:e} {turn:e}");
        assert!(report.left_out.iter().all(|line| !line.contains("held at its mean")));

        // By `abbe import`, as any other table.
        let folder = tempfile::tempdir().unwrap();
        let file = folder.path().join("arm.csv");
        std::fs::write(&file, &report.files[0].text).unwrap();
        let convention = if is_standard { DhConvention::Standard } else { DhConvention::Modified };
        let text = imported(&file, import::Format::Table { convention, units: import::Units::default() });
        let read = Spec::parse("read.toml", &text).unwrap();
        assert_eq!(read.length, machine.spec.length);
        let names = |spec: &Spec| spec.variables.iter().map(|one| one.name.clone()).collect::<Vec<_>>();
        assert_eq!(names(&read), names(&machine.spec));
        let read = Interpreter::new(read);
        let [shift, turn] = difference(&machine, |q| matrix(&read.pose(q, &[]).unwrap()) * tool);
        assert!(shift * unit < 1e-9 && turn < 1e-9, "{shift:e} {turn:e}");
    }
}

/// The PUMA is written in matrices, the Stanford arm slides: both have a table. A milling machine has none, and is told so.
#[test]
fn chains_of_any_form_have_a_table_if_they_are_of_one_convention() {
    for (name, word) in
        [("puma560", "standard"), ("stanford", "standard"), ("wam", "standard"), ("iiwa", "modified")]
    {
        let report = exported(&machine(name, ""), Format::Dh);
        assert!(report.format.ends_with(word), "{}", report.format);
    }
    let job = Export { machine: machine("machine3", ""), format: Format::Dh, samples: 10, seed: 0 };
    let mistake = job.run(&mut ()).unwrap_err();
    assert!(
        mistake.list[0].message.contains("the frame \"X\" has no Denavit-Hartenberg numbers"),
        "{mistake:?}"
    );
}

/// A tilt between parallel axes, about the normal that alpha does not turn about, is not in the table, and no number runs away.
#[test]
fn a_tilt_that_a_table_cannot_hold_remains() {
    let tilt =
        "[[source]]\nname = \"tilt\"\nclass = \"repeatable\"\nframe = \"shoulder\"\ne_s = \"0.5 mrad\"\n";
    let machine = machine("ur5", tilt);
    let report = exported(&machine, Format::Dh);
    let [shift, _] = difference(&machine, |q| by_table(&report.files[0].text, q, true));
    assert!(
        report.remains.position.largest > 0.01 && report.remains.position.rms < report.before.position.rms
    );
    // Other configurations of the same robot: the same size.
    assert!((shift / report.remains.position.largest - 1.0).abs() < 0.3, "{shift} {:?}", report.remains);
    for line in report.files[0].text.lines().skip(2) {
        let numbers: Vec<f64> = line.split(',').skip(3).map(|cell| cell.parse().unwrap()).collect();
        assert!(numbers.iter().all(|number| number.abs() < 500.0), "{line}");
    }
    assert!(report.left_out.iter().any(|line| line.contains("q2 and q3")), "{:?}", report.left_out);
}

/// What changes with the configuration is named, and only that; an input that is set stays.
#[test]
fn what_changes_is_held_at_its_mean() {
    let machine = machine(
        "ur5",
        "[[source]]\nname = \"zero\"\nclass = \"repeatable\"\njoint = \"q2\"\nerror = \"0.3 mrad\"\n\
         [[source]]\nname = \"windup\"\nclass = \"repeatable\"\njoint = \"q3\"\nerror = \"0.2 mrad * cos(q2)\"\n",
    );
    let report = exported(&machine, Format::Dh);
    let said: Vec<&String> =
        report.left_out.iter().filter(|line| line.contains("held at its mean")).collect();
    assert!(matches!(said[..], [line] if line.ends_with(": \"windup\".")), "{:?}", report.left_out);
    assert!(report.remains.position.largest > 0.01);
}

/// A lift, an arm with a joint that follows another, a screwed mount in the middle, and a camera beside the chain; written in every
/// way that URDF has.
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

/// Six constant errors of every frame, of both signs.
fn all_errors(spec: &Spec) -> String {
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

/// The spec of a file, by `abbe import`.
fn imported(file: &Path, format: import::Format) -> String {
    import::Import { file: file.to_owned(), format, round_angles: false }.run(&mut ()).unwrap().spec
}

fn urdf(file: &Path, fold: bool) -> String {
    imported(file, import::Format::Urdf { base: None, tip: Some("tool".to_owned()), fold })
}

/// What stands in a text without what may change: the numbers of origins.
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
        // The joint without an origin has one now, on a line of its own.
        let added =
            if written.matches("<origin").count() > ROBOT.matches("<origin").count() { "    \n" } else { "" };
        let expected = without_origins(ROBOT)
            .replace("    <parent link=\"base\"", &format!("{added}    <parent link=\"base\""));
        assert_eq!(without_origins(written), expected);
        assert!(written.contains("<joint name=\"eye\" type=\"fixed\"><parent link=\"fore\"/><child link=\"camera\"/><origin xyz=\"0 0 0.1\"/></joint>"));

        // By `abbe import`, as any other file.
        std::fs::write(&file, written).unwrap();
        let read = Interpreter::new(Spec::parse("read.toml", &urdf(&file, false)).unwrap());
        let [shift, turn] = difference(&machine, |q| matrix(&read.pose(q, &[]).unwrap()));
        assert!(shift < 1e-9 && turn < 1e-9, "{shift:e} {turn:e}");

        // Nothing is left to be changed in the file of the real robot, if the spec is that of it.
        let real = Machine::of_spec(Spec::parse("real.toml", &urdf(&file, fold)).unwrap(), "real.toml");
        let again = exported(&real, format);
        assert_eq!((&again.files[0].text, again.changes.len()), (written, 0));
    }
}

/// Numbers of a catalogue, and the file of another robot.
#[test]
fn the_file_of_another_robot_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("robot.urdf");
    std::fs::write(&file, ROBOT).unwrap();
    let text = urdf(&file, false);
    let machine = Machine::of_spec(Spec::parse("arm.toml", &text).unwrap(), "arm.toml");
    for (old, new, tip, message) in [
        ("0.4 0 0.05", "0.5 0 0.05", "tool", "this is not the robot of the spec"),
        ("name", "name", "mount", "joints move between the links"),
    ] {
        std::fs::write(&file, ROBOT.replace(old, new)).unwrap();
        let format = Format::Urdf { file: file.clone(), base: None, tip: Some(tip.to_owned()) };
        let job = Export { machine: machine.clone(), format, samples: 20, seed: 0 };
        let mistake = job.run(&mut ()).unwrap_err();
        assert!(mistake.list[0].message.contains(message), "{mistake:?}");
    }
}

/// The six joints of a UR5 by hand, and what is wrong before the last of them.
#[test]
fn a_calibration_has_the_joints_where_they_are() {
    let nominal = machine("ur5", "");
    let report = exported(&nominal, Format::UrCalibration);
    assert!(report.remains.position.largest < 1e-9);
    // The numbers of the description itself, but for those by which this arm differs.
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
    // From the last joint to the tool nothing is wrong here, and nothing lies between: d6 is within the joint.
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
    assert!(job.run(&mut ()).unwrap_err().list[0].message.contains("7 joints turn here, and six"));
}

/// The milling machine at 20 degrees Celsius.
fn mill() -> Machine {
    let mut machine = machine("machine3", "");
    let set = ["temperature_rise=0K".to_owned()];
    machine.change(&Changes::read(&set, &[], &[], &machine.spec).unwrap());
    machine
}

/// The largest distance of the real tool from the ideal one, with commands as they are corrected.
fn commanded(machine: &Machine, corrected: impl Fn(&[f64]) -> Vec<f64>) -> f64 {
    let arm = Interpreter::new(machine.spec.clone());
    let magnitudes = repeatable_magnitudes(arm.description());
    let (s, u) =
        (sampling::nominal_parameters(arm.description()), sampling::nominal_inputs(arm.description()));
    let moved: Vec<usize> = (0..machine.spec.variables.len()).collect();
    let workspace = random_joint_samples(&arm, &moved, 300, 7).unwrap();
    let left = (0..workspace.len()).map(|index| {
        let q = workspace.configuration(index).unwrap().q;
        let ideal = arm.pose(&q, &s).unwrap().position();
        let real = drawn_pose(&arm, &corrected(&q), &s, &u, &magnitudes).unwrap().position();
        (Vector3::from(real) - Vector3::from(ideal)).norm()
    });
    left.fold(0.0, f64::max)
}

/// Straight between the rows of a table, whose first column rises.
fn between(rows: &[Vec<f64>], x: f64) -> Vec<f64> {
    let i = rows.partition_point(|row| row[0] <= x).clamp(1, rows.len() - 1);
    let share = (x - rows[i - 1][0]) / (rows[i][0] - rows[i - 1][0]);
    rows[i - 1].iter().zip(&rows[i]).map(|(a, b)| a + share * (b - a)).collect()
}

fn rows(lines: &str) -> Vec<Vec<f64>> {
    lines.lines().map(|line| line.split(' ').map(|cell| cell.parse().unwrap()).collect()).collect()
}

/// To first order `ΔP = Σ t_i + θ_i × (what lies between carriage i and the tool)`; the control subtracts it. The other sign doubles.
#[test]
fn volumetric_tables_hold_errors_that_the_control_subtracts() {
    let machine = mill();
    let report = exported(&machine, Format::IsgCsv { nodes: 601 });
    let text = &report.files[0].text;
    let mut blocks = text.split("\n#\n");
    let tool = rows(blocks.next().unwrap().lines().last().unwrap()).remove(0);
    assert_eq!(tool, [0.0, 0.0, -150.0]);
    let axes: Vec<Vec<Vec<f64>>> = blocks
        .zip(["X", "Y", "Z"])
        .map(|(block, axis)| {
            let (heading, lines) = block.split_once('\n').unwrap();
            assert_eq!(heading, format!("{axis} EX{axis} EY{axis} EZ{axis} EA{axis} EB{axis} EC{axis}"));
            rows(lines)
        })
        .collect();
    // A number of the spec: EYX = 4 um in the middle of X, and the turn about X there is 12 urad.
    let middle = between(&axes[0], 300.0);
    assert!((middle[2] - 0.004).abs() < 1e-9 && (middle[4] - 12e-6).abs() < 1e-9, "{middle:?}");
    let corrected = |q: &[f64], sign: f64| {
        let mut shift = Vector3::zeros();
        for (i, axis) in axes.iter().enumerate() {
            let e = between(axis, q[i]);
            let mut lever = Vector3::from_column_slice(&tool);
            (i + 1..3).for_each(|k| lever[k] += q[k]);
            shift += Vector3::new(e[1], e[2], e[3]) + Vector3::new(e[4], e[5], e[6]).cross(&lever);
        }
        (0..3).map(|i| q[i] - sign * shift[i]).collect::<Vec<f64>>()
    };
    let before = commanded(&machine, <[f64]>::to_vec);
    let after = commanded(&machine, |q| corrected(q, 1.0));
    let wrong = commanded(&machine, |q| corrected(q, -1.0));
    assert!(after < before / 50.0 && wrong > 1.9 * before, "{before} {after} {wrong}");
    assert!((report.before.position.largest / before - 1.0).abs() < 0.3, "{before} {:?}", report.before);
    assert!(report.remains.position.largest < 5e-4, "{:?}", report.remains);
    assert!(!report.left_out[0].contains("depends on more"), "{:?}", report.left_out);
}

/// Coarse tables leave what the screws do between their nodes; an input that is not set remains, and is named.
#[test]
fn what_tables_leave_is_said() {
    let coarse = exported(&mill(), Format::IsgCsv { nodes: 9 });
    assert!(coarse.remains.position.largest > 1e-3, "{:?}", coarse.remains);
    let warm = exported(&machine("machine3", ""), Format::IsgCsv { nodes: 101 });
    assert!(warm.remains.position.largest > 0.05, "{:?}", warm.remains);
    assert!(warm.left_out[0].ends_with("\"thermal expansion\"."), "{:?}", warm.left_out);
    for format in [Format::IsgCsv { nodes: 5 }, Format::LinuxCnc { nodes: 5 }] {
        let job = Export { machine: machine("pps", ""), format, samples: 5, seed: 0 };
        let message = job.run(&mut ()).unwrap_err().list[0].message.clone();
        assert!(message.contains("turns") || message.contains("slide"), "{message}");
    }
    let job = Export { machine: mill(), format: Format::LinuxCnc { nodes: 257 }, samples: 5, seed: 0 };
    assert!(job.run(&mut ()).unwrap_err().list[0].message.contains("256"));
}

/// LinuxCNC adds `nominal − forward` to the command: along each axis, with the others at home, nothing is left.
#[test]
fn files_of_linuxcnc_hold_where_the_axis_is() {
    let machine = mill();
    let report = exported(&machine, Format::LinuxCnc { nodes: 256 });
    let names: Vec<&str> = report.files.iter().map(|file| file.name.as_str()).collect();
    assert_eq!(names, ["x.comp", "y.comp", "z.comp"]);
    let arm = Interpreter::new(machine.spec.clone());
    let magnitudes = repeatable_magnitudes(arm.description());
    let (s, home) = (sampling::nominal_parameters(arm.description()), sampling::home(arm.description()));
    for (i, file) in report.files.iter().enumerate() {
        let lines = rows(&file.text);
        assert_eq!(lines.len(), 256);
        let (mut before, mut after) = (0.0_f64, 0.0_f64);
        for line in &lines {
            let [nominal, forward, reverse] = line[..] else { panic!("{line:?}") };
            assert_eq!(forward, reverse);
            let at = |value: f64| {
                let mut q = home.clone();
                q[i] = value;
                drawn_pose(&arm, &q, &s, &[0.0], &magnitudes).unwrap().position()[i]
            };
            let mut q = home.clone();
            q[i] = nominal;
            let ideal = arm.pose(&q, &s).unwrap().position()[i];
            before = before.max((at(nominal) - ideal).abs());
            after = after.max((at(nominal + (nominal - forward)) - ideal).abs());
        }
        assert!(before > 1e-3 && after < 1e-5, "{names:?} {i}: {before} {after}");
    }
    assert!(report.remains.position.rms < report.before.position.rms);
}

/// At a node the corrected tool is where it should be; between nodes it is as the report says, and closer with more of them.
#[test]
fn a_table_of_corrections_is_added_to_commands() {
    let machine = mill();
    let report = exported(&machine, Format::Table { nodes: Some(7) });
    let arm = Interpreter::new(machine.spec.clone());
    let magnitudes = repeatable_magnitudes(arm.description());
    let s = sampling::nominal_parameters(arm.description());
    let mut lines = report.files[0].text.lines();
    assert_eq!(lines.next(), Some("x,y,z,add to x,add to y,add to z"));
    let mut count = 0;
    for line in lines {
        let numbers: Vec<f64> = line.split(',').map(|cell| cell.parse().unwrap()).collect();
        let (q, added) = numbers.split_at(3);
        let corrected: Vec<f64> = q.iter().zip(added).map(|(q, added)| q + added).collect();
        let ideal = Vector3::from(arm.pose(q, &s).unwrap().position());
        let real = drawn_pose(&arm, &corrected, &s, &[0.0], &magnitudes).unwrap().position();
        assert!((Vector3::from(real) - ideal).norm() < 1e-5, "{line}");
        count += 1;
    }
    assert_eq!(count, 343);
    let fine = exported(&machine, Format::Table { nodes: Some(31) });
    assert!(report.remains.position.rms < report.before.position.rms / 5.0, "{:?}", report.remains);
    assert!(fine.remains.position.rms < report.remains.position.rms, "{:?}", fine.remains);
    assert!(report.at_nodes.unwrap().position.rms < report.remains.position.rms);
}

/// A trunnion: the table turns about Z in what tilts about X, 50 mm below; slides along X, Y and Z carry the tool.
const TRUNNION: &str = r#"
[manipulator]
name = "trunnion"
length = "mm"
[[frame]]
name = "C"
variable = { name = "c", kind = "revolute", limits = ["-180 deg", "180 deg"] }
transform = "Rz(c)"
[[frame]]
name = "A"
variable = { name = "a", kind = "revolute", limits = ["-110 deg", "30 deg"] }
transform = "Tz(-50) Rx(a)"
[[frame]]
name = "bed"
transform = "Tx(-250) Ty(-200) Tz(250)"
[[frame]]
name = "X"
variable = { name = "x", kind = "prismatic", limits = [0, 500] }
transform = "Tx(x)"
[[frame]]
name = "Y"
variable = { name = "y", kind = "prismatic", limits = [0, 400] }
transform = "Ty(y)"
[[frame]]
name = "Z"
variable = { name = "z", kind = "prismatic", limits = [0, 400] }
transform = "Tz(z)"
[tool]
transform = "Tz(-120)"
"#;

/// Where its axes really stand.
const ELSEWHERE: &str = r#"
[[source]]
name = "where C is"
class = "repeatable"
frame = "C"
e_x = "12 um"
e_y = "-18 um"
e_s = "-25e-6"
e_p = "40e-6"
[[source]]
name = "where A is"
class = "repeatable"
frame = "A"
e_y = "15 um"
e_z = "-22 um"
e_s = "35e-6"
[[source]]
name = "behind A"
class = "repeatable"
frame = "bed"
e_z = "9 um"
e_r = "-20e-6"
"#;

/// Of the slides.
const SLIDES: &str = r#"
[[source]]
name = "slides"
class = "repeatable"
[[source.effect]]
frame = "X"
e_x = "24 um * x/(500 mm)"
e_s = "30e-6 * x/(500 mm)"
[[source.effect]]
frame = "Y"
e_x = "-25e-6 * y"
e_r = "-24e-6 * y/(400 mm)"
[[source.effect]]
frame = "Z"
e_z = "10 um * z/(400 mm)"
e_p = "20e-6 * z/(400 mm)"
"#;

fn trunnion(sources: &str) -> Machine {
    Machine::of_spec(Spec::parse("trunnion.toml", &(TRUNNION.to_owned() + sources)).unwrap(), "trunnion")
}

/// Seen from the bed, a point of the table runs round the axis of the table: the mean of three places a third of a turn apart is on it. At two
/// heights they give the axis, and the same for the trunnion, whose axis is that of the points of what tilts.
#[test]
fn axes_that_turn_stand_where_the_report_says() {
    let machine = trunnion(ELSEWHERE);
    let report = exported(&machine, Format::IsgCsv { nodes: 5 });
    let arm = Interpreter::new(machine.spec.clone());
    let (s, magnitudes) = (vec![], repeatable_magnitudes(arm.description()));
    // The slides are right: where they all are at 0, the bed is the tool but for a constant.
    let third = 2.0 * std::f64::consts::PI / 3.0;
    let on_table = |c: f64, a: f64, point: Vector3<f64>, is_real: bool| {
        let q = [c, a, 0.0, 0.0, 0.0];
        let tool = if is_real {
            matrix(&drawn_pose(&arm, &q, &s, &[], &magnitudes).unwrap())
        } else {
            matrix(&arm.pose(&q, &s).unwrap())
        };
        tool.try_inverse().unwrap().transform_point(&point.into()).coords
    };
    let moved = |at: &dyn Fn(bool) -> Vector3<f64>| at(true) - at(false);
    let [c, a] = &report.turned[..] else { panic!("{:?}", report.turned) };
    assert_eq!([c.variable.as_str(), a.variable.as_str()], ["c", "a"]);
    // The table's axis in the trunnion, at the table and 100 mm above; the trunnion's own place is in what follows.
    let centre = |height: f64| {
        moved(&|is_real| {
            let places =
                [0.0, third, -third].map(|c| on_table(c, 0.0, Vector3::new(70.0, -20.0, height), is_real));
            (places[0] + places[1] + places[2]) / 3.0
        })
    };
    // The trunnion's axis in the bed: points of it that do not move when it tilts, 100 mm to either side of the table's middle.
    let tilt = |x: f64| {
        moved(&|is_real| {
            let places =
                [0.0, third, -third].map(|a| on_table(0.0, a, Vector3::new(x, 30.0, -80.0), is_real));
            (places[0] + places[1] + places[2]) / 3.0
        })
    };
    let (left, right) = (tilt(-100.0), tilt(100.0));
    let across = (right - left) / 200.0;
    let middle = (left + right) / 2.0;
    // A turn (A, B, C) takes X to (1, C, -B).
    let close = |a: f64, b: f64| (a - b).abs() < 1e-6;
    assert!(close(a.position[1], middle.y) && close(a.position[2], middle.z), "{a:?} {middle}");
    assert!((a.angles[2] - across.y).abs() < 1e-8 && (a.angles[1] + across.z).abs() < 1e-8, "{a:?} {across}");
    // 15 um of its own, and 5 um by the turn of what is behind it, 250 mm away.
    assert!((a.position[1] + 0.010).abs() < 1e-4 && (a.angles[1] + 35e-6).abs() < 1e-8, "{a:?}");
    // Of C, less what the trunnion does to it at the table's height, 50 mm above its axis.
    let (low, high) = (centre(0.0), centre(100.0));
    let upright = (high - low) / 100.0;
    let turn = Vector3::from(a.angles);
    let carried = Vector3::from(a.position) + turn.cross(&Vector3::new(0.0, 0.0, 50.0));
    let own = low - carried;
    assert!(close(c.position[0], own.x) && close(c.position[1], own.y), "{c:?} {own}");
    // A turn takes Z to (B, -A, 1).
    let own = upright - turn.cross(&Vector3::z());
    assert!((c.angles[1] - own.x).abs() < 1e-8 && (c.angles[0] + own.y).abs() < 1e-8, "{c:?} {own}");
    assert!((c.position[0] + 0.012).abs() < 1e-6 && (c.angles[0] + 40e-6).abs() < 1e-8, "{c:?}");
}

/// With the axes placed, tables hold the rest of a machine whose axes turn true; without, they do not.
#[test]
fn tables_and_placed_axes_hold_a_machine_whose_axes_turn_true() {
    for format in [Format::IsgCsv { nodes: 11 }, Format::LinuxCnc { nodes: 11 }] {
        let report = exported(&trunnion(ELSEWHERE), format);
        let placed = report.placed.unwrap();
        assert!(report.before.position.rms > 0.02 && placed.position.largest < 1e-9, "{placed:?}");
        assert!((report.remains.position.rms / report.before.position.rms - 1.0).abs() < 0.01);
    }
    let report = exported(&trunnion(&[ELSEWHERE, SLIDES].concat()), Format::IsgCsv { nodes: 101 });
    let placed = report.placed.unwrap();
    assert!(report.remains.position.rms > 0.01 && placed.position.largest < 2e-5, "{placed:?}");
    // Orientations stay as they are, to what 0.1 mm of slides changes.
    assert!((placed.angle.rms / report.before.angle.rms - 1.0).abs() < 1e-3, "{placed:?}");
    // Where nothing turns the workpiece there is nothing to place.
    let mill = exported(&mill(), Format::IsgCsv { nodes: 11 });
    assert!(mill.placed.is_none() && mill.turned.is_empty());
}

/// A head behind the slides has a lever that its angles change.
#[test]
fn a_head_is_refused() {
    let head = TRUNNION.replace("[tool]", "[[frame]]\nname = \"B\"\nvariable = { name = \"b\", kind = \"revolute\", limits = [-1, 1] }\ntransform = \"Ry(b)\"\n[tool]");
    let machine = Machine::of_spec(Spec::parse("head.toml", &head).unwrap(), "head");
    for format in [Format::IsgCsv { nodes: 5 }, Format::LinuxCnc { nodes: 5 }] {
        let mistake =
            Export { machine: machine.clone(), format, samples: 5, seed: 0 }.run(&mut ()).unwrap_err();
        assert!(mistake.list[0].message.contains("`b` turns the tool, which a slide carries"), "{mistake:?}");
    }
}

/// Three nodes over two turns of each joint: whoever loads that is warned.
#[test]
fn a_table_that_makes_it_worse_is_said_to() {
    #[derive(Default)]
    struct Heard(Vec<String>);
    impl Notes for Heard {
        fn note(&mut self, _: &str) {}

        fn warn(&mut self, warning: &str) {
            self.0.push(warning.to_owned());
        }
    }
    let found = machine(
        "ur5",
        "[[source]]\nname = \"zero\"\nclass = \"repeatable\"\njoint = \"q2\"\nerror = \"0.6 mrad\"\n\
         [[source]]\nname = \"tilt\"\nclass = \"repeatable\"\nframe = \"shoulder\"\ne_p = \"-0.4 mrad\"\n",
    );
    let heard = |format| {
        let mut heard = Heard::default();
        let report =
            Export { machine: found.clone(), format, samples: 200, seed: 0 }.run(&mut heard).unwrap();
        (report.remains.position.rms > report.before.position.rms, heard.0)
    };
    let (worse, warned) = heard(Format::Table { nodes: Some(3) });
    assert!(worse && warned.iter().any(|warning| warning.contains("do not load it")), "{warned:?}");
    let (worse, warned) = heard(Format::Dh);
    assert!(!worse && warned.is_empty(), "{warned:?}");
}
