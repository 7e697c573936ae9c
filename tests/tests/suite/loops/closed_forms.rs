//! Machines whose loops close in closed form.

use abbe::analysis::sampling::nominal_parameters;
use abbe::{Manipulator, Pose};
use abbe_tests::closed_machines::FOUR_BAR;

use super::{assert_close, interpreter, joint_jacobian, mechanism, samples};

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
