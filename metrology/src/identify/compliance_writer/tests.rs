//! Tests of `compliance_writer.rs`.

use super::{deficits, is_semidefinite};

#[test]
fn an_indefinite_matrix_plus_its_deficits_is_semidefinite() {
    let good = [[2.0, 1.0, 0.0], [1.0, 2.0, -0.5], [0.0, -0.5, 1.0]];
    assert!(is_semidefinite(&good));
    for bad in [
        [[0.0, 1.0, 0.0], [1.0, 2.0, 0.0], [0.0, 0.0, 1.0]],
        [[1.0, 0.9, 0.9], [0.9, 1.0, -0.9], [0.9, -0.9, 1.0]],
        [[-1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]],
    ] {
        assert!(!is_semidefinite(&bad), "{bad:?}");
        let (off, mut sum) = (deficits(&bad), bad);
        (0..3).for_each(|i| sum[i][i] += off[i]);
        assert!(is_semidefinite(&sum) && off.iter().all(|d| *d >= 0.0), "{sum:?}");
    }
}
