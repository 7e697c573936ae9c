//! Section 5 of the paper, compared with its published figures.

use core::f64::consts::FRAC_PI_2;

use super::by_hand::{Pps, Puma};
use super::*;
use abbe_core::Manipulator;
use abbe_core::lanes::OneByOne;
use abbe_kinematics::sampling::grid;

mod blocks;
mod combined;

/// Returns 27 points of the volume at 37 spin angles, each presented at the isocenter.
fn presentation() -> Presentation {
    Presentation {
        point: [1128.0, 1626.0, 1846.0],
        tool_points: vec![
            Axis { index: 0, values: grid([-250.0, 250.0], 3) },
            Axis { index: 1, values: grid([-100.0, 300.0], 3) },
            Axis { index: 2, values: grid([600.0, 1100.0], 3) },
        ],
        approaches: vec![Axis { index: 3, values: grid([-FRAC_PI_2, FRAC_PI_2], 37) }],
        solved: vec![0, 1, 2],
    }
}

/// Checks agreement to the last printed digit.
fn near(found: f64, expected: f64, digits: i32) {
    assert!((found - expected).abs() <= 0.5 * 10_f64.powi(-digits), "{found} instead of {expected}");
}

#[test]
fn workspace_is_the_inverse_in_closed_form() {
    let workspace = presented_volume(&Pps, &presentation()).unwrap();
    let configurations = workspace.reached();
    assert_eq!((configurations.len(), workspace.len()), (999, 999));
    for Configuration { q, s, .. } in &configurations {
        let (sin, cos) = q[3].sin_cos();
        assert!((q[0] - (1128.0 - (s[0] * cos + s[2] * sin))).abs() < 1e-9);
        assert!((q[1] - (380.0 - s[1])).abs() < 1e-9);
        assert!((q[2] - (1128.0 - (s[2] * cos - s[0] * sin))).abs() < 1e-9);
    }
}

#[test]
fn budget_is_the_papers() {
    let workspace = presented_volume(&Pps, &presentation()).unwrap();
    let (mut rows, mut largest) = (0, 0.0);
    let budget = error_budget(&OneByOne(Pps), &workspace, BudgetOptions::default(), &mut |row: &Row| {
        assert_eq!(row.index, rows);
        rows += 1;
        largest = f64::max(largest, sampling::norm(Measurand::Position.rows(&row.repeatable)));
    })
    .unwrap();
    assert_eq!(rows, 999);

    let [rail, spin, arm, ..] = &budget.sources[..] else { panic!("three sources at least") };
    near(rail.half_peak_to_peak.x, 0.2197, 4);
    near(rail.half_peak_to_peak.y, 0.0, 4);
    near(rail.half_peak_to_peak.z, 0.0774, 4);
    near(rail.plain_max.x, 0.3341, 4);
    near(rail.plain_max.z, 0.2042, 4);
    near(spin.plain_max.x, 0.0710, 4);
    near(spin.plain_max.z, 0.0710, 4);
    assert_eq!(spin.half_peak_to_peak, spin.plain_max);
    near(arm.plain_max.x, 0.120, 3);
    near(arm.plain_max.y, 0.440, 3);
    near(arm.plain_max.z, 0.250, 3);

    let combined = &budget.combined;
    near(combined.random_radius.value, 0.0992, 4);
    near(combined.repeatable_radius.value, 5.381, 3);
    near(combined.radius.value, 5.480, 3);
    assert_eq!(combined.repeatable_radius.value, largest);
}

#[test]
fn identifiable_errors_are_counted() {
    for (moved, measurement, own, with_base) in [
        (6, Measurement::Pose, 22, 24),
        (6, Measurement::Point, 19, 21),
        (4, Measurement::Pose, 14, 16),
        (4, Measurement::Point, 11, 13),
    ] {
        let moved = (0..moved).collect::<Vec<_>>();
        let workspace = joint_samples(&Pps, &moved, 300).unwrap();
        for (base, rank) in [(false, own), (true, with_base)] {
            let found = identifiable(&Pps, &workspace.reached(), measurement, base).unwrap();
            assert_eq!((found.rank, found.unknowns), (rank, if base { 42 } else { 36 }));
        }
    }
}

#[test]
fn identifiable_errors_of_a_6r_arm_are_counted() {
    let workspace = joint_samples(&Puma, &[0, 1, 2, 3, 4, 5], 50).unwrap();
    for (measurement, base, rank) in [
        (Measurement::Pose, false, 26),
        (Measurement::Pose, true, 30),
        (Measurement::Point, false, 23),
        (Measurement::Point, true, 27),
    ] {
        let found = identifiable(&Puma, &workspace.reached(), measurement, base).unwrap();
        assert_eq!(found.rank, rank);
        let (kept, dropped) = found.gap();
        assert!(kept.unwrap() > 1e-5 && dropped.unwrap() < 1e-12, "{kept:?} {dropped:?}");
    }
}

#[test]
fn a_6r_arm_reaches_what_it_can() {
    let description = Puma.description();
    let Configuration { q: start, s, .. } = Configuration::home(description);
    let all = [0, 1, 2, 3, 4, 5];
    for index in 0..40 {
        let q = sampling::joint_sample(description, 2.0, &all, index);
        let pose = Puma.pose(&q, &s).unwrap();
        for target in [Target::Pose(pose), Target::Point(pose.position())] {
            let found = inverse(&Puma, &s, &start, &all, &target);
            let found = found.unwrap_or_else(|error| panic!("sample {index}, {target:?}: {error}"));
            let reached = Puma.pose(&found, &s).unwrap();
            for (value, variable) in found.iter().zip(&description.variables) {
                assert!(variable.limits[0] <= *value && *value <= variable.limits[1]);
            }
            let difference = abbe_core::deviation(description.orientation, &reached, &pose);
            let rows = if matches!(target, Target::Pose(_)) { 6 } else { 3 };
            assert!(difference[..rows].iter().all(|row| row.abs() < 1e-9));
        }
    }
    let far = Target::Point([5.0, 0.0, 0.0]);
    let Err(ReachError::OutOfReach { residual, .. }) = inverse(&Puma, &s, &start, &all, &far) else {
        panic!("out of reach")
    };
    assert!(residual > 3.5 && residual < 4.2, "{residual}");
}

#[test]
fn empty_workspace_has_no_errors() {
    let workspace = joint_samples(&Pps, &[], 0).unwrap();
    let budget = error_budget(&OneByOne(Pps), &workspace, BudgetOptions::default(), &mut ()).unwrap();
    assert_eq!((budget.combined, budget.configurations), (Combined::default(), 0));
    assert!(budget.sources.iter().all(|source| source.half_peak_to_peak == Figures::default()));
    assert_eq!(identifiable(&Pps, &[], Measurement::Pose, true).unwrap().rank, 0);

    let refused = listed(&Pps, vec![Configuration { q: vec![0.0; 5], s: vec![0.0; 3], u: Vec::new() }]);
    assert!(matches!(refused, Err(abbe_core::Error::Count { expected: 6, found: 5, .. })));
    // The workspace of another manipulator.
    let refused = error_budget(&OneByOne(Puma), &workspace, BudgetOptions::default(), &mut ()).unwrap_err();
    assert_eq!(refused.configuration, None);
}

fn home() -> Configuration {
    Configuration::home(Pps.description())
}

#[test]
fn pose_and_point_targets_are_reached() {
    let Configuration { q: start, s, .. } = home();
    let q = [700.0, 200.0, 900.0, -0.7, 0.03, -0.02];
    let pose = Pps.pose(&q, &s).unwrap();
    let found = inverse(&Pps, &s, &start, &[0, 1, 2, 3, 4, 5], &Target::Pose(pose)).unwrap();
    for (found, expected) in found.iter().zip(q) {
        assert!((found - expected).abs() < 1e-7);
    }
    // Six variables for three rows.
    let target = pose.position();
    let found = inverse(&Pps, &s, &start, &[0, 1, 2, 3, 4, 5], &Target::Point(target)).unwrap();
    let reached = Pps.pose(&found, &s).unwrap().position();
    assert!((0..3).all(|i| (reached[i] - target[i]).abs() < 1e-6));
}

#[test]
fn a_variable_that_stops_is_named() {
    let Configuration { q, s, .. } = home();
    // d1 = 2300 would reach it.
    let target = Target::Point([2300.0, 1626.0, 1846.0]);
    let Err(ReachError::OutsideLimits { variable: 0, value, limits }) =
        inverse(&Pps, &s, &q, &[0, 1, 2], &target)
    else {
        panic!("d1 is outside its limits")
    };
    assert!((value - 2300.0).abs() < 1e-6);
    assert_eq!(limits, [0.0, 2256.0]);
    // It is reachable with spin.
    assert!(inverse(&Pps, &s, &q, &[0, 1, 2, 3], &target).is_ok());
    // A fixed variable outside its limits is not a solution.
    let held = [1128.0, 280.0, 0.0, 1.6, 0.0, 0.0];
    let refused = inverse(&Pps, &s, &held, &[0, 1, 2], &Target::Point([1128.0, 1626.0, 1846.0]));
    assert!(matches!(refused, Err(ReachError::OutsideLimits { variable: 3, value: 1.6, .. })));
}

#[test]
fn what_no_variable_reaches_is_out_of_reach() {
    let Configuration { q, s, .. } = home();
    // The lateral axis alone cannot leave its line.
    let point = Pps.pose(&q, &s).unwrap().position();
    let target = Target::Point([point[0] + 10.0, point[1] + 3.0, point[2] + 4.0]);
    let Err(ReachError::OutOfReach { residual, turn }) = inverse(&Pps, &s, &q, &[0], &target) else {
        panic!("out of reach")
    };
    assert!((residual - 5.0).abs() < 1e-6 && turn == 0.0);
    // Without free variables only the current point is reachable.
    assert_eq!(inverse(&Pps, &s, &q, &[], &Target::Point(point)).unwrap(), q);
    assert!(inverse(&Pps, &s, &q, &[], &target).is_err());
    // Spin alone: the circle about the spin axis, 1000 mm beyond it.
    let axis = [q[0], point[1], 718.0 + q[2]];
    let target = Target::Point([axis[0] + 1850.0 * 0.6, axis[1], axis[2] + 1850.0 * 0.8]);
    let Err(ReachError::OutOfReach { residual, .. }) = inverse(&Pps, &s, &q, &[3], &target) else {
        panic!("out of reach")
    };
    assert!((residual - 1000.0).abs() < 1e-3, "{residual}");
}

#[test]
fn bad_arguments_are_refused() {
    let Configuration { q, s, .. } = home();
    let target = Target::Point([f64::NAN, 0.0, 0.0]);
    assert!(matches!(inverse(&Pps, &s, &q, &[0], &target), Err(ReachError::Evaluation(_))));
    let target = Target::Point([0.0; 3]);
    for (q, s, free) in [(&q[..5], &s[..], 0), (&q[..], &s[..2], 0), (&q[..], &s[..], 6)] {
        assert!(matches!(inverse(&Pps, s, q, &[free], &target), Err(ReachError::Evaluation(_))));
    }
    assert!(joint_samples(&Pps, &[6], 1).is_err());
    assert!(joint_grid(&Pps, &[Axis { index: 9, values: vec![] }]).is_err());
    let grid = joint_grid(&Pps, &[Axis { index: 3, values: vec![0.0, 1.0] }]).unwrap();
    assert_eq!(grid.configuration(1).unwrap().q[3], 1.0);
}
