//! Sources computed from the structure: located errors, beams and compliances, compared with
//! textbook formulas.

use abbe::{Manipulator, Pose, located};
use abbe_interpreter::Interpreter;
use abbe_manipulators::SHIPPED;
use abbe_spec::Spec;

/// Returns ε of the repeatable sources of a spec.
fn errors(spec: &Spec, q: &[f64], s: &[f64], u: &[f64]) -> Vec<[f64; 6]> {
    let mut errors = vec![[0.0; 6]; spec.frames.len()];
    Interpreter::new(spec.clone()).generalized_errors(q, s, u, &mut errors).unwrap();
    errors
}

fn close(value: f64, expected: f64, tolerance: f64) {
    assert!((value - expected).abs() <= tolerance * expected.abs().max(1e-9), "{value}, expected {expected}");
}

/// Checks that the positioner's arm deflection as a beam equals its expressions: section 5.1 and
/// Figure 10.
#[test]
fn arm_of_the_positioner_as_a_beam() {
    let text = SHIPPED.iter().find(|shipped| shipped.name == "pps").unwrap().spec;
    let mut spec = Spec::parse("pps.toml", text).unwrap();
    let name = "arm deflection";
    for source in &mut spec.sources {
        source.enabled = source.name == name;
    }
    // The loads of the spec, couch and patient, bend it.
    let with_beam = text.to_owned()
        + r#"
[[source]]
name = "arm deflection as a beam"
class = "repeatable"
frame = "longitudinal"
beam = { length = "z_offset + d3", axis = "z", EI_x = "arm_EI", EI_y = "arm_EI", GJ = "arm_GJ" }
"#;
    let mut beam = Spec::parse("pps.toml", &with_beam).unwrap();
    for source in &mut beam.sources {
        source.enabled = source.name.ends_with("as a beam");
    }
    let s: Vec<f64> = spec.parameters.iter().map(|parameter| parameter.value).collect();
    for i in 0..50 {
        let t = f64::from(i) / 49.0;
        let q = [2256.0 * t, 560.0 * (1.0 - t), 1473.0 * (7.3 * t).sin().abs(), 3.0 * t - 1.5, 0.0, 0.0];
        let u = [136.0 * (5.1 * t).cos().abs(), 500.0 * t - 250.0, 1500.0 * (1.0 - t)];
        let (expressions, beam) = (errors(&spec, &q, &s, &u), errors(&beam, &q, &s, &u));
        for (expected, error) in expressions.as_flattened().iter().zip(beam.as_flattened()) {
            assert!(
                (error - expected).abs() <= 1e-12 * expected.abs().max(1e-3),
                "{error}, expected {expected}"
            );
        }
    }
}

const CANTILEVER: &str = r#"
[manipulator]
name = "cantilever"
length = "m"
gravity = [0, 0, "-9.81 m/s^2"]
[parameters]
EI = "1200 N*m^2"
[inputs]
tip = { value = "3 kg" }
[[frame]]
name = "tip"
variable = { name = "d1", kind = "prismatic", limits = [0.5, 2], home = 1 }
transform = "Tx(d1)"
[[load]]
mass = "tip"
frame = "tip"
[[source]]
name = "sag"
class = "repeatable"
frame = "tip"
beam = { length = "d1", EI_y = "EI", EI_z = "2*EI", GJ = "800 N*m^2", EA = "1e6 N" }
"#;

#[test]
fn cantilever_with_a_load_at_its_tip() {
    let spec = Spec::parse("cantilever.toml", CANTILEVER).unwrap();
    for (length, mass) in [(0.7_f64, 3.0), (1.9, 12.5), (1.0, 0.0)] {
        let [tip] = errors(&spec, &[length], &[1200.0], &[mass])[..] else { panic!("one frame") };
        let force = 9.81 * mass;
        // w = F L³/3EI downwards; the slope F L²/2EI turns the tip's x axis down, about +y.
        close(tip[2], -force * length.powi(3) / (3.0 * 1200.0), 1e-10);
        close(tip[3], force * length.powi(2) / (2.0 * 1200.0), 1e-10);
        assert_eq!([tip[0], tip[1], tip[4], tip[5]], [0.0; 4]);
    }
}

/// Checks loads off the axis: they twist, pull, and bend about both axes.
#[test]
fn cantilever_in_every_direction() {
    let text = CANTILEVER
        .replace("[0, 0, \"-9.81 m/s^2\"]", "[\"1 m/s^2\", \"2 m/s^2\", \"3 m/s^2\"]")
        .replace("frame = \"tip\"\n[[source]]", "frame = \"tip\"\npoint = [0.1, 0.2, 0.3]\n[[source]]");
    let spec = Spec::parse("cantilever.toml", &text).unwrap();
    let (l, ei_y, ei_z, gj, ea) = (1.3_f64, 1200.0, 2400.0, 800.0, 1e6);
    let [tip] = errors(&spec, &[l], &[1200.0], &[5.0])[..] else { panic!("one frame") };
    let (fx, fy, fz) = (5.0, 10.0, 15.0);
    let (mx, my, mz) = (0.2 * fz - 0.3 * fy, 0.3 * fx - 0.1 * fz, 0.1 * fy - 0.2 * fx);
    close(tip[0], fx * l / ea, 1e-10);
    close(tip[1], fy * l.powi(3) / (3.0 * ei_z) + mz * l * l / (2.0 * ei_z), 1e-10);
    close(tip[2], fz * l.powi(3) / (3.0 * ei_y) - my * l * l / (2.0 * ei_y), 1e-10);
    close(tip[3], -fz * l * l / (2.0 * ei_y) + my * l / ei_y, 1e-10);
    close(tip[4], fy * l * l / (2.0 * ei_z) + mz * l / ei_z, 1e-10);
    close(tip[5], mx * l / gj, 1e-10);
}

/// Checks two links that rotate about y, with a torsion spring at each joint and a mass at each
/// end: the joint moments are those of statics.
#[test]
fn two_link_arm_under_gravity() {
    let spec = Spec::parse(
        "arm.toml",
        r#"
[manipulator]
name = "arm"
length = "m"
gravity = [0, 0, "-10 m/s^2"]
[[frame]]
name = "shoulder"
variable = { name = "q1", kind = "revolute" }
transform = "Ry(q1)"
[[frame]]
name = "elbow"
variable = { name = "q2", kind = "revolute" }
transform = "Tx(0.8) Ry(q2)"
[tool]
transform = "Tx(0.6)"
[[load]]
mass = "4 kg"
frame = "shoulder"
point = [0.8, 0, 0]
[[load]]
mass = "2 kg"
frame = "elbow"
point = [0.6, 0, 0]
[[source]]
name = "joints"
class = "repeatable"
[[source.effect]]
frame = "shoulder"
compliance = { diagonal = [0, 0, 0, "1e-3/(N*m)", 0, 0] }
[[source.effect]]
frame = "elbow"
compliance = { diagonal = [0, 0, 0, "2e-3/(N*m)", 0, 0] }
"#,
    )
    .unwrap();
    for (q1, q2) in [(0.0_f64, 0.0_f64), (0.3, -0.9), (-1.2, 0.4)] {
        let errors = errors(&spec, &[q1, q2], &[], &[]);
        // Ry(q) turns x down; the weight of a mass m at horizontal distance x has the moment + x m
        // g about y.
        let elbow = 0.6 * (q1 + q2).cos() * 2.0 * 10.0;
        let shoulder = 0.8 * q1.cos() * 6.0 * 10.0 + elbow;
        close(errors[0][3], 1e-3 * shoulder, 1e-10);
        close(errors[1][3], 2e-3 * elbow, 1e-10);
    }
}

/// Checks that `F · ΔX` of a tip load is twice the energy stored in the compliances: duality of
/// `J_e` and the wrenches.
#[test]
fn work_is_twice_the_energy() {
    let text = SHIPPED.iter().find(|shipped| shipped.name == "puma560").unwrap().spec;
    let sources_end = text.find("[[source]]").unwrap();
    let mut spec = text[..sources_end].replacen(
        "[manipulator]",
        "[manipulator]\ngravity = [0, 0, \"-9.80665 m/s^2\"]",
        1,
    );
    spec += "[tool]\ntransform = \"Tx(0.1) Ty(0.05) Tz(0.2)\"\n[[load]]\nmass = \"2.5 kg\"\nframe = \"LAST\"\npoint = [0.1, 0.05, 0.2]\n";
    let frames: Vec<String> =
        Spec::parse("puma560.toml", text).unwrap().frames.iter().map(|f| f.name.clone()).collect();
    let spec = spec.replace("LAST", frames.last().unwrap());
    let rows = "[[1e-6, 0, 2e-7, 0, 0, 0], [0, 2e-6, 0, 0, 3e-7, 0], [2e-7, 0, 3e-6, 0, 0, 0], [0, 0, 0, 4e-5, 0, 1e-6], [0, 3e-7, 0, 0, 5e-5, 0], [0, 0, 0, 1e-6, 0, 6e-5]]";
    // Every entry with its own unit: m/N, 1/N, 1/(N m).
    let matrix: Vec<Vec<f64>> = rows
        .trim_matches(['[', ']'])
        .split("], [")
        .map(|row| row.split(", ").map(|entry| entry.parse().unwrap()).collect())
        .collect();
    let unit = |i: usize, j: usize| match (i < 3, j < 3) {
        (true, true) => "m/N",
        (false, false) => "rad/(N*m)",
        _ => "1/N",
    };
    let entries: Vec<String> = (0..6)
        .map(|i| {
            let row = (0..6).map(|j| {
                if unit(i, j) == "1/N" {
                    format!("\"{:e}/N\"", matrix[i][j])
                } else {
                    format!("\"{:e} {}\"", matrix[i][j], unit(i, j))
                }
            });
            format!("[{}]", row.collect::<Vec<_>>().join(", "))
        })
        .collect();
    let mut text = spec;
    for frame in &frames {
        text += &format!(
            "[[source]]\nname = \"{frame}\"\nclass = \"repeatable\"\nframe = \"{frame}\"\ncompliance = {{ matrix = [{}] }}\n",
            entries.join(", ")
        );
    }
    let spec = Spec::parse("puma560.toml", &text).unwrap();
    let robot = Interpreter::new(spec.clone());
    let q = [0.3, 0.9, -0.7, 0.4, 1.1, -0.2];
    let mut columns = vec![[0.0; 6]; 36];
    robot.error_jacobian(&q, &[], &mut columns).unwrap();
    let errors = errors(&spec, &q, &[], &[]);
    let weight = -9.80665 * 2.5;
    let sag: f64 = columns.iter().zip(errors.as_flattened()).map(|(column, error)| column[2] * error).sum();
    // Twice the energy is Σ wᵀ C w with w = J_eᵀ F.
    let mut twice_the_energy = 0.0;
    for frame in columns.chunks(6) {
        let wrench: Vec<f64> = frame.iter().map(|column| column[2] * weight).collect();
        for i in 0..6 {
            for j in 0..6 {
                twice_the_energy += wrench[i] * matrix[i][j] * wrench[j];
            }
        }
    }
    close(weight * sag, twice_the_energy, 1e-10);
    assert!(twice_the_energy > 1e-6);
}

/// Checks the paper's Figure 5: the joint of two members, at a distance before the frame, has an
/// offset d and a tilt ψ.
#[test]
fn offset_and_tilt_where_two_members_meet() {
    let spec = |scale: f64| {
        let (d, psi) = (0.3 * scale, 2e-3 * scale);
        let text = format!(
            r#"
[manipulator]
name = "members"
length = "mm"
[[frame]]
name = "end"
variable = {{ name = "q1", kind = "revolute" }}
transform = "Rz(q1) Ty(500)"
[[source]]
name = "assembly"
class = "repeatable"
frame = "end"
at = "Ty(-300 mm) Rz(0.4)"
e_x = {d}
e_y = {}
e_r = {psi}
e_s = {}
"#,
            -0.5 * d,
            0.7 * psi
        );
        (Spec::parse("members.toml", &text).unwrap(), [d, -0.5 * d, 0.0, 0.7 * psi, psi, 0.0])
    };
    let (s, c) = 0.4_f64.sin_cos();
    let place = Pose([[c, s, 0.0], [-s, c, 0.0], [0.0, 0.0, 1.0], [0.0, -300.0, 0.0]]);
    let difference = |scale: f64| {
        let (spec, there) = spec(scale);
        let end = errors(&spec, &[0.2], &[], &[])[0];
        let exact = located(&place, &there);
        end.iter().zip(exact).map(|(a, b)| (a - b).powi(2)).sum::<f64>().sqrt()
    };
    // A tilt ψ about z moves the end, 300 mm beyond, by −300 ψ in x.
    let (spec, there) = spec(1.0);
    let end = errors(&spec, &[0.2], &[], &[])[0];
    close(end[0], c * there[0] - s * there[1] - 300.0 * there[4], 1e-12);
    close(end[4], there[4], 1e-12);
    let slope = (difference(1.0) / difference(0.01)).log10() / 2.0;
    assert!((slope - 2.0).abs() < 0.01, "first order: {slope}");
}
