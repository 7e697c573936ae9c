//! Tests of `placement.rs`.

use super::*;

#[test]
fn roll_pitch_yaw_of_a_rotation_give_it_back_also_near_the_singularity() {
    let quarter = std::f64::consts::FRAC_PI_2;
    let pitches = [0.0, 0.3, -1.2, quarter, -quarter, quarter - 1e-12, quarter - 1e-9, 1.57, -quarter + 1e-7];
    for pitch in pitches {
        for roll in [0.0, 0.4, -2.5, quarter] {
            for yaw in [0.0, 1.1, -3.0, quarter] {
                let placed = Placement { xyz: [1.0, -2.0, 3.0], rpy: [roll, pitch, yaw] };
                let again = Placement::from_motion(&placed.motion());
                let (a, b) = (placed.motion().to_homogeneous(), again.motion().to_homogeneous());
                assert!((a - b).abs().max() < 2e-15, "{placed:?}: {again:?}, {}", (a - b).abs().max());
            }
        }
    }
}
