//! The drawings of `docs/reference/conventions.md`, from the frames of generated code.
//! `UPDATE_EXPECT=1` writes them.

mod sheet;

use std::path::PathBuf;

use abbe::Manipulator;
use abbe_interpreter::Interpreter;
use abbe_spec::Spec;
use expect_test::expect_file;
use sheet::{Frame, GREY, INK, LINK, Point, RED, Sheet, arc};

fn compare(name: &str, sheet: Sheet) {
    let path = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../docs/reference").join(name);
    expect_file![path].assert_eq(&sheet.finish());
}

/// Arm of two joints whose upper arm has DH parameters: F_2 is at its far end.
const ARM: &str = r#"
[manipulator]
name = "arm"
length = "mm"

[[frame]]
name = "column"
transform = "Tz(260)"

[[frame]]
name = "upper arm"
variable = { name = "q2", kind = "revolute" }
dh = { theta = "q2", d = 0, a = 400, alpha = 0 }

[[frame]]
name = "elbow"
variable = { name = "q3", kind = "revolute" }
transform = "Tz(110) Rz(q3)"

[tool]
transform = "Tx(450)"
"#;

/// Returns `F_0 … F_n` at q, and the tool point.
fn frames(q: &[f64]) -> (Vec<Frame>, Point) {
    let spec = Spec::parse("arm.toml", ARM).unwrap();
    let frame = |count: usize, tool: bool| {
        let mut part = spec.clone();
        part.frames.truncate(count);
        part.tool_frame = count.saturating_sub(1);
        part.variables.retain(|variable| variable.frame < count);
        if !tool {
            part.tool.clear();
        }
        let q = &q[..part.variables.len()];
        if count == 0 {
            return Frame { origin: [0.0; 3], axes: [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]] };
        }
        let [x, y, z, origin] = Interpreter::new(part).pose(q, &[]).unwrap().0;
        Frame { origin, axes: [x, y, z] }
    };
    let all = (0..=spec.frames.len()).map(|count| frame(count, false)).collect();
    (all, frame(spec.frames.len(), true).origin)
}

/// Returns the midpoint of two points.
fn middle(a: Point, b: Point) -> Point {
    std::array::from_fn(|i| (a[i] + b[i]) / 2.0)
}

#[test]
fn frames_of_a_chain() {
    let (f, tool) = frames(&[0.05, 0.1]);
    let mut sheet =
        Sheet::new("The frames of a chain", [760.0, 340.0], [-65.0, 30.0]).placed(0.66, [110.0, 285.0]);
    sheet.line(&[f[0].origin, f[1].origin, f[2].origin, f[3].origin, tool], LINK, 8.0, false);
    for frame in &f {
        sheet.axes(frame, 80.0, true);
    }
    sheet.dot(tool, 5.0, RED);
    sheet.label(f[0].origin, [-40.0, 14.0], "F_0", INK);
    sheet.label(f[1].origin, [-40.0, 4.0], "F_1", INK);
    sheet.label(f[2].origin, [-16.0, 28.0], "F_2", INK);
    sheet.label(f[3].origin, [-40.0, 4.0], "F_3", INK);
    sheet.label(tool, [12.0, 5.0], "tool point", RED);
    sheet.label(middle(f[0].origin, f[1].origin), [-76.0, 6.0], "A_1 E_1", GREY);
    sheet.label(middle(f[1].origin, f[2].origin), [-20.0, 30.0], "A_2 E_2", GREY);
    sheet.label(middle(f[2].origin, f[3].origin), [-66.0, -2.0], "A_3 E_3", GREY);
    sheet.label(middle(f[3].origin, tool), [0.0, -14.0], "T", GREY);
    compare("chain.svg", sheet);
}

#[test]
fn six_errors_of_a_frame() {
    let frame = Frame { origin: [0.0; 3], axes: [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]] };
    let mut sheet =
        Sheet::new("The six errors of a frame", [760.0, 340.0], [-50.0, 24.0]).placed(1.0, [280.0, 225.0]);
    sheet.axes(&frame, 210.0, true);
    let named =
        [("e_x", "e_p (pitch, about x)"), ("e_y", "e_s (spin, about y)"), ("e_z", "e_r (roll, about z)")];
    let places =
        [([-4.0, 24.0], [-30.0, 56.0]), ([-10.0, -12.0], [-48.0, -42.0]), ([-36.0, 4.0], [44.0, 4.0])];
    for (axis, ((shift, turn), (by_shift, by_turn))) in named.into_iter().zip(places).enumerate() {
        sheet.arrow(&[frame.point(axis, 40.0), frame.point(axis, 95.0)], RED, 3.4);
        sheet.label(frame.point(axis, 70.0), by_shift, shift, RED);
        sheet.arrow(&arc(&frame, axis, [34.0, 150.0], [-150.0, 130.0]), RED, 2.0);
        sheet.label(frame.point(axis, 150.0), by_turn, turn, RED);
    }
    sheet.label(frame.origin, [-30.0, 22.0], "F_i", INK);
    compare("six-errors.svg", sheet);
}

/// Checks that an encoder error rotates about the axis of its joint, unlike `e_r` of the frame
/// after a DH length.
#[test]
fn axis_of_an_encoder() {
    let q = [0.0, 0.0];
    let robot = Interpreter::new(Spec::parse("arm.toml", ARM).unwrap());
    let norm = |column: &[f64]| column[..3].iter().map(|v| v * v).sum::<f64>().sqrt();
    let mut error_jacobian = vec![[0.0; 6]; 18];
    robot.error_jacobian(&q, &[], &mut error_jacobian).unwrap();
    let mut joint_jacobian = vec![[0.0; 6]; 2];
    robot.joint_jacobian(&q, &[], &mut joint_jacobian).unwrap();
    assert!((norm(&joint_jacobian[0]) - 850.0).abs() < 1e-9, "the joint turns about the shoulder");
    assert!((norm(&error_jacobian[6 + 4]) - 450.0).abs() < 1e-9, "e_r of F_2 turns about the elbow");

    let (f, tool) = frames(&q);
    let mut sheet =
        Sheet::new("Which axis an encoder turns", [760.0, 250.0], [-70.0, 38.0]).placed(0.62, [90.0, 272.0]);
    sheet.line(&[f[1].origin, f[2].origin, f[3].origin, tool], LINK, 8.0, false);
    for (about, colour, lever, angle) in [(&f[1], RED, 850.0, 16.0), (&f[2], GREY, 450.0, 30.0)] {
        sheet.line(&[about.point(2, -60.0), about.point(2, 230.0)], colour, 1.6, true);
        let path = arc(about, 2, [lever, 110.0], [0.0, angle]);
        sheet.line(&[about.point(2, 110.0), path[path.len() - 1]], colour, 1.2, true);
        sheet.arrow(&path, colour, 2.4);
    }
    sheet.axes(&f[1], 80.0, true);
    sheet.axes(&f[2], 80.0, true);
    sheet.dot(tool, 5.0, INK);
    sheet.label(f[1].origin, [-40.0, 10.0], "F_1", INK);
    sheet.label(f[2].origin, [-34.0, 24.0], "F_2", INK);
    sheet.label(tool, [10.0, 16.0], "tool point", INK);
    sheet.label(f[1].point(2, 230.0), [8.0, 4.0], "axis of q2: joint = \"q2\", lever 850 mm", RED);
    sheet.label(f[2].point(2, 230.0), [8.0, 4.0], "z of F_2: frame = \"upper arm\", e_r, lever 450 mm", GREY);
    compare("encoder.svg", sheet);
}
