//! Tests of `profiles.rs`.

use core::f64::consts::TAU;

use super::{HIGHEST, resolved_cycles};

/// Gaps do not reduce the number of cycles, the steps of a grid do, and a small range is refused.
#[test]
fn cycles_are_those_that_the_steps_resolve() {
    let cycles = |values: &[f64]| resolved_cycles(values, TAU / HIGHEST);
    let dense: Vec<f64> = (0..600).map(|i| 0.01 * f64::from(i)).collect();
    assert_eq!(cycles(&dense), Ok(64));
    let gap: Vec<f64> = dense.iter().copied().filter(|x| !(2.0..2.5).contains(x)).collect();
    assert_eq!(cycles(&gap), Ok(64));
    let grid: Vec<f64> = (0..360).map(|i| f64::from(i / 10) * TAU / 36.0).collect();
    assert_eq!(cycles(&grid), Ok(18));
    assert_eq!(cycles(&dense[..9]), Err("it turns by 4.6° only".to_owned()));
    assert_eq!(cycles(&[0.0, 6.0]), Err("its rows are at 2 positions only".to_owned()));
}
