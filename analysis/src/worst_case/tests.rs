use super::{dot, plus, scaled, worst_case};
use abbe_kinematics::sampling::norm;
use rand::rngs::SmallRng;
use rand::{RngExt, SeedableRng};

/// Returns the longest vector by trying all signs.
fn by_all_signs(center: [f64; 3], vectors: &[[f64; 3]]) -> f64 {
    let signs = 0..1_usize << vectors.len();
    let sum = |signs: usize| {
        let sign = |k: usize| if signs >> k & 1 == 0 { 1.0 } else { -1.0 };
        norm(vectors.iter().enumerate().fold(center, |sum, (k, v)| plus(sum, scaled(*v, sign(k)))))
    };
    signs.map(sum).fold(0.0, f64::max)
}

#[test]
fn it_is_the_largest_over_all_signs() {
    let mut random = SmallRng::seed_from_u64(1);
    for round in 0..600 {
        let count = round % 13;
        let mut one = |_: usize| random.random_range(-1.0..1.0_f64);
        let mut vectors: Vec<[f64; 3]> = (0..count).map(|_| core::array::from_fn(&mut one)).collect();
        let center: [f64; 3] = core::array::from_fn(&mut one);
        for (k, vector) in vectors.iter_mut().enumerate() {
            // Vectors along axes, in planes, parallel ones, and none at all.
            match round % 5 {
                1 => *vector = core::array::from_fn(|i| if i == k % 3 { vector[i] } else { 0.0 }),
                2 => vector[2] = 0.0,
                3 => *vector = scaled(center, vector[0]),
                4 if k % 2 == 0 => *vector = [0.0, vector[1].round(), vector[2].round()],
                _ => {}
            }
        }
        let center = if round % 3 == 0 { [0.0; 3] } else { center };
        let expected = by_all_signs(center, &vectors);
        let found = norm(worst_case(center, &vectors));
        assert!((found - expected).abs() <= 1e-8 * expected, "round {round}: {found}, not {expected}");
    }
}

#[test]
fn two_errors_of_one_joint_add() {
    let joint = [0.0, 0.1, 0.0];
    assert_eq!(worst_case([0.0; 3], &[joint, joint]).map(f64::abs), [0.0, 0.2, 0.0]);
    let all = worst_case([3.0, 0.0, 0.0], &[[0.0, 0.0, 4.0]]);
    assert_eq!(dot(all, all), 25.0);
}
