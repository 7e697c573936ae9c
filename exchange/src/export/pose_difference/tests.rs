//! Tests of `pose_difference.rs`.

use super::*;

#[test]
fn figures_are_those_of_two_shifts_and_a_turn() {
    let shifted = |x| Pose([[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0], [x, 0.0, 0.0]]);
    let (s, c) = 0.02_f64.sin_cos();
    let turned = Pose([[c, s, 0.0], [-s, c, 0.0], [0.0, 0.0, 1.0], [0.0, 4.0, 0.0]]);
    let difference = PoseDifference::new([[shifted(1.0), shifted(-2.0)], [shifted(0.0), turned]]);
    assert_eq!(difference.position, Figure { largest: 4.0, rms: 12.5_f64.sqrt() });
    assert!(
        (difference.angle.largest - 0.02).abs() < 1e-15
            && (difference.angle.rms - 2e-4_f64.sqrt()).abs() < 1e-15
    );
}
