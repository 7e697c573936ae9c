//! Tests of `board_pose.rs`.

use abbe_core::displacement;
use rand::{RngExt, SeedableRng};
use rand_xoshiro::Xoshiro256PlusPlus;

use super::{Pose, Sight, placed};

/// Corners of any thickness, from a flat board to a cube, and any four or more of them, are placed
/// where they are: exactly without noise, and with noise as well as from the true pose.
#[test]
fn corners_of_any_thickness_are_placed() {
    let mut random = Xoshiro256PlusPlus::seed_from_u64(3);
    let mut wrong = Vec::new();
    for i in 0..1000 {
        let thickness = [0.0, 1e-4, 0.01, 0.03, 0.1, 0.3, 1.0][i % 7];
        let count = 4 + i / 7 % 9;
        let corners: Vec<[f64; 3]> = (0..count)
            .map(|_| [60.0, 60.0, 60.0 * thickness].map(|side| side * (random.random::<f64>() - 0.5)))
            .collect();
        let turn = [0.0; 3].map(|_: f64| 1.6 * (random.random::<f64>() - 0.5));
        let mut board = displacement(&[0.0, 0.0, 0.0, turn[0], turn[1], turn[2]]);
        board.0[3] = [20.0, -10.0, 150.0 + 400.0 * random.random::<f64>()];
        let sights: Vec<Sight> = corners
            .iter()
            .map(|corner| {
                let [x, y, z] = board.apply(*corner);
                (*corner, [x / z, y / z])
            })
            .collect();
        let off = |found: &Pose| {
            let apart = corners.iter().map(|corner| {
                let [a, b] = [found, &board].map(|pose| pose.apply(*corner));
                (0..3).map(|k| (a[k] - b[k]).abs()).fold(0.0, f64::max)
            });
            apart.fold(0.0, f64::max)
        };
        match placed(&sights) {
            Some(found) if off(&found) < 1e-5 => {}
            found => wrong.push((i, thickness, count, found.map(|found| off(&found)))),
        }
    }
    println!("{} of 1000: {wrong:?}", wrong.len());
    assert!(wrong.is_empty());
}
