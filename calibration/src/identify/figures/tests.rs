//! Tests of `figures.rs`.

use super::{Distances, Figures};

#[test]
fn a_mean_is_as_sure_as_its_configurations() {
    let once = || (0..).zip([3.0, 5.0, 4.0, 8.0]);
    let ten_times: Distances = (0..10).flat_map(|_| once()).collect();
    let own = Figures::from_norms(once().map(|(_, value)| value).collect());
    let once: Distances = once().collect();
    assert_eq!(once.figures(), own);
    assert_eq!(once.clone().into_figures(), own);
    // Standard deviation √(14/3), of four.
    assert!((once.figures().standard_error - (14.0f64 / 3.0 / 4.0).sqrt()).abs() < 1e-12);
    assert!((ten_times.figures().standard_error - once.figures().standard_error).abs() < 1e-12);
    assert_eq!((ten_times.figures().count, ten_times.figures().configurations), (40, 4));
}

#[test]
fn a_comparison_is_that_of_student() {
    let at = |values: [f64; 5]| (0..).zip(values).collect::<Distances>();
    let found = at([1.0, 2.0, 3.0, 4.0, 5.0]).compared_with(&at([1.5, 2.1, 3.6, 4.4, 5.2]));
    // Differences 0.5 0.1 0.6 0.4 0.2: t = 3.882 with 4 degrees of freedom, p = 0.0178.
    assert!((found.gain - 0.36).abs() < 1e-12 && (found.p - 0.0178).abs() < 2e-4, "{found:?}");
    let same = at([1.0; 5]).compared_with(&at([1.0; 5]));
    assert_eq!((same.gain, same.p), (0.0, 1.0));
}
