//! Tests of `points.rs`.

use std::ops::Range;

use abbe::analysis::Configuration;

use super::super::errors::Errors;
use super::Points;

#[test]
fn points_are_few_and_evenly_spaced() {
    let configuration = Configuration { q: Vec::new(), s: Vec::new(), u: Vec::new() };
    let over = |range: Range<usize>| {
        let mut points = Points::default();
        for i in range {
            let repeatable = [i as f64, 0.0, 0.0];
            points.add(i, &Errors { repeatable, random: [0.0; 3], random_norm: 0.0 }, false, &configuration);
        }
        points
    };
    let points = over(0..54_321);
    assert!((2500..=5000).contains(&points.kept.len()), "{}", points.kept.len());
    for pair in points.kept.windows(2) {
        assert_eq!(pair[1].error[0] - pair[0].error[0], 16.0);
    }
    assert_eq!(points.worst.as_ref().map(|(norm, _)| *norm), Some(54_320.0));
    // Points gathered in parts equal those gathered in one run.
    let mut parts = over(0..17);
    parts.append(over(17..40_001));
    parts.append(over(40_001..54_321));
    assert_eq!(format!("{parts:?}"), format!("{points:?}"));
}
