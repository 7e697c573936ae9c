//! Tests of `observation.rs`.

use super::{Approach, Measurement, Observation, Points};

/// The memory of a million rows is a million times this.
#[test]
fn a_row_is_small() {
    assert_eq!(size_of::<Measurement>(), 32);
    assert_eq!(size_of::<Observation>(), 136);
    assert_eq!(size_of::<Approach>(), 32);
}

#[test]
fn points_are_what_they_were_made_of() {
    for count in 0..12 {
        let values: Vec<f64> = (0..count).map(f64::from).collect();
        let points: Vec<_> = values.iter().map(|v| (*v > 1.0).then_some([*v; 3])).collect();
        assert_eq!(*Points::from(points.clone()), points[..]);
    }
}
