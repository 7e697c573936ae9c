//! Tests of `acceptance.rs`.

use abbe::LengthUnit;

use super::{Acceptance, Decision::*, Judged};
use crate::sizes::Sizes;

#[test]
fn limits_are_parsed_and_compared() {
    let limits = Acceptance::read("--accept", "mean 0.15 mm, max 300 um", LengthUnit::Millimetre).unwrap();
    assert_eq!(limits.limits, [("mean", 0.15), ("max", 0.3)]);
    let sizes = Sizes { mean: 0.1, standard_error: None, rms: 0.2, max: 0.31, p95: 0.2 };
    let verdict =
        |limits: &Acceptance, noise| limits.verdict((Judged::Machine, "the test rows"), &sizes, (noise, 100));
    let exact = verdict(&limits, 0.0).unwrap();
    assert_eq!(exact.limits.iter().map(|limit| limit.decision).collect::<Vec<_>>(), [Accepted, Rejected]);
    // The largest is 10 µm beyond its limit, known to 16 µm; the mean is known ten times better.
    let decided = verdict(&limits, 0.01).unwrap();
    assert_eq!(decided.limits.iter().map(|limit| limit.decision).collect::<Vec<_>>(), [Accepted, Undecided]);
    assert!(!exact.is_met() && exact.decision == Rejected && decided.decision == Undecided);
    assert!(verdict(&Acceptance::default(), 0.0).is_none());
    for wrong in ["median 1 mm", "mean", "mean 1 deg", "", "target fitted", "max 1 mm, target"] {
        assert!(Acceptance::read("--accept", wrong, LengthUnit::Millimetre).is_err(), "{wrong}");
    }
}
