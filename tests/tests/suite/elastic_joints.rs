//! `stiffness` of a joint, compared with a compliance at its axis, with a force balance by
//! differences of the potential energy, and with the exact chain.

use abbe::Manipulator;
use abbe_codegen::chain::ToolCompliance;
use abbe_interpreter::Interpreter;
use abbe_spec::Spec;

/// Arm on a slide, whose two revolute joints have their axes away from their frames' origins.
const ARM: &str = r#"
[manipulator]
name = "arm"
length = "mm"
gravity = ["-1.3 m/s^2", "0.4 m/s^2", "-9.6 m/s^2"]
[inputs]
payload = { value = "7 kg" }
tau = { value = "3 N*m" }
[[frame]]
name = "slide"
variable = { name = "d1", kind = "prismatic", limits = [0, 900] }
transform = "Tz(d1) Rx(0.2) Ty(30)"
[[frame]]
name = "shoulder"
variable = { name = "q2", kind = "revolute" }
dh = { theta = "q2", d = 120, a = 400, alpha = "80 deg" }
[[frame]]
name = "elbow"
variable = { name = "q3", kind = "revolute" }
mdh = { alpha = "-75 deg", a = 25, theta = "q3", d = 60 }
[tool]
transform = "Tx(310) Ty(-40)"
[[load]]
mass = "12 kg"
frame = "shoulder"
point = [-150, 10, 20]
[[load]]
mass = "payload"
frame = "elbow"
point = "tool"
[[load]]
moment = ["1 N*m", "-2 N*m", "3 N*m"]
force = ["5 N", "4 N", "-3 N"]
frame = "elbow"
point = [50, 60, 70]
"#;

const STIFF: &str = r#"
[[source]]
name = "slide"
class = "repeatable"
joint = "d1"
stiffness = "800 N/mm"
[[source]]
name = "gears"
class = "repeatable"
[[source.effect]]
joint = "q2"
stiffness = "1.5e5 N*m/rad"
[[source.effect]]
joint = "q3"
stiffness = "4e4 N*m"
"#;

/// Compliances in place of the stiffnesses: `at` leads back from the frame to the axis of the
/// joint.
const COMPLIANT: &str = r#"
[[source]]
name = "slide"
class = "repeatable"
frame = "slide"
at = "Ty(-30) Rx(-0.2)"
compliance = { diagonal = [0, 0, "1/(800 N/mm)", 0, 0, 0] }
[[source]]
name = "gears"
class = "repeatable"
[[source.effect]]
frame = "shoulder"
at = "Rx(-80 deg) Tx(-400) Tz(-120)"
compliance = { diagonal = [0, 0, 0, 0, "1/(1.5e5 N*m)", 0] }
[[source.effect]]
frame = "elbow"
compliance = { diagonal = [0, 0, 0, 0, "1/(4e4 N*m)", 0] }
"#;

const CONFIGURATIONS: [[f64; 3]; 3] = [[100.0, 0.3, -0.8], [700.0, -1.9, 0.4], [0.0, 2.6, 2.9]];

fn parsed(sources: &str) -> Spec {
    Spec::parse("arm.toml", &format!("{ARM}{sources}")).unwrap()
}

fn errors(spec: &Spec, q: &[f64; 3]) -> Vec<[f64; 6]> {
    let u: Vec<f64> = spec.inputs.iter().map(|input| input.value).collect();
    let mut errors = vec![[0.0; 6]; spec.frames.len()];
    Interpreter::new(spec.clone()).generalized_errors(q, &[], &u, &mut errors).unwrap();
    errors
}

/// Checks that a stiffness is the compliance at the joint's axis, also for a force at the tool.
#[test]
fn a_stiffness_is_a_compliance_at_the_axis_of_the_joint() {
    let (stiff, compliant) = (parsed(STIFF), parsed(COMPLIANT));
    for q in CONFIGURATIONS {
        let (found, expected) = (errors(&stiff, &q), errors(&compliant, &q));
        for (found, expected) in found.as_flattened().iter().zip(expected.as_flattened()) {
            assert!((found - expected).abs() < 1e-12 * expected.abs().max(1e-3), "{found}, not {expected}");
        }
        let [found, expected] = [&stiff, &compliant].map(|spec| {
            let compliance = ToolCompliance::new(spec).unwrap();
            compliance.graph.evaluate(&compliance.rows.concat(), |symbol| match symbol {
                abbe_spec::expr::Symbol::Variable(i) => q[i],
                _ => f64::NAN,
            })
        });
        for (found, expected) in found.iter().zip(&expected) {
            assert!((found - expected).abs() < 1e-12, "{found}, not {expected}");
        }
    }
}

/// Checks the deviation by the energy of the loads: `k δq = Σ F · ∂p/∂q + M · ω`, with differences of
/// the points on which the loads act. The payload alone has a potential energy, so the others are
/// left out here.
#[test]
fn a_joint_deviates_by_the_slope_of_the_potential_energy() {
    let begin = ARM.find("[[load]]\nmoment").unwrap();
    let text = format!("{}{STIFF}", &ARM[..begin]);
    let text = text.replace("[[load]]\nmass = \"12 kg\"\nframe = \"shoulder\"\npoint = [-150, 10, 20]\n", "");
    let spec = Spec::parse("arm.toml", &text).unwrap();
    let robot = Interpreter::new(spec.clone());
    let gravity = [-1300.0, 400.0, -9600.0];
    // mm/s² · kg · mm = kg mm²/s²; N/mm = 1000 kg/s², N·m = 10⁶ kg mm²/s².
    let stiffness = [800e3, 1.5e11, 4e10];
    for q in CONFIGURATIONS {
        let work = |q: &[f64; 3]| {
            let tool = robot.pose(q, &[]).unwrap().position();
            7.0 * (0..3).map(|i| gravity[i] * tool[i]).sum::<f64>()
        };
        let expected: Vec<f64> = (0..3)
            .map(|joint| {
                let h = if joint == 0 { 1e-2 } else { 1e-5 };
                let at = |sign: f64| {
                    let mut moved = q;
                    moved[joint] += sign * h;
                    work(&moved)
                };
                (at(1.0) - at(-1.0)) / (2.0 * h) / stiffness[joint]
            })
            .collect();
        let u: Vec<f64> = spec.inputs.iter().map(|input| input.value).collect();
        let moved: [f64; 3] = std::array::from_fn(|i| q[i] + expected[i]);
        let real = robot.drawn_pose(&q, &[], &u, &[1.0, 1.0]).unwrap().unwrap();
        let nominal = robot.pose(&moved, &[]).unwrap();
        let undeflected = robot.pose(&q, &[]).unwrap();
        for i in 0..3 {
            let (found, expected) = (real.position()[i], nominal.position()[i]);
            assert!((found - expected).abs() < 1e-8, "{q:?}, axis {i}: {found}, not {expected}");
        }
        assert!((0..3).any(|i| (real.position()[i] - undeflected.position()[i]).abs() > 1e-3));
    }
}

/// Checks that a measured moment replaces that of the loads.
#[test]
fn a_measured_moment_is_divided_by_the_stiffness() {
    let spec = parsed(
        "[[source]]\nname = \"gear\"\nclass = \"repeatable\"\njoint = \"q3\"\nstiffness = \"4e4 N*m/rad\"\nmoment = \"tau\"\n",
    );
    let expected = 3.0 / 4e4;
    for q in CONFIGURATIONS {
        let found = errors(&spec, &q)[2][4];
        assert!((found - expected).abs() < 1e-15, "{found}, not {expected}");
    }
}
