//! The uncertainty of an input as a random source, compared with differences.

use abbe::analysis::{Configuration, Measurand, errors_at};
use abbe::{Class, Distribution, Manipulator, deviation, drawn_pose};
use abbe_interpreter::Interpreter;
use abbe_spec::Spec;

const ARM: &str = r#"
[manipulator]
name = "arm"
length = "mm"
gravity = [0, 0, "-9.80665 m/s^2"]

[parameters]
reach = "150 mm"

[inputs]
payload = { value = "4 kg", range = ["0 kg", "10 kg"], uncertainty = "0.5 kg" }
warming = { value = "3 K", uncertainty = "0.2 K" }
exact = 1

[tables.drift]
x = { values = [0, 2, 5, 9], unit = "K" }
y = { values = [0, 0.01, 0.05, 0.06], unit = "mm" }
interpolation = "cubic"
outside = "hold"

[[frame]]
name = "turn"
variable = { name = "q1", kind = "revolute", limits = ["-170 deg", "170 deg"] }
transform = "Rz(q1) Tz(400)"

[[frame]]
name = "shoulder"
variable = { name = "q2", kind = "revolute", limits = ["-90 deg", "90 deg"] }
transform = "Rx(pi/2) Rz(q2) Tx(500)"

[[frame]]
name = "slide"
variable = { name = "d3", kind = "prismatic", limits = ["0 mm", "300 mm"] }
transform = "Tx(d3)"

[tool]
transform = "Tx(reach) Ty(30)"

[[source]]
name = "gear"
class = "repeatable"
frame = "shoulder"
compliance = { diagonal = [0, 0, 0, 0, "3e-10/(N*mm)", 0] }

[[source]]
name = "boom"
class = "repeatable"
frame = "slide"
beam = { length = "200 mm + d3", axis = "x", EI_y = "2e10 N*mm^2", EI_z = "3e10 N*mm^2", GJ = "2e10 N*mm^2" }

[[source]]
name = "warm column"
class = "repeatable"
frame = "turn"
e_z = "11.5 um/m/K * 400 mm * warming + drift(warming)"
e_p = "2e-6 * payload/(1 kg) * sin(q1) * exact"
magnitude = { value = 1.5 }

[[source]]
name = "zero of the shoulder"
class = "repeatable"
joint = "q2"
error = "1e-5 * (payload/(1 kg))^2"

[[source]]
name = "drawing"
class = "repeatable"
parameter = "reach"
error = "0.02 mm + 1 um/K * warming"

[[source]]
name = "left out"
class = "repeatable"
enabled = false
frame = "turn"
e_x = "1 mm * payload/(1 kg)"

[[source]]
name = "encoder"
class = "random"
distribution = "uniform"
joint = "q1"
error = "1e-5 * payload/(1 kg)"

[[load]]
name = "what is carried"
mass = "payload"
frame = "slide"
point = "tool"
"#;

/// Holds that each input with an uncertainty is a normal random source whose errors of the frames
/// are ∂ε/∂u times this uncertainty: ε is differentiated by central differences, extrapolated once.
#[test]
fn uncertainty_of_an_input_is_the_difference_of_the_errors() {
    let spec = Spec::parse("arm.toml", ARM).unwrap();
    let arm = Interpreter::new(spec.clone());
    let names: Vec<String> = arm.description().sources.iter().map(|source| source.name.to_string()).collect();
    assert_eq!(names[names.len() - 2..], ["uncertainty of payload", "uncertainty of warming"]);
    let last = &arm.description().sources[names.len() - 1];
    assert_eq!((last.class, &*last.at), (Class::Random(Distribution::Normal), "input warming"));

    let s = [150.0];
    for (n, payload) in [0.7, 4.0, 9.0].into_iter().enumerate() {
        let (q, u) = ([0.4 + n as f64, -0.8 + 0.5 * n as f64, 90.0 * n as f64], [payload, 3.3, 1.0]);
        let errors = |input: usize, step: f64| {
            let mut there = u;
            there[input] += step;
            let mut errors = [[0.0; 6]; 3];
            arm.generalized_errors(&q, &s, &there, &mut errors).unwrap();
            errors
        };
        let mut effects = vec![0.0; arm.description().effects.len()];
        arm.effects(&q, &s, &u, &mut effects).unwrap();
        for (input, uncertainty) in [(0, 0.5), (1, 0.2)] {
            let source = names.len() - 2 + input;
            let mut found = [[0.0; 6]; 3];
            for (effect, value) in arm.description().effects.iter().zip(&effects) {
                if effect.source == source {
                    found[effect.frame][effect.component as usize] += value;
                }
            }
            let central = |h: f64, frame: usize, i: usize| {
                (errors(input, h)[frame][i] - errors(input, -h)[frame][i]) / (2.0 * h)
            };
            for frame in 0..3 {
                for i in 0..6 {
                    let (coarse, fine) = (central(2e-3, frame, i), central(1e-3, frame, i));
                    let expected = uncertainty * (fine + (fine - coarse) / 3.0);
                    let found = found[frame][i];
                    let room = 1e-7 * expected.abs().max(1e-6);
                    assert!(
                        (found - expected).abs() < room,
                        "{input}, {frame}, {i}: {found}, not {expected}"
                    );
                }
            }

            // The same in ΔX, and in the exact chain of the Monte Carlo draws.
            let configuration = Configuration { q: q.to_vec(), s: s.to_vec(), u: u.to_vec() };
            let bound = errors_at(&arm, &configuration).unwrap().sources[source];
            let pose = |input: f64, uncertain: f64| {
                let mut u = u;
                u[source + 2 - names.len()] += input;
                let mut magnitudes: Vec<f64> = repeatable(&arm);
                magnitudes[source] = uncertain;
                drawn_pose(&arm, &q, &s, &u, &magnitudes).unwrap()
            };
            let moved = |h: f64| deviation(arm.description().orientation, &pose(-h, 0.0), &pose(h, 0.0));
            let drawn = |m: f64| deviation(arm.description().orientation, &pose(0.0, -m), &pose(0.0, m));
            let (moved, drawn) = (moved(1e-2), drawn(1e-2));
            let bound = Measurand::Position.rows(&bound);
            for i in 0..3 {
                let moved = 3.0 * uncertainty * moved[i] / 2e-2;
                let drawn = 3.0 * drawn[i] / 2e-2;
                // The exact chain differs from first order by products of errors.
                let room = 2e-3 * bound.iter().fold(1e-4, |most: f64, row| most.max(row.abs()));
                assert!((bound[i] - moved).abs() < room, "row {i}: {}, moved by {moved}", bound[i]);
                assert!((bound[i] - drawn).abs() < room, "row {i}: {}, drawn {drawn}", bound[i]);
            }
        }
    }
}

fn repeatable(arm: &Interpreter) -> Vec<f64> {
    let sources = arm.description().sources.iter();
    sources.map(|source| f64::from(u8::from(source.class == Class::Repeatable))).collect()
}
