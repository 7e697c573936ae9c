//! Tests of `profiles.rs`.

use super::covered;

/// A range ends before a gap, and is none if many values are beyond it or if all are at a few
/// places.
#[test]
fn ranges_have_no_gaps() {
    let dense: Vec<f64> = (0..100).map(|i| 0.01 * f64::from(i)).collect();
    assert_eq!(covered(&dense, 0.1), Some([0.0, 0.99]));
    let tail = [&dense[..], &[1.5, 1.55]].concat();
    assert_eq!(covered(&tail, 0.1), Some([0.0, 0.99]));
    let halves: Vec<f64> = dense.iter().map(|x| if *x < 0.5 { *x } else { x + 1.0 }).collect();
    assert_eq!(covered(&halves, 0.1), None);
    let grid: Vec<f64> = (0..100).map(|i| f64::from(i / 10)).collect();
    assert_eq!(covered(&grid, 0.1), None);
    assert_eq!(covered(&dense[..8], 0.1), None);
}
