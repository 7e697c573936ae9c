//! Arguments that are no numbers, functions without a value, and poses without Euler angles:
//! statuses, never an operation that stops a controller.

use abbe::Manipulator;
use abbe::analysis::sampling::{nominal_inputs, nominal_parameters};
use abbe_interpreter::Interpreter;
use abbe_spec::Spec;
use abbe_tests::languages::open_linkage;
use abbe_tests::structured_text::Program;
use abbe_tests::{sample_size, specs};
use rand::{RngExt, SeedableRng};
use rand_xoshiro::Xoshiro256PlusPlus;

use super::{shipped, text};

/// Functions that have no value at `q1 < 0`, and a division by `q1`.
const FUNCTIONS: &str = r#"
[manipulator]
name = "functions"
length = "m"
[[frame]]
name = "first"
variable = { name = "q1", kind = "prismatic", limits = ["-2 m", "2 m"] }
transform = "Tx(q1) Ty(FUNCTION)"
"#;

#[test]
fn functions_without_a_value_are_a_status() {
    // A function, and numbers at which it has no value.
    let cases: [(&str, &[f64]); 9] = [
        ("1 m*sqrt(q1/(1 m))", &[-1e-300, -1.0]),
        ("1 m*log(q1/(1 m))", &[0.0, -1.0]),
        ("1 m*asin(q1/(1 m))", &[1.5, -1.5]),
        ("1 m*acos(q1/(1 m))", &[1.5, -1.5]),
        ("1 m*exp(400*q1/(1 m))", &[2.0]),
        ("(1 m)^2/q1", &[0.0, 1e-308]),
        ("1 m*(q1/(1 m))^0.3", &[-1.0]),
        ("1 m*(q1/(1 m))^(-1.5)", &[0.0]),
        ("1 m*(q1/(1 m))^(-3)", &[0.0]),
    ];
    for (function, without) in cases {
        let spec = Spec::parse("functions.toml", &FUNCTIONS.replace("FUNCTION", function)).unwrap();
        let program = Program::parse(&text(&spec)).unwrap();
        let robot = Interpreter::new(spec);
        let mut pose = program.instance("functions_pose");
        for q in without {
            pose.set("q", &[*q]);
            pose.call().unwrap_or_else(|fault| panic!("{function} at {q} stops the controller: {fault}"));
            assert_eq!(pose.get("status"), [1.0], "{function} at {q}");
        }
        for q in [0.25, 0.34, -0.3] {
            pose.set("q", &[q]);
            pose.call().unwrap();
            let expected = robot.evaluate_unchecked(abbe::Function::Pose, &[q]).unwrap();
            if expected.iter().all(|number| number.is_finite()) {
                assert_eq!(pose.get("pose"), expected, "{function} at {q}");
                assert_eq!(pose.get("status"), [0.0], "{function} at {q}");
            } else {
                assert_eq!(pose.get("status"), [1.0], "{function} at {q}");
            }
        }
    }
}

#[test]
fn loops_that_do_not_close_are_a_status() {
    let spec = Spec::read(specs::path("linkage")).unwrap();
    let program = Program::parse(&text(&spec)).unwrap();
    let given = open_linkage(&Interpreter::new(spec));
    for function in ["pose", "passive", "error_jacobian"] {
        let mut block = program.instance(&format!("linkage_{function}"));
        super::set(&mut block, "q", &given[..3]);
        super::set(&mut block, "s", &given[3..7]);
        block.call().unwrap_or_else(|fault| panic!("{function} stops the controller: {fault}"));
        assert_eq!(block.get("status"), [-1.0], "{function}");
    }
}

/// Checks a controller without floating-point exceptions: NaN is a status, and outputs are
/// those of the cycle before. With exceptions it stops at the first comparison.
#[test]
fn arguments_that_are_not_finite_are_a_status() {
    let program = Program::parse(&text(&shipped("pps"))).unwrap();
    let mut block = program.instance("pps_compensated");
    let q = [9.0, 80.0, 987.0, 1.2, 0.02, 0.01];
    block.set("q", &q);
    block.call().unwrap();
    let valid = ["corrected", "correction", "before", "after", "last"].map(|name| block.get(name));
    let names = ["q", "parameters", "inputs", "rotations"];
    for (name, wrong) in
        names.into_iter().flat_map(|name| [f64::NAN, f64::INFINITY, -1e31].map(|x| (name, x)))
    {
        let mut other = block.clone();
        other.has_exceptions = false;
        let count = other.get(name).len();
        let mut values = other.get(name);
        values[count - 1] = wrong;
        other.set(name, &values);
        other.call().unwrap();
        let status = if name == "inputs" { 3.0 } else { 1.0 };
        assert_eq!(other.get("status"), [status], "{name} {wrong}");
        let kept = ["corrected", "correction", "before", "after", "last"].map(|name| other.get(name));
        assert_eq!(kept, valid);
    }
    // Bounds that are no numbers permit nothing.
    for name in ["change", "largest"] {
        let mut other = block.clone();
        other.has_exceptions = false;
        other.set(name, &[f64::NAN; 6]);
        other.call().unwrap();
        assert!(other.get("status")[0] == 5.0 && other.get("correction").iter().all(|d| d.is_finite()));
    }
    // Before the first valid cycle, the status is no success.
    assert_eq!(program.instance("pps_compensated").get("status"), [1.0]);
}

#[test]
fn poses_without_euler_angles_are_a_status() {
    let text = r#"
[manipulator]
name = "euler"
length = "m"
orientation = "euler-yzx"
[[frame]]
name = "turn"
variable = { name = "q1", kind = "revolute", limits = [-4, 4] }
transform = "Rz(q1) Tx(1 m)"
"#;
    let program = Program::parse(&super::text(&Spec::parse("euler.toml", text).unwrap())).unwrap();
    let mut block = program.instance("euler_error_jacobian");
    for (q, status) in [(0.3, 0.0), (core::f64::consts::FRAC_PI_2, 2.0), (1.0, 0.0)] {
        block.set("q", &[q]);
        block.call().unwrap();
        assert_eq!(block.get("status"), [status], "at {q}");
    }
}

/// Whatever is commanded, no operation stops a controller, and commands are within the limits.
#[test]
fn random_commands_stop_nothing() {
    for name in ["pps", "ur5", "scara", "iiwa"] {
        let spec = shipped(name);
        let program = Program::parse(&text(&spec)).unwrap();
        let robot = Interpreter::new(spec);
        let description = robot.description();
        let mut block = program.instance(&format!("{name}_compensated"));
        super::set(&mut block, "s", &nominal_parameters(description));
        super::set(&mut block, "u", &nominal_inputs(description));
        let mut random = Xoshiro256PlusPlus::seed_from_u64(17);
        for index in 0..sample_size(2000) / 20 {
            let far = [0.0, 0.1, 1e3, 1e25][index % 4];
            let command = |lower: f64, upper: f64, random: &mut Xoshiro256PlusPlus| {
                lower + random.random_range(-far..1.0 + far) * (upper - lower)
            };
            let limits = description.variables.iter().map(|variable| variable.limits);
            let q: Vec<f64> =
                limits.clone().map(|[lower, upper]| command(lower, upper, &mut random)).collect();
            block.set("q", &q);
            block.set("resume", &[f64::from(u8::from(index % 5 == 0))]);
            block.set("standing", &limits.clone().map(|[_, upper]| far * upper).collect::<Vec<_>>());
            block.set("rotations", &[1.0, (index % 2) as f64, (index % 3) as f64]);
            block.call().unwrap_or_else(|fault| panic!("{name} at {q:?} stops the controller: {fault}"));
            for (value, [lower, upper]) in block.get("corrected").iter().zip(limits) {
                assert!((lower..=upper).contains(value), "{value}");
            }
        }
    }
}
