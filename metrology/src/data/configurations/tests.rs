//! Tests of `configurations.rs`.

use super::{levels, numbered};

#[test]
fn pairs_are_numbered_as_they_come() {
    assert_eq!(numbered(&[7, 1, 7, 7, 1, 0], &[2, 0, 3, 2, 0, 2]), [0, 1, 2, 0, 1, 3]);
    assert_eq!(numbered(&[], &[]), [0_u32; 0]);
}

#[test]
fn values_within_the_resolution_are_the_same() {
    let values = [0.5, 0.50005, 0.5002, -0.3, 0.49999, 0.5003];
    assert_eq!(levels(&values, Some(1e-4)), [2, 2, 3, 1, 2, 3]);
    // Closely spaced values do not merge into one level.
    let dense: Vec<f64> = (0..1000).map(|i| f64::from(i) * 5e-5).collect();
    assert!(levels(&dense, Some(1e-4)).iter().max() > Some(&300));
    assert_eq!(levels(&[1.0, 1.0, 1.0], None), [1, 1, 1]);
    assert_eq!(levels(&[0.0, 0.005, 1.0], None), [1, 1, 2]);
}
