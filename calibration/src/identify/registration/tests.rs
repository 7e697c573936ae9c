//! Tests of `registration.rs`.

use super::*;
use abbe_core::real_pose;

const POINTS: [[f64; 3]; 3] = [[-200.0, 10.0, 150.0], [250.0, 0.0, -100.0], [30.0, 40.0, 300.0]];

#[test]
fn registration_undoes_a_motion() {
    let motion = real_pose(&[Pose::IDENTITY, Pose::IDENTITY], &[[5.0, -3.0, 800.0, 0.4, -1.9, 2.5]]);
    let moved: Vec<[f64; 3]> = POINTS.iter().map(|p| motion.apply(*p)).collect();
    let found = register(&POINTS, &moved).unwrap();
    for (a, b) in found.pose.0.as_flattened().iter().zip(motion.0.as_flattened()) {
        assert!((a - b).abs() < 1e-10);
    }
    assert!(found.rms < 1e-10 && found.breadth > 0.1);
    let line = [[0.0; 3], [1.0, 1.0, 1.0], [3.0, 3.0, 3.0]];
    assert!(register(&line, &line).unwrap().breadth < 1e-6);
    assert!(register(&line[..2], &line[..2]).is_none());
}
