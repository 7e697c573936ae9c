//! Tests of `triangle.rs`.

use nalgebra::{DMatrix, DVector};

use super::{Problem, Triangle};

#[test]
fn it_keeps_what_least_squares_need() {
    let value = |i: usize, j: usize| ((i * 7 + j * 13) as f64 * 0.71).sin() + f64::from(u8::from(i % 5 == j));
    let (m, p) = (1003, 5);
    let mut triangle = Triangle::new(p);
    let mut half = Triangle::new(p);
    for i in 0..m {
        let row: Vec<f64> = (0..p).map(|j| value(i, j)).collect();
        if i < 400 { &mut triangle } else { &mut half }.push(&row, value(i, p), 1.0);
    }
    triangle.merge(half);
    let r = triangle.finish();
    let x = Problem::from_triangle(r.clone()).solve(0.0).unwrap();
    let a = DMatrix::from_fn(m, p, value);
    let b = DVector::from_fn(m, |i, _| value(i, p));
    let expected = (a.transpose() * &a).cholesky().unwrap().solve(&(a.transpose() * &b));
    assert!((&x - expected).norm() < 1e-12);
    let problem = Problem::from_triangle(r);
    // The damped normal equations have the same solution.
    let g = problem.a.tr_mul(&problem.b);
    assert!((problem.solve_normal(&g, 0.1).unwrap() - problem.solve(0.1).unwrap()).norm() < 1e-12);
    assert!(((&problem.a * &x - &problem.b).norm_squared() - (a * x - b).norm_squared()).abs() < 1e-9);
}
