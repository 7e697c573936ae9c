//! Compensation tables of a machine with rotary axes that carry the workpiece.

use abbe::{Manipulator, drawn_pose, repeatable_magnitudes};
use abbe_interpreter::Interpreter;
use abbe_spec::Spec;
use abbe_study::Machine;
use abbe_study::export::{Export, Format};
use nalgebra::Vector3;

use super::slides::{mill, rows};
use super::{exported, matrix};

/// Trunnion: the table rotates about Z on a cradle that tilts about X, 50 mm below; slides along X,
/// Y and Z carry the tool.
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

/// Errors of the locations of its rotary axes.
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

/// Errors of the slides.
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

/// Checks the reported locations of the rotary axes. Relative to the bed, a point of the table
/// moves on a circle about the axis of the table: the mean of three positions a third of a turn
/// apart is on the axis. Two heights determine the axis. The axis of the trunnion follows in the
/// same way from points of the cradle.
#[test]
fn axes_that_turn_stand_where_the_report_says() {
    let machine = trunnion(ELSEWHERE);
    let report = exported(&machine, Format::IsgCsv { nodes: 5 });
    let arm = Interpreter::new(machine.spec.clone());
    let (s, magnitudes) = (vec![], repeatable_magnitudes(arm.description()));
    // The slides are error-free: with all of them at 0, the tool differs from the bed by a
    // constant.
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
    // Axis of the table on the trunnion, at the table and 100 mm above; the location of the
    // trunnion itself is checked below.
    let centre = |height: f64| {
        moved(&|is_real| {
            let places =
                [0.0, third, -third].map(|c| on_table(c, 0.0, Vector3::new(70.0, -20.0, height), is_real));
            (places[0] + places[1] + places[2]) / 3.0
        })
    };
    // Axis of the trunnion on the bed: points that do not move when it tilts, 100 mm to either side
    // of the center of the table.
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
    // A rotation (A, B, C) takes X to (1, C, -B).
    let close = |a: f64, b: f64| (a - b).abs() < 1e-6;
    assert!(close(a.position[1], middle.y) && close(a.position[2], middle.z), "{a:?} {middle}");
    assert!((a.angles[2] - across.y).abs() < 1e-8 && (a.angles[1] + across.z).abs() < 1e-8, "{a:?} {across}");
    // Its own 15 um, and 5 um by the rotation of the following part, 250 mm away.
    assert!((a.position[1] + 0.010).abs() < 1e-4 && (a.angles[1] + 35e-6).abs() < 1e-8, "{a:?}");
    // Error of C without that of the trunnion at the height of the table, 50 mm above its axis.
    let (low, high) = (centre(0.0), centre(100.0));
    let upright = (high - low) / 100.0;
    let turn = Vector3::from(a.angles);
    let carried = Vector3::from(a.position) + turn.cross(&Vector3::new(0.0, 0.0, 50.0));
    let own = low - carried;
    assert!(close(c.position[0], own.x) && close(c.position[1], own.y), "{c:?} {own}");
    // A rotation takes Z to (B, -A, 1).
    let own = upright - turn.cross(&Vector3::z());
    assert!((c.angles[1] - own.x).abs() < 1e-8 && (c.angles[0] + own.y).abs() < 1e-8, "{c:?} {own}");
    assert!((c.position[0] + 0.012).abs() < 1e-6 && (c.angles[0] + 40e-6).abs() < 1e-8, "{c:?}");
}

/// Errors of the axes that vary with their angles, and of their encoders.
const TURNING: &str = r#"
[[source]]
name = "run-out of C"
class = "repeatable"
frame = "C"
e_x = "3 um * cos(c)"
e_p = "15e-6 * sin(c)"
[[source]]
name = "encoder of C"
class = "repeatable"
joint = "c"
error = "30e-6 * sin(c)"
[[source]]
name = "encoder of A"
class = "repeatable"
joint = "a"
error = "-20e-6 * a"
"#;

/// Checks that tables of the rotary axes hold their locations and what varies with their angles,
/// and that LinuxCNC, whose files hold only the angle, needs their locations as well.
#[test]
fn tables_hold_the_errors_of_axes_that_turn() {
    let all = trunnion(&[ELSEWHERE, SLIDES, TURNING].concat());
    let report = exported(&all, Format::IsgCsv { nodes: 101 });
    assert!(report.before.position.rms > 0.02 && report.placed.is_none(), "{:?}", report.before);
    assert!(report.remains.position.largest < 2e-5, "{:?}", report.remains);
    // Orientations are unchanged, up to the effect of 0.1 mm of the slides.
    assert!((report.remains.angle.rms / report.before.angle.rms - 1.0).abs() < 1e-3, "{report:?}");
    let report = exported(
        &trunnion(&[ELSEWHERE, TURNING].concat()),
        Format::LinuxCnc { nodes: 201, has_matrix: false },
    );
    let names: Vec<&str> = report.files.iter().map(|file| file.name.as_str()).collect();
    assert_eq!(names, ["x.comp", "y.comp", "z.comp", "c.comp", "a.comp"]);
    let placed = report.placed.unwrap();
    // The run-out of C stays: 3 um, and 15 urad with the lever of the tool above the trunnion.
    assert!(report.remains.position.rms > 0.02 && placed.position.largest < 0.012, "{placed:?}");
    // Only the encoder turns C about itself; nothing is added at home.
    for line in rows(&report.files[3].text) {
        let error = (30e-6 * line[0].to_radians().sin()).to_degrees();
        assert!((line[1] - line[0] - error).abs() < 1e-6 && line[1] == line[2], "{line:?}");
    }
    // Without rotary axes of the workpiece there is nothing to locate.
    let mill = exported(&mill(), Format::IsgCsv { nodes: 11 });
    assert!(mill.placed.is_none() && mill.turned.is_empty());
}

/// Checks that located axes leave nothing in LinuxCNC if only their locations are wrong.
#[test]
fn located_axes_hold_a_machine_whose_axes_turn_true() {
    let report = exported(&trunnion(ELSEWHERE), Format::LinuxCnc { nodes: 11, has_matrix: false });
    let placed = report.placed.unwrap();
    // The files have six decimals of a degree.
    assert!(report.before.position.rms > 0.02 && placed.position.largest < 1e-6, "{placed:?}");
    assert!((report.remains.position.rms / report.before.position.rms - 1.0).abs() < 0.05, "{report:?}");
}

/// Checks the sign of the tables of rotary axes against ISO 230-1: the error of the table is its
/// displacement, seen from the bed. `E_i` displaces the bed against the table.
#[test]
fn tables_of_rotary_axes_hold_the_displacement_of_the_table() {
    let report = exported(&trunnion(ELSEWHERE), Format::IsgCsv { nodes: 5 });
    let block = report.files[0].text.split("\n#\n").nth(4).unwrap();
    let (heading, lines) = block.split_once('\n').unwrap();
    assert_eq!(heading, "C EXC EYC EZC EAC EBC ECC");
    let lines = rows(lines);
    assert_eq!(lines.iter().map(|line| line[0]).collect::<Vec<_>>(), [-180.0, -90.0, 0.0, 90.0, 180.0]);
    for line in &lines {
        let expected = [-0.012, 0.018, 0.0, -40e-6, 25e-6, 0.0];
        assert!(line[1..].iter().zip(expected).all(|(a, b)| (a - b).abs() < 1e-6), "{line:?}");
        assert!((line[4] + 40e-6).abs() < 2e-9 && (line[5] - 25e-6).abs() < 2e-9, "{line:?}");
    }
    let first = report.files[0].text.lines().nth(1).unwrap();
    assert_eq!(first, "P0X P0Y P0Z PXC PYC PZC PXA PYA PZA");
    let points = rows(report.files[0].text.lines().nth(2).unwrap());
    // C is at the origin of F_0, which is 250, 200 and -200 mm from the reference point.
    assert_eq!(points[0], [0.0, 0.0, -120.0, 250.0, 200.0, -200.0, 250.0, 200.0, -250.0]);
}

/// Checks that a swivel head after the slides is refused: its angles change the lever arm.
#[test]
fn a_head_is_refused() {
    let head = TRUNNION.replace("[tool]", "[[frame]]\nname = \"B\"\nvariable = { name = \"b\", kind = \"revolute\", limits = [-1, 1] }\ntransform = \"Ry(b)\"\n[tool]");
    let machine = Machine::of_spec(Spec::parse("head.toml", &head).unwrap(), "head");
    for format in [Format::IsgCsv { nodes: 5 }, Format::LinuxCnc { nodes: 5, has_matrix: false }] {
        let mistake =
            Export { machine: machine.clone(), format, samples: 5, seed: 0 }.run(&mut ()).unwrap_err();
        assert!(mistake.list[0].message.contains("`b` is a rotary axis of the tool"), "{mistake:?}");
    }
}
