//! Tests of `bounded.rs`.

use nalgebra::{DMatrix, DVector};

use super::bounded;
use crate::sampling::halton;

/// Compares the result with the best over all active sets.
#[test]
fn it_is_the_best_of_all_sets() {
    for seed in 0..200 {
        let value = |i: usize, j: usize| 2.0 * halton(1 + 100 * seed + i, j) - 1.0;
        let (m, n) = (6, 4);
        let a = DMatrix::from_fn(m, n, value);
        let b = DVector::from_fn(m, |i, _| 3.0 * value(i, 9));
        let lower: Vec<f64> = (0..n).map(|j| -value(j, 20).abs()).collect();
        let upper: Vec<f64> = (0..n).map(|j| value(j, 21).abs()).collect();
        let cost = |p: &DVector<f64>| (&a * p + &b).norm_squared();
        let mut best = f64::INFINITY;
        for set in 0..3_usize.pow(n as u32) {
            let place = |j: usize| set / 3_usize.pow(j as u32) % 3;
            let mut p = DVector::from_fn(n, |j, _| [lower[j], upper[j], 0.0][place(j)]);
            let free: Vec<usize> = (0..n).filter(|j| place(*j) == 2).collect();
            if !free.is_empty() {
                let part = a.select_columns(&free);
                let wanted = part.transpose() * -(&a * &p + &b);
                let solved = (part.transpose() * &part).cholesky().unwrap().solve(&wanted);
                free.iter().zip(solved.iter()).for_each(|(j, value)| p[*j] = *value);
            }
            if (0..n).all(|j| (lower[j]..=upper[j]).contains(&p[j])) {
                best = best.min(cost(&p));
            }
        }
        let found = bounded(&a, &b, &lower, &upper).unwrap();
        assert!((0..n).all(|j| (lower[j]..=upper[j]).contains(&found[j])));
        assert!(cost(&found) <= best * (1.0 + 1e-12), "{seed}: {} and {best}", cost(&found));
    }
}
