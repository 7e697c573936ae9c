//! Tests of `acceptance.rs`.

use abbe::LengthUnit;

use super::Acceptance;
use crate::sizes::Sizes;

#[test]
fn limits_are_parsed_and_compared() {
    let limits = Acceptance::read("--accept", "mean 0.15 mm, max 300 um", LengthUnit::Millimetre).unwrap();
    assert_eq!(limits.limits, [("mean", 0.15), ("max", 0.3)]);
    let sizes = Sizes { mean: 0.1, standard_error: None, rms: 0.2, max: 0.31, p95: 0.2 };
    let verdict = limits.verdict("the test rows", &sizes).unwrap();
    assert!(!verdict.met && verdict.limits[0].met && !verdict.limits[1].met);
    assert!(Acceptance::default().verdict("the test rows", &sizes).is_none());
    for wrong in ["median 1 mm", "mean", "mean 1 deg", ""] {
        assert!(Acceptance::read("--accept", wrong, LengthUnit::Millimetre).is_err(), "{wrong}");
    }
}
