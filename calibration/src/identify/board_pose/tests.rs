//! Tests of `board_pose.rs`.

use std::f64::consts::PI;

use abbe_core::displacement;
use rand::{RngExt, SeedableRng};
use rand_xoshiro::Xoshiro256PlusPlus;

use super::{Pose, Sight, placed, refined};

/// Number from −1 to 1.
fn draw(random: &mut Xoshiro256PlusPlus) -> f64 {
    2.0 * random.random::<f64>() - 1.0
}

/// Draws a board in front of the camera, turned by any angle about the line of sight and tilted by
/// up to 70 degrees, anywhere in an image of 60 degrees.
fn drawn_board(random: &mut Xoshiro256PlusPlus) -> Pose {
    let (roll, about, tilt) = (PI * draw(random), PI * draw(random), 1.22 * draw(random));
    let roll = displacement(&[0.0, 0.0, 0.0, 0.0, 0.0, roll]);
    let turn = [tilt * about.cos(), tilt * about.sin(), 0.0];
    let tilted = displacement(&[0.0, 0.0, 0.0, turn[0], turn[1], turn[2]]);
    let mut board = tilted.then(&roll);
    let depth = 150.0 + 400.0 * random.random::<f64>();
    board.0[3] = [0.5 * depth * draw(random), 0.5 * depth * draw(random), depth];
    board
}

fn sights(board: &Pose, corners: &[[f64; 3]], mut noise: impl FnMut() -> f64) -> Vec<Sight> {
    let mut sight = |corner: &[f64; 3]| {
        let [x, y, z] = board.apply(*corner);
        (*corner, [x / z + noise(), y / z + noise()])
    };
    corners.iter().map(&mut sight).collect()
}

/// Corners of any thickness, from a flat board to a cube, and any four or more of them, are placed
/// where they are without noise; with noise, nothing more is left than by steps from the true pose.
#[test]
fn corners_of_any_thickness_are_placed() {
    let mut random = Xoshiro256PlusPlus::seed_from_u64(3);
    let (mut wrong, mut worse) = (Vec::new(), Vec::new());
    for i in 0..1000 {
        let thickness = [0.0, 1e-4, 0.01, 0.03, 0.1, 0.3, 1.0][i % 7];
        let count = 4 + i / 7 % 9;
        let corners: Vec<[f64; 3]> =
            (0..count).map(|_| [30.0, 30.0, 30.0 * thickness].map(|side| side * draw(&mut random))).collect();
        let board = drawn_board(&mut random);
        let apart = |found: &Pose| {
            let apart = corners.iter().map(|corner| {
                let [a, b] = [found, &board].map(|pose| pose.apply(*corner));
                (0..3).map(|k| (a[k] - b[k]).abs()).fold(0.0, f64::max)
            });
            apart.fold(0.0, f64::max)
        };
        match placed(&sights(&board, &corners, || 0.0)) {
            Some(found) if apart(&found) < 1e-5 => {}
            found => wrong.push((i, thickness, count, found.map(|found| apart(&found)))),
        }
        // A tenth of a pixel for a focal length of 1000.
        let noisy = sights(&board, &corners, || 1e-4 * draw(&mut random));
        let left = |board: Pose| refined(board, &noisy).map(|(left, _)| left);
        if let Some(true_left) = left(board)
            && !placed(&noisy).and_then(left).is_some_and(|left| left <= true_left * (1.0 + 1e-6) + 1e-20)
        {
            worse.push((i, thickness, count, true_left));
        }
    }
    println!("{} wrong: {wrong:?}; {} worse: {worse:?}", wrong.len(), worse.len());
    assert!(wrong.is_empty() && worse.is_empty());
}

/// Corners on a line do not place a board, nor do three.
#[test]
fn corners_on_a_line_place_nothing() {
    let mut random = Xoshiro256PlusPlus::seed_from_u64(5);
    for _ in 0..100 {
        let along = [0; 3].map(|_| 40.0 * draw(&mut random));
        let from = [0; 3].map(|_| 10.0 * draw(&mut random));
        let corners: Vec<[f64; 3]> = (0..6)
            .map(|_| draw(&mut random))
            .map(|share| core::array::from_fn(|k| from[k] + share * along[k]))
            .collect();
        let board = drawn_board(&mut random);
        assert!(placed(&sights(&board, &corners, || 0.0)).is_none());
        assert!(placed(&sights(&board, &corners[..3], || 0.0)).is_none());
    }
}
