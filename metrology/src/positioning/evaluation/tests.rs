//! Tests of `evaluation.rs`.

use super::*;

/// Three positions, approached three times from each side. By hand: means ↑ 1, 4, −2 and
/// ↓ 0, 2, −1; standard deviations ↑ 1, 1, 2 and ↓ 1, 2, 0.
fn targets() -> Vec<TargetRuns> {
    let target = |position, up: [f64; 3], down: [f64; 3]| TargetRuns {
        position,
        deviations: [up.to_vec(), down.to_vec()],
    };
    vec![
        target(0.0, [0.0, 1.0, 2.0], [-1.0, 0.0, 1.0]),
        target(100.0, [3.0, 4.0, 5.0], [0.0, 2.0, 4.0]),
        target(200.0, [-4.0, -2.0, 0.0], [-1.0, -1.0, -1.0]),
    ]
}

#[test]
fn characteristics_are_those_computed_by_hand() {
    let found = Evaluation::new(&targets(), None);
    let [both, up, down] = [found.bidirectional.is_some(), found.forward.is_some(), found.reverse.is_some()];
    assert!(both && up && down);
    let (Some(both), Some(up), Some(down)) = (found.bidirectional, found.forward, found.reverse) else {
        panic!("{found:?}")
    };
    let value = |one: Option<Characteristic>| one.map(|one| one.value);
    // E↑ = 4 − (−2), A↑ = (4 + 2) − (−2 − 4), R↑ = 4 · 2.
    assert_eq!(
        (up.systematic.value, value(up.accuracy), value(up.repeatability)),
        (6.0, Some(12.0), Some(8.0))
    );
    // E↓ = 2 − (−1), A↓ = (2 + 4) − min(0 − 2, 2 − 4, −1), R↓ = 4 · 2.
    assert_eq!(
        (down.systematic.value, value(down.accuracy), value(down.repeatability)),
        (3.0, Some(8.0), Some(8.0))
    );
    // A = 6 − (−6); E = 4 − (−2); M = 3 − (−1.5); R_1 = 2 + 2 + 1, R_2 = 2 + 4 + 2, R_3 = max(4 + 0
    // + 1, 8); B = |4 − 2|; B̄ = (1 + 2 − 1) / 3.
    assert_eq!(value(both.accuracy), Some(12.0));
    assert_eq!((both.systematic.value, both.mean.value, both.reversal.value), (6.0, 4.5, 2.0));
    assert_eq!(value(both.repeatability), Some(8.0));
    assert!((both.mean_reversal.value - 2.0 / 3.0).abs() < 1e-15);
    let repeatability: Vec<Option<f64>> = found.positions.iter().map(|one| one.repeatability).collect();
    assert_eq!(repeatability, [Some(5.0), Some(8.0), Some(8.0)]);
}

/// The uncertainty of every characteristic is that of finite differences: of each reading with
/// its uncertainty, and of all deviations in proportion to the position.
#[test]
fn uncertainties_follow_from_every_reading() {
    let own = InstrumentUncertainty { reading: 0.1, scale: 2e-3 };
    let all = |targets: &[TargetRuns]| {
        let found = Evaluation::new(targets, Some(own));
        let (Some(both), Some(up)) = (found.bidirectional, found.forward) else { panic!("{found:?}") };
        let one = [up.accuracy, Some(up.systematic), both.accuracy, both.repeatability];
        let list =
            one.into_iter().flatten().chain([both.systematic, both.mean, both.reversal, both.mean_reversal]);
        list.map(|one| (one.value, one.uncertainty.unwrap_or(f64::NAN))).collect::<Vec<_>>()
    };
    // Unlike above, no standard deviation is 0 and no extreme is reached twice.
    let mut start = targets();
    start[1].deviations[1] = vec![0.5, 2.0, 3.2];
    start[2].deviations = [vec![-4.0, -2.0, -0.5], vec![-1.2, -1.1, -0.9]];
    let change = |i: usize, d: usize, j: usize, step: f64| {
        let mut moved = start.clone();
        moved[i].deviations[d][j] += step;
        all(&moved)
    };
    let scaled = |step: f64| {
        let mut moved = start.clone();
        for target in &mut moved {
            let shift = step * target.position;
            target.deviations.iter_mut().flatten().for_each(|deviation| *deviation += shift);
        }
        all(&moved)
    };
    let step = 1e-6;
    for (k, (_, uncertainty)) in all(&start).into_iter().enumerate() {
        let slope = |plus: Vec<(f64, f64)>, minus: Vec<(f64, f64)>| (plus[k].0 - minus[k].0) / (2.0 * step);
        let mut variance = (own.scale * slope(scaled(step), scaled(-step))).powi(2);
        for (i, d, j) in (0..3).flat_map(|i| (0..2).flat_map(move |d| (0..3).map(move |j| (i, d, j)))) {
            variance += (own.reading * slope(change(i, d, j, step), change(i, d, j, -step))).powi(2);
        }
        assert!((uncertainty / (2.0 * variance.sqrt()) - 1.0).abs() < 1e-6, "{k}: {uncertainty} {variance}");
    }
}

#[test]
fn one_approach_has_no_repeatability_and_one_direction_no_reversal() {
    let single = [0.0, 1.0].map(|position| TargetRuns { position, deviations: [vec![position], Vec::new()] });
    let found = Evaluation::new(&single, None);
    assert!(found.bidirectional.is_none() && found.reverse.is_none());
    let Some(up) = found.forward else { panic!("{found:?}") };
    assert!(up.accuracy.is_none() && up.repeatability.is_none());
    assert_eq!(up.systematic.value, 1.0);
}
