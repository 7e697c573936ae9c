//! Closed loops: the machine closes, and `J_e` is the derivative of the machine that closes with
//! errors.

use abbe::analysis::sampling::halton;
use abbe::{Component, Function, Manipulator, Pose, laws};
use abbe_interpreter::Interpreter;
use abbe_spec::{Identified, Source, Spec, Uncertain};
use abbe_tests::closed_machines::{FOUR_BAR, hexapod};
use abbe_tests::specs;

mod closed;
mod closed_forms;
mod inverse;
mod modes;
mod random;
mod statics;

fn interpreter(text: &str) -> Interpreter {
    Interpreter::new(Spec::parse("machine.toml", text).unwrap_or_else(|mistakes| panic!("{mistakes}")))
}

#[test]
fn laws_hold() {
    let machine = interpreter(FOUR_BAR);
    laws::all(&machine, 50).unwrap_or_else(|failure| panic!("{failure}"));
}

/// An error of the command of a leg has the effect of that command, exactly and to first order.
#[test]
fn an_error_of_a_leg_is_one_of_its_command() {
    let page = include_str!("../../../../docs/reference/spec.md");
    let text = page.split("```").find_map(|block| block.strip_prefix("toml\n# lift.toml\n")).unwrap();
    let lift = interpreter(text);
    for q in [-80.0, -30.0, 0.0, 25.0, 39.0] {
        let (real, moved) = (lift.real_pose(&[q], &[], &[]).unwrap(), lift.pose(&[q + 0.2], &[]).unwrap());
        for (found, expected) in real.0.as_flattened().iter().zip(moved.0.as_flattened()) {
            assert!((found - expected).abs() < 1e-11 * 500.0, "{found}, not {expected}");
        }
        let (mut joint, mut columns, mut errors) = ([[0.0; 6]], [[0.0; 6]; 18], [[0.0; 6]; 3]);
        lift.joint_jacobian(&[q], &[], &mut joint).unwrap();
        lift.error_jacobian(&[q], &[], &mut columns).unwrap();
        lift.generalized_errors(&[q], &[], &[], &mut errors).unwrap();
        for row in 0..6 {
            let terms = columns.iter().zip(errors.as_flattened()).map(|(column, error)| column[row] * error);
            let (found, expected) = (terms.sum::<f64>(), 0.2 * joint[0][row]);
            assert!((found - expected).abs() < 1e-12, "{found}, not {expected}");
        }
    }
}

#[test]
fn batches_equal_single_configurations() {
    let machine = interpreter(FOUR_BAR);
    let found = laws::batches(&machine, 50).unwrap_or_else(|failure| panic!("{failure}"));
    assert!(found.relative <= laws::ROUNDING_TOLERANCE, "{found:?}");
}

/// Returns the pose and `J_q` of a machine.
fn joint_jacobian(machine: &dyn Manipulator, q: &[f64], s: &[f64]) -> (Pose, Vec<[f64; 6]>) {
    let mut columns = vec![[0.0; 6]; q.len()];
    (machine.joint_jacobian(q, s, &mut columns).unwrap(), columns)
}

fn mechanism(name: &str) -> Interpreter {
    let path = format!("{}/../manipulators/mechanisms/{name}.toml", env!("CARGO_MANIFEST_DIR"));
    Interpreter::new(Spec::read(path).unwrap_or_else(|mistakes| panic!("{mistakes}")))
}

/// Returns configurations within the limits of the joints.
fn samples(machine: &Interpreter, count: usize) -> Vec<Vec<f64>> {
    let variables = &machine.description().variables;
    let sample = |index: usize| {
        let value = |(i, variable): (usize, &abbe::Variable)| {
            let [lower, upper] = variable.limits;
            lower + (upper - lower) * halton(index + 1, i)
        };
        variables.iter().enumerate().map(value).collect()
    };
    (0..count).map(sample).collect()
}

fn assert_close(found: &[f64], expected: &[f64], scale: f64) {
    assert_eq!(found.len(), expected.len());
    for (a, b) in found.iter().zip(expected) {
        assert!((a - b).abs() <= 1e-12 * scale, "{found:?}, expected {expected:?}");
    }
}

/// A platform that six passive joints move freely, on one, two and three coordinates of balls that
/// are fixed to it: the axes of these coordinates move with the platform, but not with the errors
/// of the balls.
#[test]
fn errors_of_balls_in_grooves_obey_the_laws() {
    let mut text = "[manipulator]\nname = \"coupling\"\nlength = \"mm\"\n".to_owned();
    let mut frame = |name: &str, parent: &str, transform: &str, variable: &str| {
        let variable = match variable {
            "" => String::new(),
            given => format!("variable = {{ {given} }}\n"),
        };
        let rest = format!("parent = \"{parent}\"\ntransform = \"{transform}\"\n{variable}");
        text += &format!("[[frame]]\nname = \"{name}\"\n{rest}");
    };
    let names = ["base", "x", "y", "z", "a", "b", "c"];
    for (pair, motion) in names.windows(2).zip(["Tx", "Ty", "Tz", "Rx", "Ry", "Rz"]) {
        let [parent, name] = [pair[0], pair[1]];
        let kind = if motion.starts_with('T') { "prismatic" } else { "revolute" };
        let variable = format!("name = \"{name}\", kind = \"{kind}\", passive = true, home = 0.0");
        frame(name, parent, &format!("{motion}({name})"), &variable);
    }
    let places = ["Tx(0)", "Tx(300)", "Tx(100) Ty(250)"];
    for (i, place) in places.iter().enumerate() {
        let variable = format!("name = \"q{i}\", kind = \"prismatic\", limits = [-30, 40], home = 0.0");
        frame(&format!("post{i}"), "base", &format!("{place} Tz(q{i})"), &variable);
        frame(&format!("ball{i}"), "c", place, "");
    }
    for (i, closes) in [r#""x", "y", "z""#, r#""y", "z""#, r#""z""#].iter().enumerate() {
        text +=
            &format!("[[loop]]\nname = \"{i}\"\nframes = [\"post{i}\", \"ball{i}\"]\ncloses = [{closes}]\n");
    }
    text += "[tool]\nframe = \"c\"\ntransform = \"Tx(50) Ty(60) Tz(70)\"\n";
    let machine = interpreter(&text);
    laws::all(&machine, 20).unwrap_or_else(|failure| panic!("{failure}"));
}

abbe_macro::manipulator!("specs/linkage.toml");
abbe::test_manipulator!(generated_linkage: linkage::Linkage);
abbe_macro::manipulator!("specs/planar.toml");
abbe::test_manipulator!(generated_planar: planar::Planar);

/// Generated code finds the passive variables that the interpreter finds, and refuses what does not
/// close.
#[test]
fn generated_code_finds_passive_variables() {
    let machine = Interpreter::new(Spec::read(specs::path("linkage")).unwrap());
    let parameters = linkage::Parameters::NOMINAL;
    for q in samples(&machine, 20) {
        let mut expected = [0.0; 3];
        machine.passive(&q, &parameters.to_array(), &mut expected).unwrap();
        let found = linkage::passive(&[q[0], q[1], q[2]], &parameters).unwrap();
        assert_close(&found, &expected, 1.0);
        let errors = [[1e-3; 6]; linkage::FRAMES];
        let real = linkage::displaced_pose(&[q[0], q[1], q[2]], &parameters, &errors).unwrap();
        let expected = machine.displaced_pose(&q, &parameters.to_array(), &errors).unwrap();
        assert_close(real.0.as_flattened(), expected.0.as_flattened(), 500.0);
        let mut expected = [0.0; 3];
        machine.leg_forces(&q, &parameters.to_array(), &[15.0e3], &mut expected).unwrap();
        let inputs = linkage::Inputs { force: 15.0e3 };
        let found = linkage::leg_forces(&[q[0], q[1], q[2]], &parameters, &inputs).unwrap();
        assert_close(&found, &expected, 100.0);
        assert!(found.iter().all(|force| force.abs() > 1e-3), "{found:?}");
    }
    // The rod cannot reach the plate.
    let too_far = linkage::Parameters { rod: 10.0, ..parameters };
    assert_eq!(linkage::pose(&[0.0, 1.0, 0.0], &too_far), Err(abbe::Error::NotClosed));
    let found = machine.pose(&[0.0, 1.0, 0.0], &too_far.to_array());
    assert_eq!(found, Err(abbe::Error::NotClosed));
}

#[test]
fn laws_hold_for_several_loops() {
    let machine = Interpreter::new(Spec::read(specs::path("linkage")).unwrap());
    laws::all(&machine, 50).unwrap_or_else(|failure| panic!("{failure}"));
}

/// An identified error of the base moves all that hangs on it: the tool by `e + a × r`.
#[test]
fn errors_of_the_base_move_the_whole_machine() {
    let mut spec = Spec::parse("machine.toml", &hexapod(&[[0.0; 7]; 6], "")).unwrap();
    let first = spec.sources.len();
    for component in Component::ALL {
        let propagated = vec![(Uncertain::Identified(Identified::Base(component)), 1.0)];
        let name = format!("base {}", component as usize);
        spec.sources.push(Source::propagating(name, String::new(), propagated));
    }
    let machine = Interpreter::new(spec);
    for q in samples(&machine, 5) {
        let found = machine.evaluate_unchecked(Function::SourceDisplacements, &q).unwrap();
        let (found, _) = found.as_chunks::<6>();
        let [x, y, z] = machine.pose(&q, &[]).unwrap().position();
        // Spin turns about y, roll about z and pitch about x.
        let turned = [[z, 0.0, -x], [-y, x, 0.0], [0.0, -z, y]];
        let expected = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]].into_iter().chain(turned);
        for (found, expected) in found[first..].iter().zip(expected) {
            assert_close(&found[..3], &expected, 1000.0);
        }
    }
}
