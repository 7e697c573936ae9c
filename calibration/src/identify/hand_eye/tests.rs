//! Tests of `hand_eye.rs`.

use super::closed_form;
use abbe_core::{Pose, displacement};

#[test]
fn it_solves_for_placements_of_any_size() {
    let b = displacement(&[900.0, -300.0, 500.0, 1.2, -2.5, 0.4]);
    let m = displacement(&[40.0, 10.0, 90.0, 2.8, 0.3, -1.6]);
    let tool = |i: usize| {
        let v = |k: usize| ((i * 6 + k) as f64 * 1.7).sin();
        displacement(&[300.0 * v(0), 300.0 * v(1), 300.0 * v(2), v(3), v(4), v(5)])
    };
    let pairs: Vec<(Pose, Pose)> = (0..12).map(|i| (tool(i), b.then(&tool(i)).then(&m))).collect();
    let found = closed_form(&pairs).unwrap();
    for (found, expected) in found.iter().zip([b, m]) {
        let apart = found.0.as_flattened().iter().zip(expected.0.as_flattened());
        assert!(apart.map(|(a, b)| (a - b).abs()).fold(0.0, f64::max) < 1e-8);
    }
    // Turned about one axis, the height of the tool is that of the base.
    let flat = |i: usize| displacement(&[10.0 * i as f64, 0.0, 0.0, 0.0, 0.3 * i as f64, 0.0]);
    let pairs: Vec<(Pose, Pose)> = (0..12).map(|i| (flat(i), b.then(&flat(i)).then(&m))).collect();
    assert!(closed_form(&pairs).is_none());
}
