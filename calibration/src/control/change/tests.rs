//! Tests of `change.rs`.

use rand::RngExt;
use rand_distr::StandardNormal;

use super::{Change, Kind};
use abbe_analysis::sampling::stream;

fn noisy(run: usize, t: &[f64], truth: impl Fn(f64) -> f64) -> Vec<f64> {
    let mut random = stream(17, run);
    t.iter().map(|t| truth(*t) + random.sample::<f64, _>(StandardNormal)).collect()
}

#[test]
fn nothing_but_the_truth_where_there_is_no_noise() {
    let t: Vec<f64> = (0..30).map(f64::from).collect();
    let drift: Vec<f64> = t.iter().map(|t| 2.0 - 0.5 * (t - 12.25).max(0.0)).collect();
    let found = Change::fit(&t, &drift).unwrap();
    assert_eq!(found.kind, Kind::Drift);
    assert!((found.since - 12.25).abs() < 1e-9 && (found.size + 0.5).abs() < 1e-9);
    assert!((found.reaches(10.0).unwrap().0 - 32.25).abs() < 1e-6);
    let jump: Vec<f64> = t.iter().map(|t| if *t > 8.5 { 3.0 } else { 1.0 }).collect();
    let found = Change::fit(&t, &jump).unwrap();
    assert_eq!((found.kind, found.since, found.between[0]), (Kind::Jump, 9.0, Some(8.0)));
    assert!((found.size - 2.0).abs() < 1e-9 && (found.moved(8.9), found.moved(9.0)) == (0.0, found.size));
    assert!(Change::fit(&t, &[1.0; 30]).is_none());
}

/// Coverage of times and speeds, over 500 machines that drift from times between numbers.
#[test]
fn uncertainties_are_what_they_say() {
    let t: Vec<f64> = (0..60).map(f64::from).collect();
    let (runs, since, speed) = (500, 33.4, 0.25);
    let (mut drifts, mut times, mut speeds, mut reached) = (0.0, 0.0, 0.0, 0.0);
    for run in 0..runs {
        let x = noisy(run, &t, |t| 5.0 + speed * (t - since).max(0.0));
        let found = Change::fit(&t, &x).unwrap();
        if found.kind == Kind::Jump {
            continue;
        }
        drifts += 1.0;
        let [first, last] = found.between.map(|end| end.unwrap_or(f64::NEG_INFINITY));
        times += f64::from(u8::from(first <= since && since <= last));
        speeds += f64::from(u8::from((found.size - speed).abs() < found.standard_deviation));
        let (when, sigma) = found.reaches(10.0).unwrap();
        reached += f64::from(u8::from((when - since - 10.0 / speed).abs() < sigma));
    }
    assert!(drifts > 0.97 * runs as f64, "{drifts}");
    // Four standard errors: 4 √(0.95 · 0.05/500) = 0.039 and 4 √(0.68 · 0.32/500) = 0.083.
    assert!((times / drifts - 0.95).abs() < 0.039, "{}", times / drifts);
    assert!((speeds / drifts - 0.683).abs() < 0.083, "{}", speeds / drifts);
    assert!((reached / drifts - 0.683).abs() < 0.083, "{}", reached / drifts);
}
