//! Tests of `chain.rs`.

use super::*;

#[test]
fn small_displacement_is_equation_4() {
    let e = [1e-6, 2e-6, 3e-6, 4e-6, 5e-6, 6e-6];
    let [_, _, _, s, r, p] = e;
    let expected = [[1.0, r, -s], [-r, 1.0, p], [s, -p, 1.0], [e[0], e[1], e[2]]];
    let Pose(found) = displacement(&e);
    for (found, expected) in found.as_flattened().iter().zip(expected.as_flattened()) {
        assert!((found - expected).abs() < 1e-10);
    }
}

/// Checks the table angles of IEC 61217 against a rotation by hand: yaw about z, then pitch
/// about the turned x, then roll about the turned y.
#[test]
fn table_angles_are_yaw_pitch_and_roll() {
    let about = |component: Component, angle: f64| {
        let mut e = [0.0; 6];
        e[component.index()] = angle;
        displacement(&e)
    };
    let [yaw, pitch, roll] = [1.2, -0.05, 0.03];
    let turned = about(Component::Roll, yaw);
    let turned = turned.then(&about(Component::Pitch, pitch)).then(&about(Component::Spin, roll));
    let found = deviation(Orientation::Iec61217, &Pose::IDENTITY, &turned);
    for (found, expected) in found.iter().zip([0.0, 0.0, 0.0, yaw, pitch, roll]) {
        assert!((found - expected).abs() < 1e-15, "{found} {expected}");
    }
}

#[test]
fn deviations_are_the_errors_themselves_at_the_origin() {
    let e = [1e-5, 2e-5, 3e-5, 4e-5, 5e-5, 6e-5];
    let real = real_pose(&[Pose::IDENTITY, Pose::IDENTITY], &[e]);
    let euler = deviation(Orientation::EulerYzx, &Pose::IDENTITY, &real);
    let vector = deviation(Orientation::RotationVector, &Pose::IDENTITY, &real);
    for i in 0..6 {
        assert!((euler[i] - e[i]).abs() < 1e-15);
    }
    // Rotations about x, y, z: pitch, spin, roll.
    for (i, expected) in [(3, e[5]), (4, e[3]), (5, e[4])] {
        assert!((vector[i] - expected).abs() < 1e-8);
    }
}
