//! Tests of `clustered.rs`.

use nalgebra::{DMatrix, DVector};

use super::{raised, root};

/// The two formulas agree, for few numbers of many unknowns and for many of few.
#[test]
fn numbers_and_unknowns_say_the_same() {
    for (p, m, size) in [(3, 5, 0.05), (3, 5, 0.3), (5, 3, 0.05), (5, 3, 0.3)] {
        let j = DMatrix::from_fn(p, m, |k, i| size * (1.0 + 1.7 * k as f64 + 0.9 * (i * i) as f64).sin());
        let r = DVector::from_fn(m, |i, _| (2.0 + i as f64).cos());
        let (found, squares, spent) = raised(&j.as_view(), &r.as_view());
        let (expected, of_numbers, _) = root(j.tr_mul(&j), &r);
        let (_, of_unknowns, _) = root(&j * j.transpose(), &(&j * &r));
        assert!((found - &j * expected).norm() < 1e-5 && spent == 0.0);
        assert!((squares - of_numbers).abs() < 1e-4);
        assert!((squares - r.norm_squared() - of_unknowns).abs() < 1e-4);
    }
}

#[test]
fn the_series_is_the_root() {
    let v = DVector::from_vec(vec![0.3, -1.2, 0.7]);
    let u = DVector::from_vec(vec![0.1, 0.15, -0.05]);
    let small = &u * u.transpose();
    let (series, squares, _) = root(small.clone(), &v);
    let inverse = (DMatrix::identity(3, 3) - small).try_inverse().unwrap();
    assert!((squares - v.dot(&(&inverse * &v))).abs() < 1e-4);
    assert!((series.norm_squared() - squares).abs() < 1e-4);
    let large = DMatrix::from_diagonal(&DVector::from_vec(vec![0.75, 0.0, 1.0]));
    let (raised, squares, spent) = root(large, &v);
    assert!((raised[0] - 0.6).abs() < 1e-12 && (raised[1] + 1.2).abs() < 1e-12 && raised[2] == 0.0);
    assert!((squares - (0.36 + 1.44)).abs() < 1e-12 && spent == 1.0);
}
