//! Identifiable combinations against theory.

use super::*;
use crate::by_hand::{Pps, Puma};
use abbe_core::Manipulator;

/// Returns the rank, and checks it against the groups from joint twists.
fn counted(robot: &dyn Manipulator, moved: &[usize], points: usize, base: bool) -> usize {
    let (targets, pose) = match points {
        0 => (vec![[0.0; 3]], true),
        1 => (vec![[0.0; 3]], false),
        _ => (TARGETS.to_vec(), false),
    };
    let data = sampled(robot, moved, 80, points);
    let model = Model::ideal(robot, targets, Uncertainty { length: 1.0, angle: 1e-3 });
    let kept = |unknown: &Unknown| match unknown {
        Unknown::Error(..) => true,
        Unknown::Base(..) => base,
        _ => false,
    };
    let model = model.with(model.constants(pose).into_iter().filter(kept).collect());
    let zero = vec![0.0; model.unknowns.len()];
    let known = identifiable(&model, &data, &zero).unwrap();
    assert!(known.gap > 1e6, "{}", known.gap);
    let found = groups(&model, &data[0].q, moved, pose).unwrap();
    assert_eq!(known.rank + found.len(), model.unknowns.len());
    // The errors of each group move everything as their equivalents do.
    for group in found {
        let mut x = zero.clone();
        let place = |unknown| model.unknowns.iter().position(|u| *u == unknown).unwrap();
        group.these.iter().for_each(|(unknown, factor)| x[place(*unknown)] += factor);
        group.act_as.iter().for_each(|(unknown, factor)| x[place(*unknown)] -= factor);
        for seen in &data {
            let (_, rows) = residuals(&model, seen, &zero);
            for row in rows {
                let sum: f64 = row.iter().zip(&x).map(|(a, b)| a * b).sum();
                assert!(sum.abs() < 1e-6, "{group:?} {sum}");
            }
        }
    }
    // Fixed unknowns act as their equivalents.
    for (k, act_as) in &known.redundant {
        let (_, rows) = residuals(&model, &data[7], &zero);
        for row in rows {
            let sum: f64 = act_as.iter().map(|(j, factor)| row[*j] * factor).sum();
            assert!((sum - row[*k]).abs() < 1e-5 * row[*k].abs().max(1.0));
        }
    }
    known.rank
}

#[test]
fn counts_are_those_of_theory() {
    let four = &[0, 1, 2, 3][..];
    let six = &[0, 1, 2, 3, 4, 5][..];
    for (moved, points, base, expected) in [
        (six, 0, false, 22),
        (six, 0, true, 24),
        (six, 3, false, 22),
        (six, 3, true, 24),
        (six, 1, false, 19),
        (six, 1, true, 21),
        (four, 0, false, 14),
        (four, 3, true, 16),
        (four, 1, false, 11),
        (four, 1, true, 13),
    ] {
        assert_eq!(counted(&Pps, moved, points, base), expected, "{moved:?} {points} {base}");
    }
    assert_eq!(counted(&Puma, six, 0, false), 26);
    assert_eq!(counted(&Puma, six, 0, true), 30);
}

#[test]
fn too_little_is_said() {
    let model = Model::ideal(&Pps, vec![[0.0; 3]], EXACT);
    let model = model.with(model.constants(false));
    // As many numbers as unknowns of these rows, but other rows have more of them.
    let data = sampled(&Pps, &[0, 1, 2, 3, 4, 5], 6, 1);
    assert!(matches!(fit(&model, &data, &Options::default()), Err(Failure::TooFew { numbers: 18, .. })));
    // Nothing can be tested with 21 numbers of 21 unknowns, without a stated uncertainty.
    let model = Model { stated_freedom: 0.0, ..model };
    let data = sampled(&Pps, &[0, 1, 2, 3, 4, 5], 7, 1);
    assert!(matches!(fit(&model, &data, &Options::default()), Err(Failure::TooFew { numbers: 21, .. })));
    assert!(matches!(
        fit(&model, &[], &Options::default()),
        Err(Failure::TooFew { numbers: 0, rank: 0, .. })
    ));
}
