//! Closed loops: the machine closes, and `J_e` is the derivative of the machine that closes with
//! errors.

use std::fmt::Write;

use abbe::analysis::sampling::{halton, nominal_parameters};
use abbe::{Manipulator, Pose, displacement, laws};
use abbe_interpreter::Interpreter;
use abbe_spec::{Closure, Spec};
use abbe_tests::{sample_size, specs};
use rand::{RngExt, SeedableRng};
use rand_xoshiro::Xoshiro256PlusPlus;

const FOUR_BAR: &str = r#"
[manipulator]
name = "four_bar"
length = "mm"

[[frame]]
name = "crank"
variable = { name = "q1", kind = "revolute", limits = ["-170 deg", "170 deg"], home = "60 deg" }
transform = "Rz(q1) Tx(40)"

[[frame]]
name = "coupler"
variable = { name = "p1", kind = "revolute", passive = true, home = "-30 deg" }
transform = "Rz(p1) Tx(120)"

[[frame]]
name = "rocker"
parent = "base"
variable = { name = "p2", kind = "revolute", passive = true, home = "80 deg" }
transform = "Tx(100) Rz(p2) Tx(80)"

[[loop]]
name = "knee"
frames = ["coupler", "rocker"]
closes = ["x", "y"]

[tool]
frame = "coupler"
transform = "Ty(30)"

[[source]]
name = "bearing"
class = "repeatable"
frame = "rocker"
e_x = 0.02
e_s = "0.1 mrad"
"#;

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
    let page = include_str!("../../../docs/reference/spec.md");
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

fn minus(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

/// The knee of a four-bar linkage is where two circles intersect: `d² + 2 h · …` with the crank's
/// end c, the rocker's bearing b, `d = |b − c|`, and the distance `(r² − s² + d²) / 2d` of the chord.
#[test]
fn four_bar_is_that_of_two_circles() {
    let machine = interpreter(FOUR_BAR);
    for q in samples(&machine, 50) {
        let (crank, coupler, rocker) = (40.0, 120.0, 80.0);
        let (end, bearing) = ([crank * q[0].cos(), crank * q[0].sin()], [100.0, 0.0]);
        let [x, y] = [bearing[0] - end[0], bearing[1] - end[1]];
        let distance = x.hypot(y);
        let along = (coupler * coupler - rocker * rocker + distance * distance) / (2.0 * distance);
        let height = (coupler * coupler - along * along).sqrt();
        let knee =
            [end[0] + (along * x - height * y) / distance, end[1] + (along * y + height * x) / distance];
        let expected = [
            (knee[1] - end[1]).atan2(knee[0] - end[0]) - q[0],
            (knee[1] - bearing[1]).atan2(knee[0] - bearing[0]),
        ];
        let mut passive = [0.0; 2];
        machine.passive(&q, &[], &mut passive).unwrap();
        let turns = passive.iter().zip(expected).map(|(found, expected)| {
            use std::f64::consts::{PI, TAU};
            (found - expected + PI).rem_euclid(TAU) - PI
        });
        assert_close(&turns.collect::<Vec<_>>(), &[0.0; 2], 1.0);
    }
}

/// The parallelograms of the palletizer give the pose and the Jacobian of a serial machine whose
/// forearm and head keep the angles of the crank and of the turret.
#[test]
fn parallelograms_equal_the_serial_machine_they_replace() {
    let machine = mechanism("palletizer");
    let serial = interpreter(
        r#"
[manipulator]
name = "serial"
length = "mm"
[[frame]]
name = "turret"
variable = { name = "q1", kind = "revolute" }
transform = "Rz(q1) Tx(350) Tz(700)"
[[frame]]
name = "lower arm"
variable = { name = "q2", kind = "revolute" }
transform = "Ry(q2) Tz(1250)"
[[frame]]
name = "forearm"
variable = { name = "q3", kind = "revolute" }
transform = "Ry(q3 - q2) Tx(1400) Ry(-q3)"
[[frame]]
name = "flange"
variable = { name = "q4", kind = "revolute" }
transform = "Tz(-300) Rz(q4)"
[tool]
transform = "Tz(-250)"
"#,
    );
    let s = nominal_parameters(machine.description());
    for q in samples(&machine, 50) {
        let (found, expected) = (joint_jacobian(&machine, &q, &s), joint_jacobian(&serial, &q, &[]));
        assert_close(found.0.0.as_flattened(), expected.0.0.as_flattened(), 2650.0);
        assert_close(found.1.as_flattened(), expected.1.as_flattened(), 2650.0);
    }
}

/// The platform of a delta machine is where three spheres intersect, level.
#[test]
fn delta_is_that_of_three_spheres() {
    let machine = mechanism("delta");
    let s = nominal_parameters(machine.description());
    let [base, arm, rod, platform] = [s[0], s[1], s[2], s[3]];
    for q in samples(&machine, 50) {
        // Centres of the spheres, moved towards the axis by the radius of the platform.
        let centres: Vec<[f64; 3]> = (0..3)
            .map(|i| {
                let (sine, cosine) = (i as f64 * std::f64::consts::TAU / 3.0).sin_cos();
                let radius = base + arm * q[i].cos() - platform;
                [radius * cosine, radius * sine, -arm * q[i].sin()]
            })
            .collect();
        // Both equations |p − c_i|² = |p − c_1|² are linear: a line, which meets the first sphere.
        let [a, b] = [1, 2].map(|i| minus(centres[i], centres[0]));
        let normal = cross(a, b);
        let from = cross(normal, minus(a.map(|x| x * dot(b, b)), b.map(|x| x * dot(a, a))));
        let middle = from.map(|x| x / (2.0 * dot(normal, normal)));
        let height = ((rod * rod - dot(middle, middle)) / dot(normal, normal)).sqrt();
        let signs = if normal[2] > 0.0 { -1.0 } else { 1.0 };
        let expected: Vec<f64> =
            (0..3).map(|k| centres[0][k] + middle[k] + signs * height * normal[k]).collect();
        let pose = machine.pose(&q, &s).unwrap();
        let tool = pose.position();
        assert_close(&[tool[0], tool[1], tool[2] + 50.0], &expected, 650.0);
        assert_close(pose.0[..3].as_flattened(), &[1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0], 1.0);
    }
}

/// The inverse Jacobian of a Gough platform is known: `q̇_i = u_i · (v + ω × (p_i − p_T))` with the
/// direction u of a leg and its joint p on the platform. Its product with `J_q` is the identity.
#[test]
fn gough_platform_has_its_inverse_jacobian() {
    let machine = mechanism("hexapod");
    let s = nominal_parameters(machine.description());
    let mut transforms = vec![Pose::IDENTITY; machine.description().frames.len() + 1];
    for q in samples(&machine, 50) {
        let (pose, columns) = joint_jacobian(&machine, &q, &s);
        machine.transforms(&q, &s, &mut transforms).unwrap();
        let platform = transforms[..6].iter().fold(Pose::IDENTITY, |pose, next| pose.then(next));
        for (leg, extension) in q.iter().enumerate() {
            let top = platform.then(&transforms[12 + leg]).position();
            let along = minus(top, transforms[6 + leg].position());
            let length = dot(along, along).sqrt();
            assert_close(&[length], &[s[2] + extension], length);
            let direction = along.map(|x| x / length);
            let lever = minus(top, pose.position());
            let rates: Vec<f64> = columns
                .iter()
                .map(|[x, y, z, a, b, c]| {
                    let swing = cross([*a, *b, *c], lever);
                    dot(direction, [x + swing[0], y + swing[1], z + swing[2]])
                })
                .collect();
            let expected: Vec<f64> = (0..6).map(|i| if i == leg { 1.0 } else { 0.0 }).collect();
            assert_close(&rates, &expected, 10.0);
        }
    }
}

/// Errors of the frames that let a body move freely have no effect, and the columns are zeros.
#[test]
fn errors_of_free_frames_are_taken_up() {
    let machine = mechanism("hexapod");
    let s = nominal_parameters(machine.description());
    let q = [10.0, -20.0, 30.0, 5.0, 0.0, -40.0];
    let mut columns = vec![[0.0; 6]; 6 * machine.description().frames.len()];
    let pose = machine.error_jacobian(&q, &s, &mut columns).unwrap();
    assert!(columns[..36].as_flattened().iter().all(|entry| *entry == 0.0));
    assert!(columns[36..].as_flattened().iter().any(|entry| *entry != 0.0));
    let mut errors = vec![[0.0; 6]; machine.description().frames.len()];
    errors[..6].iter_mut().for_each(|errors| *errors = [0.3, -0.2, 0.1, 1e-3, -2e-3, 3e-3]);
    let real = machine.displaced_pose(&q, &s, &errors).unwrap();
    assert_close(real.0.as_flattened(), pose.0.as_flattened(), 1000.0);
}

abbe_macro::manipulator!("specs/linkage.toml");
abbe::test_manipulator!(generated_linkage: linkage::Linkage);

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

/// Random mechanisms: each loop has passive joints of its own, as many as equations, in a branch
/// that begins at any earlier frame and ends where another one was put at home.
struct Mechanism {
    random: Xoshiro256PlusPlus,
    text: String,
    /// Poses of all frames at home, in `F_0`.
    poses: Vec<Pose>,
    passive: usize,
    commanded: usize,
}

impl Mechanism {
    fn new(seed: u64) -> Self {
        let mut mechanism = Self {
            random: Xoshiro256PlusPlus::seed_from_u64(seed),
            text: "[manipulator]\nname = \"mechanism\"\nlength = \"m\"\n".to_owned(),
            poses: Vec::new(),
            passive: 0,
            commanded: 0,
        };
        mechanism.joint(None, false, true);
        let loops = 1 + seed % 3;
        for number in 0..loops {
            mechanism.close(number);
        }
        // The tool is on any frame that something moves.
        let tool = mechanism.below(mechanism.poses.len());
        let _ =
            write!(mechanism.text, "[tool]\nframe = \"f{tool}\"\ntransform = \"Tx(0.2) Rz(0.3) Ty(0.1)\"\n");
        mechanism
    }

    fn below(&mut self, count: usize) -> usize {
        self.random.random_range(0..count)
    }

    /// Returns a number from −1 to 1 with three decimals.
    fn number(&mut self) -> f64 {
        (self.below(2001) as f64 - 1000.0) / 1000.0
    }

    /// Adds a frame in general position with a joint, and returns its index.
    fn joint(&mut self, parent: Option<usize>, passive: bool, may_slide: bool) -> usize {
        let numbers: Vec<f64> = (0..6).map(|_| self.number()).collect();
        let home = 0.4 * self.number();
        let (axis, is_slide) = (self.below(3), self.below(4) == 0 && may_slide);
        let [x, y, z, a, b, c] = [0, 1, 2, 3, 4, 5].map(|i| numbers[i]);
        let index = self.poses.len();
        let name = match passive {
            true => format!("p{}", self.passive),
            false => format!("q{}", self.commanded),
        };
        let kind = if is_slide { "prismatic" } else { "revolute" };
        let motion = format!("{}{}({name})", if is_slide { "T" } else { "R" }, ["x", "y", "z"][axis]);
        let flags = match passive {
            true => "passive = true".to_owned(),
            false => format!("limits = [{}, {}]", home - 0.05, home + 0.05),
        };
        let parent_name = parent.map_or("base".to_owned(), |parent| format!("f{parent}"));
        let _ = write!(
            self.text,
            "[[frame]]\nname = \"f{index}\"\nparent = \"{parent_name}\"\n\
             variable = {{ name = \"{name}\", kind = \"{kind}\", home = {home}, {flags} }}\n\
             transform = \"{motion} Tx({x}) Ty({y}) Tz({z}) Ry({a}) Rz({b}) Rx({c})\"\n"
        );
        *(if passive { &mut self.passive } else { &mut self.commanded }) += 1;
        let rest = displacement(&[x, y, z, a, b, c]);
        let mut moved = [0.0; 6];
        moved[if is_slide { axis } else { [5, 3, 4][axis] }] = home;
        let before = parent.map_or(Pose::IDENTITY, |parent| self.poses[parent]);
        self.poses.push(before.then(&displacement(&moved)).then(&rest));
        index
    }

    /// Adds a loop that closes at home.
    fn close(&mut self, number: u64) {
        let mut coordinates: Vec<usize> = (0..6).filter(|_| self.below(2) == 0).collect();
        let is_distance = self.below(3) == 0;
        if is_distance || coordinates.is_empty() {
            coordinates = vec![0];
        }
        let start = self.below(self.poses.len());
        let mut end = start;
        let mut remaining = coordinates.len();
        // Slides do not turn anything.
        let mut slides = coordinates.iter().filter(|coordinate| **coordinate < 3).count();
        while remaining > 0 {
            // A commanded joint between passive ones now and then.
            let passive = self.below(4) != 0;
            let text = self.text.len();
            end = self.joint(Some(end), passive, slides > 0);
            remaining -= usize::from(passive);
            slides -= usize::from(passive && self.text[text..].contains("prismatic"));
        }
        let other = if self.below(2) == 0 { None } else { Some(self.below(start + 1)) };
        let before = other.map_or(Pose::IDENTITY, |other| self.poses[other]);
        let mut there = before.inverse().then(&self.poses[end]);
        let closes = match is_distance {
            true => {
                there.0[3] = there.0[3].map(|coordinate| coordinate + 0.5);
                format!("\"distance\"\nlength = \"{:?} m\"", 0.5 * 3_f64.sqrt())
            }
            false => {
                format!("{:?}", coordinates.iter().map(|i| Closure::COORDINATES[*i]).collect::<Vec<_>>())
            }
        };
        let row = |i: usize| {
            format!("[{:?}, {:?}, {:?}, {:?}]", there.0[0][i], there.0[1][i], there.0[2][i], there.0[3][i])
        };
        let index = self.poses.len();
        let other_name = other.map_or("base".to_owned(), |other| format!("f{other}"));
        let _ = write!(
            self.text,
            "[[frame]]\nname = \"f{index}\"\nparent = \"{other_name}\"\n\
             matrix = [{}, {}, {}, [0, 0, 0, 1]]\n\
             [[loop]]\nname = \"{number}\"\nframes = [\"f{end}\", \"f{index}\"]\ncloses = {closes}\n",
            row(0),
            row(1),
            row(2),
        );
        self.poses.push(before.then(&there));
    }
}

/// Mechanisms with one to three loops obey the laws, 50 in a thorough run: `J_e` is the derivative
/// of the machine that closes with errors. Mechanisms that are singular at home, or nearly so, do
/// not count.
#[test]
fn laws_hold_for_random_mechanisms() {
    let (mut held, mut singular) = ([0; 3], 0);
    for seed in 0.. {
        let Mechanism { text, .. } = Mechanism::new(seed);
        let spec = Spec::parse("mechanism.toml", &text).unwrap_or_else(|mistakes| panic!("{mistakes}"));
        let loops = spec.loops.len();
        let machine = Interpreter::new(spec);
        if !is_regular(&machine) {
            singular += 1;
            continue;
        }
        laws::all(&machine, 4).unwrap_or_else(|failure| panic!("{seed}: {failure}\n{text}"));
        held[loops - 1] += 1;
        if held.iter().sum::<usize>() == 2 * sample_size(25).max(5) {
            break;
        }
    }
    assert!(held.iter().all(|held| *held > 0) && singular < 100, "{held:?} {singular}");
}

/// Returns `true` if the mechanism closes around home, and errors and joints have effects of their
/// order there.
fn is_regular(machine: &Interpreter) -> bool {
    let description = machine.description();
    let home: Vec<f64> = description.variables.iter().map(|variable| variable.home).collect();
    let mut columns = vec![[0.0; 6]; 6 * description.frames.len()];
    let passive = |q: &[f64]| {
        let mut passive = vec![0.0; description.passive().count()];
        machine.passive(q, &[], &mut passive).ok().map(|()| passive)
    };
    let closes_around = |(i, share): (usize, f64)| {
        let mut q = home.clone();
        q[i] += 0.05 * share;
        let [before, after] = [&home, &q].map(|q| passive(q));
        let pairs = before.zip(after);
        pairs.is_some_and(|(a, b)| a.iter().zip(b).all(|(a, b)| (a - b).abs() < 0.3))
            && machine.error_jacobian(&q, &[], &mut columns).is_ok()
            && columns.as_flattened().iter().all(|entry| entry.abs() < 10.0)
    };
    let mut steps = (0..home.len()).flat_map(|i| [(i, -1.0), (i, 1.0)]);
    steps.all(closes_around)
}
