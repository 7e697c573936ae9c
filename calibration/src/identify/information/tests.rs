//! Tests of `information.rs`.

use super::compressed;
use nalgebra::DMatrix;

/// Rows of rank two keep their information in two rows.
#[test]
fn compressed_rows_have_the_same_information() {
    let left = DMatrix::from_fn(9, 2, |i, j| ((3 * i + j) as f64).sin());
    let right = DMatrix::from_fn(2, 5, |i, j| ((2 * i + 7 * j) as f64).cos());
    let rows = left * right;
    let few = compressed(rows.clone()).rows(0, 2).into_owned();
    assert!((few.tr_mul(&few) - rows.tr_mul(&rows)).amax() < 1e-12);
}
