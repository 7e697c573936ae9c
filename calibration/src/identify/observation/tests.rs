//! Tests of `observation.rs`.

use super::{Approach, Measurement, Observation};

/// The memory of a million rows is a million times this.
#[test]
fn a_row_is_small() {
    assert_eq!(size_of::<Measurement>(), 32);
    assert_eq!(size_of::<Observation>(), 136);
    assert_eq!(size_of::<Approach>(), 32);
}
