//! Compensation tables of machines with linear axes, and tables of corrections.

use abbe::analysis::{Workspace, random_joint_samples, sampling};
use abbe::{Manipulator, drawn_pose, repeatable_magnitudes};
use abbe_interpreter::Interpreter;
use abbe_spec::Spec;
use abbe_study::export::{Export, Format};
use abbe_study::{Changes, Machine, Notes};
use nalgebra::Vector3;

use super::{exported, machine};

/// Returns the milling machine at 20 degrees Celsius.
pub(crate) fn mill() -> Machine {
    let mut machine = machine("machine3", "");
    let set = ["temperature_rise=0K".to_owned()];
    machine.change(&Changes::read([&set, &[], &[], &[]], &machine.spec).unwrap());
    machine
}

/// Returns the largest distance of the real tool from the ideal one, with corrected commands.
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

/// Interpolates linearly between the rows of a table, sorted by its first column.
fn between(rows: &[Vec<f64>], x: f64) -> Vec<f64> {
    let i = rows.partition_point(|row| row[0] <= x).clamp(1, rows.len() - 1);
    let share = (x - rows[i - 1][0]) / (rows[i][0] - rows[i - 1][0]);
    rows[i - 1].iter().zip(&rows[i]).map(|(a, b)| a + share * (b - a)).collect()
}

pub(crate) fn rows(lines: &str) -> Vec<Vec<f64>> {
    lines.lines().map(|line| line.split(' ').map(|cell| cell.parse().unwrap()).collect()).collect()
}

/// Checks the volumetric tables: to first order
/// `ΔP = Σ t_i + θ_i × (vector from carriage i to the tool)`, which the control subtracts. The
/// opposite sign doubles the error.
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
    // A value of the spec: EYX = 4 um in the middle of X, and the rotation about X there is 12
    // urad.
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

/// Checks the rows of KinematicsComp: from the tool, each error stands before its axis, and the
/// tables hold the errors at the tool reference point.
#[test]
fn rows_of_kinematics_comp_stand_before_their_axis() {
    let machine = mill();
    let report = exported(&machine, Format::KinematicsComp { nodes: 601 });
    let text = &report.files[0].text;
    let docs: Vec<&str> = text.lines().skip(1).map(|line| line.split(',').nth(1).unwrap()).collect();
    let expected = "EXZ EYZ EAZ EBZ ECZ - EXY EZY EAY EBY ECY - EYX EZX EAX EBX ECX -";
    let expected: Vec<&str> = expected.split(' ').map(|doc| doc.trim_matches('-')).collect();
    assert_eq!(docs, expected);
    assert!(
        text.contains("\n5,,MachAxis,Z,,\n") && text.contains("\n16,ECX,Trans,C,,column C6 of X\n"),
        "{text}"
    );
    let names: Vec<&str> = report.files.iter().map(|file| file.name.as_str()).collect();
    assert_eq!(names, ["rows.csv", "x.csv", "y.csv", "z.csv"]);
    // EYX is 4 um and EAX 12 urad in the middle of X; the spindle nose is on the axis.
    let middle = report.files[1].text.lines().nth(301).unwrap();
    let middle: Vec<f64> = middle.split(',').map(|cell| cell.parse().unwrap()).collect();
    assert!(middle[0] == 300.0 && (middle[2] - 0.004).abs() < 1e-8, "{middle:?}");
    assert!((middle[4] - 12e-6_f64.to_degrees()).abs() < 2e-9, "{middle:?}");
    assert!(report.remains.position.largest < report.before.position.largest / 30.0, "{:?}", report.remains);
    let said = report.left_out.join("\n");
    assert!(said.contains("not the bytes of the files"), "{said}");
}

/// Checks that coarse tables leave the errors of the screws between their nodes, and that the
/// effect of an input that is not set remains and is named.
#[test]
fn what_tables_leave_is_said() {
    let coarse = exported(&mill(), Format::IsgCsv { nodes: 9 });
    assert!(coarse.remains.position.largest > 1e-3, "{:?}", coarse.remains);
    let warm = exported(&machine("machine3", ""), Format::IsgCsv { nodes: 101 });
    assert!(warm.remains.position.largest > 0.05, "{:?}", warm.remains);
    assert!(warm.left_out[0].ends_with("\"thermal expansion\"."), "{:?}", warm.left_out);
    for format in [Format::IsgCsv { nodes: 5 }, Format::LinuxCnc { nodes: 5, has_matrix: false }] {
        let job = Export { machine: machine("pps", ""), format, samples: 5, seed: 0 };
        let message = job.run(&mut ()).unwrap_err().list[0].message.clone();
        assert!(message.contains("rotary axis") || message.contains("slide"), "{message}");
    }
    let job = Export {
        machine: mill(),
        format: Format::LinuxCnc { nodes: 257, has_matrix: false },
        samples: 5,
        seed: 0,
    };
    assert!(job.run(&mut ()).unwrap_err().list[0].message.contains("256"));
}

/// Checks that LinuxCNC, which adds `nominal − forward` to the command, leaves along each axis
/// with the others at home no error but that at home, where it adds nothing.
#[test]
fn files_of_linuxcnc_hold_where_the_axis_is() {
    let machine = mill();
    let report = exported(&machine, Format::LinuxCnc { nodes: 256, has_matrix: false });
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
            let ideal = |value: f64| {
                let mut q = home.clone();
                q[i] = value;
                arm.pose(&q, &s).unwrap().position()[i]
            };
            let at_home = at(home[i]) - ideal(home[i]);
            before = before.max((at(nominal) - ideal(nominal)).abs());
            after = after.max((at(nominal + (nominal - forward)) - ideal(nominal) - at_home).abs());
        }
        let home = between(&lines, home[i]);
        assert!((home[1] - home[0]).abs() < 2e-6, "{names:?} {i}: {home:?}");
        assert!(before > 1e-3 && after < 1e-5, "{names:?} {i}: {before} {after}");
    }
    assert!(report.remains.position.rms < report.before.position.rms);
}

/// A slide with a screw that was measured from one limit to the other, and backlash of 5 µm that
/// depends on the direction of approach.
const SCREW: &str = r#"
[manipulator]
name = "screw"
length = "mm"
[inputs]
x_from = { value = 1, range = [-1, 1], description = "1 from below, -1 from above" }
[tables.exx]
x = { values = [0, 100, 200, 300, 400], unit = "mm" }
y = { values = [5, 2, -3, 4, 8], unit = "um" }
interpolation = "linear"
[[frame]]
name = "X"
variable = { name = "x", kind = "prismatic", limits = [0, 400], home = 100 }
transform = "Tx(x)"
[[source]]
name = "EXX"
class = "repeatable"
frame = "X"
e_x = "exx(x)"
[[source]]
name = "backlash"
class = "repeatable"
joint = "x"
error = "x_from * 2.5 um"
"#;

/// Checks the forward and reverse columns: trims are 0 at home, as the mean of both directions, and
/// the axis is then where it is commanded in both, but for the error at home.
#[test]
fn columns_of_linuxcnc_hold_both_directions() {
    let machine = Machine::of_spec(Spec::parse("screw.toml", SCREW).unwrap(), "screw");
    let report = exported(&machine, Format::LinuxCnc { nodes: 5, has_matrix: false });
    let expected = "0.000000 0.005500 0.000500\n100.000000 100.002500 99.997500\n200.000000 199.997500 \
                    199.992500\n300.000000 300.004500 299.999500\n400.000000 400.008500 400.003500\n";
    assert_eq!(report.files[0].text, expected);
    assert!(report.remains.position.largest < 1e-6, "{:?}", report.remains);
    assert!(report.before.position.largest > 0.007, "{:?}", report.before);
    let said = report.left_out.join("\n");
    assert!(said.contains("forward column holds for `x_from` = 1, the reverse column for -1"), "{said}");
    // An input with a value holds in both directions.
    let mut below = machine;
    below.change(&Changes::read([&["x_from=1".to_owned()], &[], &[], &[]], &below.spec).unwrap());
    let report = exported(&below, Format::LinuxCnc { nodes: 5, has_matrix: false });
    assert!(rows(&report.files[0].text).iter().all(|line| line[1] == line[2]), "{:?}", report.files);
}

/// Checks the matrix of `matrixkins`: the joints that it commands leave nothing of scales and
/// squareness, and the files nothing of what remains along an axis.
#[test]
fn a_matrix_of_linuxcnc_holds_scales_and_squareness() {
    let frames = &SCREW[..SCREW.find("[[source]]").unwrap()];
    let axes = r#"
[[frame]]
name = "Y"
variable = { name = "y", kind = "prismatic", limits = [0, 300], home = 50 }
transform = "Ty(y)"
[[frame]]
name = "Z"
variable = { name = "z", kind = "prismatic", limits = [-200, 0] }
transform = "Tz(z)"
[[source]]
name = "scales and squareness"
class = "repeatable"
[[source.effect]]
frame = "X"
e_x = "30e-6 * x"
[[source.effect]]
frame = "Y"
e_x = "-25e-6 * y"
[[source.effect]]
frame = "Z"
e_x = "15e-6 * z"
e_y = "-20e-6 * z"
e_z = "-10e-6 * z + 0.01 mm"
"#;
    let linear = [frames, axes].concat();
    let machine = Machine::of_spec(Spec::parse("mill.toml", &linear).unwrap(), "mill");
    let report = exported(&machine, Format::LinuxCnc { nodes: 11, has_matrix: true });
    let mut lines = report.files[0].text.lines().skip(1);
    let expected = [[1.0 - 30e-6, 25e-6, -15e-6], [0.0, 1.0, 20e-6], [0.0, 0.0, 1.0 + 10e-6]];
    for (i, joint) in ["x", "y", "z"].into_iter().enumerate() {
        for (j, axis) in ["x", "y", "z"].into_iter().enumerate() {
            let line = lines.next().unwrap();
            let value = line.strip_prefix(&format!("setp matrixkins.C_{joint}{axis} ")).unwrap();
            assert!((value.parse::<f64>().unwrap() - expected[i][j]).abs() < 1e-11, "{line}");
        }
    }
    assert_eq!(report.files[0].name, "matrixkins.hal");
    assert!(report.before.position.largest > 0.01 && report.remains.position.largest < 1e-5, "{report:?}");
    for file in &report.files[1..] {
        assert!(rows(&file.text).iter().all(|line| (line[1] - line[0]).abs() < 2e-6), "{file:?}");
    }
    // At home the machine is where the matrix and the errors take it.
    let home = [100.0, 50.0, 0.0];
    let errors = [30e-6 * home[0] - 25e-6 * home[1], 0.0, 0.01];
    let moved = [0, 1, 2]
        .map(|i| (0..3).map(|j| (expected[i][j] - f64::from(u8::from(i == j))) * home[j]).sum::<f64>());
    let shifts: Vec<String> = (0..3)
        .map(|i| (["X", "Y", "Z"][i], errors[i] + moved[i]))
        .filter(|(_, shift)| shift.abs() > 5e-7)
        .map(|(letter, shift)| format!("{letter} {shift:.2} mm"))
        .collect();
    let said = format!("The errors there ({}) are a shift of the origin", shifts.join(", "));
    assert!(report.left_out.iter().any(|sentence| sentence.contains(&said)), "{said}: {:?}", report.left_out);
    // The screw and its backlash stay for the files.
    let screw = &SCREW[SCREW.find("[[source]]").unwrap()..];
    let machine = Machine::of_spec(Spec::parse("mill.toml", &[&linear, screw].concat()).unwrap(), "mill");
    let [with, without] = [true, false].map(|has_matrix| {
        exported(&machine, Format::LinuxCnc { nodes: 101, has_matrix }).remains.position.largest
    });
    assert!(with < 1e-5 && without > 0.005, "{with} {without}");
    // A rotary axis is refused.
    let table = linear.replace("[[frame]]\nname = \"X\"", "[[frame]]\nname = \"C\"\nvariable = { name = \"c\", kind = \"revolute\", limits = [-1, 1] }\ntransform = \"Rz(c)\"\n[[frame]]\nname = \"X\"");
    let machine = Machine::of_spec(Spec::parse("table.toml", &table).unwrap(), "table");
    let format = Format::LinuxCnc { nodes: 5, has_matrix: true };
    let mistake = Export { machine, format, samples: 5, seed: 0 }.run(&mut ()).unwrap_err();
    assert!(mistake.list[0].message.contains("matrixkins has none"), "{mistake:?}");
}

/// Checks that tables that end at the limits of the axis can be corrected there, where commands
/// exceed the limit by the correction.
#[test]
fn tables_that_end_at_a_limit_are_exported() {
    let machine = Machine::of_spec(Spec::parse("screw.toml", SCREW).unwrap(), "screw");
    let report = exported(&machine, Format::Table { nodes: Some(5) });
    let line = report.files[0].text.lines().nth(1).unwrap();
    let added: f64 = line.split_once(',').unwrap().1.parse().unwrap();
    assert!((added + 0.0075).abs() < 1e-9, "{line}");
    assert!(report.at_nodes.unwrap().position.largest < 1e-9, "{:?}", report.at_nodes);
}

/// Checks a table of corrections: no error at a node, the reported error between nodes, and a
/// smaller one with more nodes.
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

/// Checks that three nodes over two turns of each joint produce a warning.
#[test]
fn a_table_that_makes_it_worse_is_refused() {
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
    let exported = |format| {
        let mut heard = Heard::default();
        let report = Export { machine: found.clone(), format, samples: 200, seed: 0 }.run(&mut heard);
        report.map(|report| (report.remains.position.rms > report.before.position.rms, heard.0))
    };
    let refused = exported(Format::Table { nodes: Some(3) }).unwrap_err().to_string();
    assert!(refused.contains("would make the error of the tool larger"), "{refused}");
    let (worse, warned) = exported(Format::Dh).unwrap();
    assert!(!worse && warned.is_empty(), "{warned:?}");
}
