//! The exact chain with errors of joints, parameters, DH parameters and points on links, far beyond
//! first order, equals the nominal chain of the real machine.

use abbe::analysis::{Configuration, Goal, compensated, monte_carlo};
use abbe::{Function, Manipulator, Pose, chain, drawn_pose, laws, located, real_pose, repeatable_magnitudes};
use abbe_interpreter::Interpreter;
use abbe_spec::Spec;
use abbe_tests::chains::general_chain;

fn robot(text: &str) -> Interpreter {
    Interpreter::new(Spec::parse("exact.toml", text).unwrap_or_else(|mistakes| panic!("{mistakes}")))
}

/// Spec with every notation of a frame. q2 moves two frames, `reach` two frames and the tool.
const FORMS: &str = r#"
[manipulator]
name = "forms"
length = "mm"
[parameters]
reach = "300 mm"
[[frame]]
name = "dh"
variable = { name = "q1", kind = "revolute", limits = [-3, 3] }
dh = { theta = "q1 + 0.3", d = "THE_D mm", a = "reach/2", alpha = "THE_ALPHA" }
[[frame]]
name = "product"
variable = { name = "q2", kind = "revolute", limits = [-3, 3] }
transform = "Tx(reach) Rz(-q2) Ry(0.4)"
[[frame]]
name = "matrix"
variable = { name = "q3", kind = "revolute", limits = [-3, 3] }
matrix = [["cos(q3 + q2)", 0, "sin(q3 + q2)", 10], [0, 1, 0, 20], ["-sin(q3 + q2)", 0, "cos(q3 + q2)", 30], [0, 0, 0, 1]]
[[frame]]
name = "mdh"
variable = { name = "d4", kind = "prismatic", limits = [0, 200] }
mdh = { theta = "THE_THETA", d = "d4", a = "THE_A mm", alpha = 0.5 }
[[frame]]
name = "urdf"
variable = { name = "q5", kind = "revolute", limits = [-3, 3] }
origin = { xyz = ["reach", 5, 6], rpy = [0.1, 0.2, 0.3] }
axis = [0.6, 0, 0.8]
[tool]
transform = "Tx(reach) Rz(0.2) Ty(40)"
"#;

fn forms(numbers: [f64; 4], sources: &str) -> Interpreter {
    let names = ["THE_D", "THE_ALPHA", "THE_THETA", "THE_A"];
    let text = names
        .iter()
        .zip(numbers)
        .fold(FORMS.to_owned(), |text, (name, number)| text.replacen(name, &format!("{number}"), 1));
    robot(&(text + sources))
}

const NOMINAL: [f64; 4] = [120.0, 0.7, 0.9, 60.0];

fn same(found: &Pose, expected: &Pose, tolerance: f64) {
    for (found, expected) in found.0.as_flattened().iter().zip(expected.0.as_flattened()) {
        assert!((found - expected).abs() <= tolerance * expected.abs().max(1.0), "{found} {expected}");
    }
}

fn real(robot: &Interpreter, q: &[f64], s: &[f64]) -> Pose {
    let values = robot.evaluate_unchecked(Function::RealPose, &[q, s].concat()).unwrap();
    let magnitudes = repeatable_magnitudes(robot.description());
    let pose = drawn_pose(robot, q, s, &[], &magnitudes).unwrap();
    let generated = Pose(std::array::from_fn(|j| std::array::from_fn(|i| values[3 * j + i])));
    same(&pose, &generated, 1e-13);
    generated
}

const CONFIGURATIONS: [[f64; 5]; 3] = [[0.0; 5], [0.4, -1.1, 0.8, 120.0, 2.0], [-2.7, 2.2, -0.3, 10.0, -1.4]];

#[test]
fn large_errors_of_joints_and_numbers_are_those_of_another_machine() {
    let sources = r#"
[[source]]
name = "q1"
class = "repeatable"
joint = "q1"
error = "0.02 rad"
[[source]]
name = "q2, and with its own joint"
class = "repeatable"
joint = "q2"
error = "-0.3*cos(q2)"
[[source]]
name = "d4"
class = "repeatable"
joint = "d4"
error = "15 mm"
[[source]]
name = "q5"
class = "repeatable"
joint = "q5"
error = "0.1 rad"
[[source]]
name = "q5 once more"
class = "repeatable"
joint = "q5"
error = "0.05 rad"
[[source]]
name = "reach"
class = "repeatable"
parameter = "reach"
error = "-40 mm"
[[source]]
name = "as built"
class = "repeatable"
frame = "dh"
dh = { d = "7 mm", alpha = "-0.2 rad", theta = "0.04 rad" }
[[source]]
name = "as built, too"
class = "repeatable"
frame = "mdh"
dh = { theta = "0.3 rad", a = "-9 mm" }
"#;
    let robot = forms(NOMINAL, sources);
    let built = forms([NOMINAL[0] + 7.0, NOMINAL[1] - 0.2, NOMINAL[2] + 0.3, NOMINAL[3] - 9.0], "");
    for q in CONFIGURATIONS {
        let [q1, q2, q3, d4, q5] = q;
        let moved = [q1 + 0.02 + 0.04, q2 - 0.3 * q2.cos(), q3, d4 + 15.0, q5 + 0.15];
        same(&real(&robot, &q, &[300.0]), &built.pose(&moved, &[260.0]).unwrap(), 1e-13);
    }
    laws::all(&robot, 20).unwrap_or_else(|failure| panic!("{failure}"));
}

/// Checks a random joint error: 0 in the repeatable pose, and the drawn value in a draw.
#[test]
fn a_drawn_joint_is_a_moved_joint() {
    let robot = forms(
        NOMINAL,
        "[[source]]\nname = \"encoder\"\nclass = \"random\"\ndistribution = \"uniform\"\njoint = \"q2\"\nerror = \"0.02 rad\"\n",
    );
    for q in CONFIGURATIONS {
        same(&real(&robot, &q, &[300.0]), &robot.pose(&q, &[300.0]).unwrap(), 1e-13);
        for magnitude in [-1.0, 0.25, 1.0] {
            let mut moved = q;
            moved[1] += 0.02 * magnitude;
            let drawn = drawn_pose(&robot, &q, &[300.0], &[], &[magnitude]).unwrap();
            same(&drawn, &robot.pose(&moved, &[300.0]).unwrap(), 1e-13);
        }
    }
}

const LOCATED: &str = r#"
[[source]]
name = "first"
class = "repeatable"
frame = "product"
at = "Tx(-50) Rz(0.3)"
e_x = "2 mm"
e_s = "0.03 rad"
e_r = "-0.02 rad"
[[source]]
name = "of the frame"
class = "repeatable"
frame = "product"
e_y = "1.5 mm"
e_p = "0.05 rad"
[[source]]
name = "second"
class = "repeatable"
frame = "product"
at = "Ty(reach) Rx(q1)"
e_z = "1 mm"
e_p = "0.04 rad"
[[source]]
name = "joint"
class = "repeatable"
joint = "q2"
error = "0.01"
"#;

/// Checks `A(q + δq) · L₁ E₁ L₁⁻¹ · L₂ E₂ L₂⁻¹ · E`, in this order.
#[test]
fn located_errors_are_exact_and_in_the_order_of_the_file() {
    let robot = forms(NOMINAL, LOCATED);
    for q in CONFIGURATIONS {
        let mut moved = q;
        moved[1] += 0.01;
        let mut transforms = vec![Pose::IDENTITY; 6];
        robot.transforms(&moved, &[300.0], &mut transforms).unwrap();
        // q2 moves the matrix, too; it is the only error.
        let turn = |axis: usize, angle: f64| {
            let (s, c) = angle.sin_cos();
            let mut pose = Pose::IDENTITY;
            let (j, k) = ((axis + 1) % 3, (axis + 2) % 3);
            pose.0[j][j] = c;
            pose.0[j][k] = s;
            pose.0[k][k] = c;
            pose.0[k][j] = -s;
            pose
        };
        let (mut first, mut second) = (turn(2, 0.3), turn(0, q[0]));
        first.0[3] = [-50.0, 0.0, 0.0];
        second.0[3] = [0.0, 300.0, 0.0];
        let there = [
            located(&first, &[2.0, 0.0, 0.0, 0.03, -0.02, 0.0]),
            located(&second, &[0.0, 0.0, 1.0, 0.0, 0.0, 0.04]),
            [0.0, 1.5, 0.0, 0.0, 0.0, 0.05],
        ];
        let mut expected = chain(&transforms[..2]);
        for errors in there {
            expected = expected.then(&real_pose(&[Pose::IDENTITY, Pose::IDENTITY], &[errors]));
        }
        expected = expected.then(&chain(&transforms[2..]));
        same(&real(&robot, &q, &[300.0]), &expected, 1e-13);
    }
    laws::all(&robot, 20).unwrap_or_else(|failure| panic!("{failure}"));
}

/// Checks 10 mrad at 500 mm: the tool is 500 (1 − cos 0.01) = 0.025 mm too near, a second-order
/// error.
#[test]
fn what_first_order_neglects_of_a_located_error() {
    let text = |class: &str| {
        format!(
            "[manipulator]\nname = \"bar\"\nlength = \"mm\"\n[[frame]]\nname = \"end\"\nvariable = {{ name = \"q1\", kind = \"revolute\" }}\ntransform = \"Rz(q1) Tx(500)\"\n[[source]]\nname = \"foot\"\n{class}\nframe = \"end\"\nat = \"Tx(-500)\"\ne_r = \"0.01\"\n"
        )
    };
    let expected = -500.0 * (1.0 - 0.01_f64.cos());
    let home = Configuration { q: vec![0.0], s: vec![], u: vec![] };
    let repeatable = monte_carlo(&robot(&text("class = \"repeatable\"")), &home, 10, 1).unwrap();
    assert!((repeatable.mean[0] - expected).abs() < 1e-12, "{:?}", repeatable.mean);
    // Uniform: the mean of 500 (cos x − 1) over |x| < 0.01.
    let random = robot(&text("class = \"random\"\ndistribution = \"uniform\""));
    let random = monte_carlo(&random, &home, 20_000, 1).unwrap();
    let mean = 500.0 * (0.01_f64.sin() / 0.01 - 1.0);
    assert!((random.mean[0] - mean).abs() < 3.0 * (random.covariance[0][0] / 20_000.0).sqrt());
    assert!(random.covariance[0][0] > 0.0 && random.first_order[0][0] == 0.0);
}

/// Checks that the compensator corrects the zero error of a joint by moving that joint back.
#[test]
fn compensated_joints_are_moved_back() {
    let robot = forms(
        NOMINAL,
        "[[source]]\nname = \"zero\"\nclass = \"repeatable\"\njoint = \"q1\"\nerror = \"0.02 rad\"\n[[source]]\nname = \"scale\"\nclass = \"repeatable\"\njoint = \"d4\"\nerror = \"0.01*d4\"\n",
    );
    let q = CONFIGURATIONS[1];
    let command = compensated(&robot, Goal::default(), &q, &[300.0], &[]).unwrap();
    let expected = [q[0] - 0.02, q[1], q[2], q[3] / 1.01, q[4]];
    for (found, expected) in command.q.iter().zip(expected) {
        assert!((found - expected).abs() < 1e-6, "{:?}", command.q);
    }
}

/// Compares the loops over the frames of a long chain with straight-line code.
#[test]
fn long_chains_are_exact_as_well() {
    let sources = r#"
[parameters]
rail = "0.3 m"
[tool]
transform = "Tx(rail) Rz(0.2)"
[[source]]
name = "joint"
class = "repeatable"
joint = "q4"
error = "0.1 rad"
[[source]]
name = "place"
class = "repeatable"
frame = "7"
at = "Tx(rail) Rz(q0)"
e_x = "0.01 m"
e_s = "0.2 rad"
[[source]]
name = "frame"
class = "random"
distribution = "normal"
frame = "7"
e_r = "0.1 rad"
[[source]]
name = "built"
class = "random"
distribution = "uniform"
frame = "12"
dh = { alpha = "0.2 rad", a = "0.02 m" }
[[source]]
name = "tool"
class = "repeatable"
parameter = "rail"
error = "0.05 m"
"#;
    let spec = Spec::parse("long.toml", &(general_chain(40) + sources)).unwrap();
    let (looped, straight) = (Interpreter::new(spec.clone()), Interpreter::without_loops(spec));
    let q: Vec<f64> = (0..40).map(|i| 0.3 * f64::from(i).sin()).collect();
    for magnitudes in [[1.0, 1.0, 0.0, 0.0, 1.0], [0.5, -1.0, 1.3, -0.7, 2.0]] {
        let [a, b] =
            [&looped, &straight].map(|robot| drawn_pose(robot, &q, &[0.3], &[], &magnitudes).unwrap());
        same(&a, &b, 1e-12);
    }
    let mut moved = q.clone();
    moved[4] += 0.1;
    let magnitudes = [1.0, 0.0, 0.0, 0.0, 1.0];
    let expected = looped.pose(&moved, &[0.35]).unwrap();
    same(&drawn_pose(&looped, &q, &[0.3], &[], &magnitudes).unwrap(), &expected, 1e-12);
    same(&real(&looped, &q, &[0.3]), &real(&straight, &q, &[0.3]), 1e-12);
}
