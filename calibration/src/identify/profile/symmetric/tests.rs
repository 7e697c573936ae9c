//! Tests of `symmetric.rs`.

use nalgebra::{DMatrix, DVector};

use super::{Block, Symmetric};

/// Compares sums, products, factors and inverses of 150 columns with those of nalgebra.
#[test]
fn it_computes_what_dense_matrices_do() {
    let (rows, columns) = (500, 150);
    let value = |i: usize, j: usize| ((i * 7 + j * 13) as f64 * 0.71 + (i * j) as f64 * 1.3).sin();
    let a = DMatrix::from_fn(rows, columns, value);
    let mut sum = Symmetric::zeros(columns);
    let mut block = Block::new(columns);
    for i in 0..rows {
        let row: Vec<f64> = (0..columns).map(|j| value(i, j)).collect();
        if block.push(&row) {
            sum.add(&mut block);
        }
    }
    sum.add(&mut block);
    (0..columns).for_each(|k| sum.add_at(k, k, 10.0));
    let expected = a.tr_mul(&a) + DMatrix::identity(columns, columns) * 10.0;
    let near = |a: f64, b: f64| assert!((a - b).abs() < 1e-9 * (1.0 + b.abs()), "{a} {b}");
    let x = DVector::from_fn(columns, |i, _| (i as f64).cos());
    let inverse = expected.clone().try_inverse().unwrap();
    for (found, expected) in sum.times(x.as_slice()).iter().zip((&expected * &x).iter()) {
        near(*found, *expected);
    }
    let factor = sum.clone().cholesky().unwrap();
    let root = factor.inverse_root();
    for i in 0..columns {
        for j in 0..columns {
            near(sum.at(i, j), expected[(i, j)]);
            near(root.inverse_at(i, j), inverse[(i, j)]);
        }
    }
    for (found, expected) in factor.solve(x.as_slice()).iter().zip((&inverse * &x).iter()) {
        near(*found, *expected);
    }
    sum.add_at(3, 3, -2.0 * sum.at(3, 3));
    assert!(sum.cholesky().is_none());
}
