//! Tests of `values.rs`.

use super::Points;

#[test]
fn they_are_what_they_were_made_of() {
    for count in 0..12 {
        let values: Vec<f64> = (0..count).map(f64::from).collect();
        let points: Vec<_> = values.iter().map(|v| (*v > 1.0).then_some([*v; 3])).collect();
        assert_eq!(*Points::from(points.clone()), points[..]);
    }
}
