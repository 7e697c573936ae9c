//! Tests of `statistics.rs`.

use super::{deviation_beyond, f_test, student_beyond};

#[test]
fn probabilities_are_those_of_the_tables() {
    // Upper 5 % points of F: 4.96 for (1, 10), 3.33 for (5, 10), 2.21 for (4, 1000 is 2.38).
    for (k, n, f) in [(1, 10, 4.9646), (5, 10, 3.3258), (4, 60, 2.5252), (10, 20, 2.3479)] {
        let before = 1.0 + f * k as f64 / n as f64;
        let found = f_test(before, 1.0, k, n);
        assert!((found.p - 0.05).abs() < 1e-4, "{k} {n}: {}", found.p);
    }
    assert_eq!(f_test(1.0, 1.0, 3, 30).p, 1.0);
    // χ² of 10: 2.5 % below 3.247, 2.5 % above 20.483.
    for square in [3.247f64, 20.483] {
        assert!((deviation_beyond((square / 10.0).sqrt(), 10.0) - 0.05).abs() < 2e-3);
    }
    // Student's t: 2.5 % above.
    let of_student = [(1, 12.706_205), (2, 4.302_653), (5, 2.570_582), (8, 2.306_004), (30, 2.042_272)];
    for (freedom, t) in of_student.into_iter().chain([(10, 2.228_139), (100, 1.983_972)]) {
        let freedom = f64::from(freedom);
        assert!((student_beyond(t, freedom) - 0.05).abs() < 1e-6, "{freedom}");
        assert!((abbe_analysis::student_95(freedom) - t).abs() < 1e-5, "{freedom}");
    }
    assert_eq!(student_beyond(0.0, 7.0), 1.0);
}
