//! Tests of `ticks.rs`.

use super::ticks;
use crate::scene::{Axis, Scale};

fn labels(axis: &Axis, about: usize) -> Vec<String> {
    ticks(axis, about).into_iter().map(|tick| tick.label).collect()
}

#[test]
fn ticks_are_round() {
    let axis = Axis::linear("d1", "mm", [0.0, 2256.0]);
    assert_eq!(labels(&axis, 6), ["0", "500", "1000", "1500", "2000"]);
    let axis = Axis::linear("d1", "mm", [-0.123, 0.34]);
    assert_eq!(labels(&axis, 5), ["-0.1", "0", "0.1", "0.2", "0.3"]);
    let axis = Axis::linear("q4", "deg", [-90.0, 90.0]);
    assert_eq!(labels(&axis, 7), ["-90", "-60", "-30", "0", "30", "60", "90"]);
    assert_eq!(labels(&Axis::linear("d1", "mm", [1.0, 1.0]), 5), ["1"]);
}

#[test]
fn ticks_of_logarithms_are_powers_of_ten() {
    let axis = Axis::linear("distance", "mm", [2e-5, 30.0]).scaled(Scale::Logarithmic);
    assert_eq!(labels(&axis, 8), ["0.0001", "0.001", "0.01", "0.1", "1", "10"]);
    assert_eq!(labels(&axis, 3), ["0.0001", "0.01", "1"]);
}

#[test]
fn ticks_of_dates_are_days_months_or_years() {
    let axis = |range| Axis::linear("", "", range).scaled(Scale::Dates);
    assert_eq!(
        labels(&axis([20_526.0, 20_529.5]), 4),
        ["2026-03-14", "2026-03-15", "2026-03-16", "2026-03-17"]
    );
    assert_eq!(labels(&axis([20_526.0, 20_626.0]), 4), ["2026-04-01", "2026-05-01", "2026-06-01"]);
    assert_eq!(labels(&axis([20_526.0, 20_726.0]), 3), ["2026-04-01", "2026-07-01"]);
    assert_eq!(labels(&axis([20_526.0, 22_626.0]), 3), ["2028-01-01", "2030-01-01"]);
}
