//! Tests of the search: lanes against single searches, and independence of batches.

use super::Target;
use super::inverse::{Inverse, inverse};
use super::joint_chain::JointChain;
use super::search::Search;
use super::target_search::Problem;
use crate::by_hand::{Pps, Puma};
use crate::{Configuration, ReachError, sampling};
use abbe_core::{Description, Error, Frame, Function, List, Manipulator, Pose};

/// Manipulator with an altered promise of lower pairs.
struct Opaque<'a>(&'a dyn Manipulator, Description);

impl<'a> Opaque<'a> {
    fn new(manipulator: &'a dyn Manipulator, lower_pair: bool) -> Self {
        let mut description = manipulator.description().clone();
        let frames = description.frames.iter().map(|frame| Frame { lower_pair, ..frame.clone() });
        description.frames = frames.collect::<List<Frame>>();
        Self(manipulator, description)
    }
}

impl Manipulator for Opaque<'_> {
    fn description(&self) -> &Description {
        &self.1
    }

    fn evaluate(
        &self,
        function: Function,
        arguments: &[&[f64]],
        results: &mut [&mut [f64]],
    ) -> Result<(), Error> {
        self.0.evaluate(function, arguments, results)
    }
}

/// Returns points inside, at the edge of and beyond the workspace: some as poses of random
/// configurations, some with the orientation of home.
fn targets(manipulator: &dyn Manipulator, count: usize, poses: bool) -> Vec<Target> {
    let description = manipulator.description();
    let Configuration { q: home, s, .. } = Configuration::home(description);
    let arm = sampling::arm_length(manipulator, &s).unwrap();
    let all: Vec<usize> = (0..home.len()).collect();
    let at_home = manipulator.pose(&home, &s).unwrap();
    let target = |index: usize| {
        let q = sampling::joint_sample(description, arm, &all, index);
        let Pose([x, y, z, position]) = manipulator.pose(&q, &s).unwrap();
        let outwards = position.map(|x| x * (0.6 + 0.2 * (index % 6) as f64));
        match (poses, index % 3) {
            (false, _) => Target::Point(outwards),
            (true, 0) => Target::Pose(Pose([x, y, z, position])),
            (true, _) => Target::Pose(Pose([at_home.0[0], at_home.0[1], at_home.0[2], outwards])),
        }
    };
    (0..count).map(target).collect()
}

/// Compares lanes with single searches: they reach the same targets within the limits, and fail for
/// the same reasons.
#[test]
fn lanes_find_what_single_searches_find() {
    let robots: [&dyn Manipulator; 2] = [&Puma, &Pps];
    for manipulator in robots {
        let description = manipulator.description();
        let Configuration { q: home, s, .. } = Configuration::home(description);
        let all: Vec<usize> = (0..home.len()).collect();
        let known = Opaque::new(manipulator, true);
        for poses in [false, true] {
            let targets = targets(manipulator, 60, poses);
            let found = Inverse::new(&known, &s, &home, &all).unwrap().solve(&targets);
            let mut problem = Problem::new(manipulator, &s, &home, &all).unwrap();
            problem.spread();
            let mut reached = 0;
            for (target, found) in targets.iter().zip(found) {
                match (found, Search { problem: &problem, target }.solve()) {
                    (Ok(q), _) => {
                        reached += 1;
                        let pose = manipulator.pose(&q, &s).unwrap();
                        let (wanted, rows) = match target {
                            Target::Point(point) => (Pose([pose.0[0], pose.0[1], pose.0[2], *point]), 3),
                            Target::Pose(pose) => (*pose, 6),
                            Target::Axis { .. } => unreachable!("not among these targets"),
                        };
                        let away = abbe_core::deviation(description.orientation, &pose, &wanted);
                        let lengths = away[..3].iter().map(|x| x / problem.arm);
                        assert!(lengths.chain(away[3..rows].iter().copied()).all(|x| x.abs() < 1e-9));
                        for (value, variable) in q.iter().zip(&*description.variables) {
                            assert!(variable.limits[0] <= *value && *value <= variable.limits[1]);
                        }
                    }
                    (
                        Err(ReachError::OutOfReach { residual, .. }),
                        Err(ReachError::OutOfReach { residual: single, .. }),
                    ) => {
                        // Either may end at another local minimum of the distance.
                        assert!(
                            residual >= 0.0 && residual < 1.5 * single + 0.2 * problem.arm,
                            "{residual} {single}"
                        );
                    }
                    (Err(ReachError::OutsideLimits { .. }), Err(ReachError::OutsideLimits { .. })) => {}
                    (found, single) => panic!("{target:?}: {found:?} and {single:?}"),
                }
            }
            assert!((10..60).contains(&reached), "{reached} of 60");
        }
    }
}

/// Compares the bits of results alone and among others, in any order: threads and blocks do not
/// matter.
#[test]
fn what_is_found_does_not_depend_on_what_else_is_asked() {
    let Configuration { q: home, s, .. } = Configuration::home(Puma.description());
    let inverse = Inverse::new(&Puma, &s, &home, &[0, 1, 2, 3, 4, 5]).unwrap();
    for poses in [false, true] {
        let mut targets = targets(&Puma, 40, poses);
        let together = inverse.solve(&targets);
        for (target, found) in targets.iter().zip(&together) {
            assert_eq!(inverse.solve(&[*target]), core::slice::from_ref(found));
        }
        targets.reverse();
        let mut backwards = inverse.solve(&targets);
        backwards.reverse();
        assert_eq!(backwards, together);
    }
}

/// Checks that the chain equals the manipulator for any free variables, and that there is none
/// where lower pairs are not promised or not true.
#[test]
fn a_chain_of_lower_pairs_is_read_off() {
    let Configuration { q: home, s, .. } = Configuration::home(Puma.description());
    for free in [&[0, 1, 2, 3, 4, 5][..], &[1, 3], &[5], &[]] {
        let problem = Problem::new(&Puma, &s, &home, free).unwrap();
        let chain = JointChain::new(&problem).unwrap();
        let q: Vec<f64> =
            (0..6).map(|i| if free.contains(&i) { 0.3 * i as f64 - 0.7 } else { home[i] }).collect();
        let own: Vec<f64> = free.iter().map(|i| q[*i]).collect();
        let (found, expected) = (chain.pose(&own), Puma.pose(&q, &s).unwrap());
        let scale = |i: usize| if i < 9 { 1.0 } else { problem.arm };
        for (i, (found, expected)) in found.0.as_flattened().iter().zip(expected.0.as_flattened()).enumerate()
        {
            assert!((found * scale(i) - expected).abs() < 1e-13);
        }
    }
    let opaque = Opaque::new(&Puma, false);
    assert!(JointChain::new(&Problem::new(&opaque, &s, &home, &[0, 1]).unwrap()).is_none());
}

/// Checks that distant targets are rejected by their enclosures, with their distance.
#[test]
fn what_is_far_is_out_of_reach() {
    let Configuration { q: home, s, .. } = Configuration::home(Puma.description());
    let all = [0, 1, 2, 3, 4, 5];
    let single = Opaque::new(&Puma, false);
    for point in [[5.0, 0.0, 0.0], [0.0, -3.0, 2.0], [1.0, 1.0, 1.0]] {
        let residual = |manipulator: &dyn Manipulator| match inverse(
            manipulator,
            &s,
            &home,
            &all,
            &Target::Point(point),
        ) {
            Err(ReachError::OutOfReach { residual, .. }) => residual,
            found => panic!("{found:?}"),
        };
        let (found, expected) = (residual(&Puma), residual(&single));
        assert!((found - expected).abs() < 1e-3, "{point:?}: {found} and {expected}");
    }
}
