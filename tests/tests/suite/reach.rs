//! Inverse kinematics of shipped manipulators and of random chains: reachable targets are reached.

use abbe::Manipulator;
use abbe::analysis::sampling::{arm_length, halton, home, joint_sample, nominal_parameters};
use abbe::analysis::{ReachError, Target, inverse};
use abbe_interpreter::Interpreter;
use abbe_manipulators::SHIPPED;
use abbe_spec::Spec;

/// Returns how many of the poses and points of sampled configurations, within the limits, are
/// reached from home.
fn reached(manipulator: &dyn Manipulator, samples: usize) -> [usize; 2] {
    let description = manipulator.description();
    let (s, start) = (nominal_parameters(description), home(description));
    let arm = arm_length(manipulator, &s).expect("an arm");
    let all: Vec<usize> = (0..start.len()).collect();
    let mut reached = [0; 2];
    // Not among the starts of the search.
    for index in 0..samples {
        let q = joint_sample(description, arm, &all, 1000 + 7 * index);
        let pose = manipulator.pose(&q, &s).expect("a pose");
        for (count, target) in reached.iter_mut().zip([Target::Point(pose.position()), Target::Pose(pose)]) {
            match inverse(manipulator, &s, &start, &all, &target) {
                Ok(found) => {
                    let there = manipulator.pose(&found, &s).expect("a pose").position();
                    let away = (0..3).map(|i| (there[i] - pose.position()[i]).abs()).fold(0.0, f64::max);
                    assert!(away < 1e-9 * arm, "{}: {away}", description.name);
                    *count += 1;
                }
                Err(ReachError::Evaluation(error)) => panic!("{}: {error}", description.name),
                Err(_) => {}
            }
        }
    }
    reached
}

#[test]
fn shipped_manipulators_reach_the_poses_of_their_samples() {
    for shipped in SHIPPED {
        assert!(
            shipped.compiled.description().frames.iter().all(|frame| frame.lower_pair),
            "{}",
            shipped.name
        );
        let [points, poses] = reached(shipped.compiled, 300);
        assert_eq!(points, 300, "{}", shipped.name);
        // Arms with narrow limits may need a start that is not among the 33: one in a hundred.
        assert!(poses >= 297, "{}: {poses}", shipped.name);
    }
}

/// Returns a spec of revolute and prismatic joints in general position.
pub(super) fn random_spec(seed: usize) -> String {
    let number = |i: usize, j: usize| 2.0 * halton(1 + 31 * seed + i, j) - 1.0;
    let mut text = "[manipulator]\nname = \"any\"\nlength = \"m\"\n".to_owned();
    for i in 0..5 + seed % 3 {
        let slides = halton(1 + seed + i, 7) < 0.25;
        let (kind, theta, d) = match slides {
            true => ("prismatic", format!("{}", 3.0 * number(i, 0)), format!("q{i} + {} m", number(i, 1))),
            false => ("revolute", format!("q{i} + {}", number(i, 0)), format!("{}", 0.5 * number(i, 1))),
        };
        let limits = if slides { "[\"-0.5 m\", \"0.4 m\"]" } else { "[-2.5, 2.8]" };
        text += &format!(
            "[[frame]]\nname = \"{i}\"\nvariable = {{ name = \"q{i}\", kind = \"{kind}\", limits = {limits} }}\n\
             dh = {{ theta = \"{theta}\", d = \"{d}\", a = {}, alpha = {} }}\n",
            0.5 * number(i, 2),
            3.0 * number(i, 3)
        );
    }
    text
}

/// Checks interpreted chains: the search on the extracted chain succeeds as for compiled ones.
#[test]
fn random_chains_reach_the_points_of_their_samples() {
    let mut reached_poses = 0;
    for seed in 0..20 {
        let spec = Spec::parse("any.toml", &random_spec(seed)).expect("a spec");
        let manipulator = Interpreter::new(spec);
        let [points, poses] = reached(&manipulator, 20);
        assert_eq!(points, 20, "{seed}");
        reached_poses += poses;
    }
    assert!(reached_poses >= 390, "{reached_poses} of 400");
}

/// Checks that the tool point is reached with one axis of the tool in a direction, in each
/// convention of angles.
#[test]
fn random_chains_reach_directions_of_their_tools() {
    let mut reached = 0;
    for seed in 0..24 {
        let convention = ["rotation-vector", "euler-yzx", "iec-61217"][seed % 3];
        let head = format!("length = \"m\"\norientation = \"{convention}\"\n");
        let text = random_spec(seed).replacen("length = \"m\"\n", &head, 1);
        let manipulator = Interpreter::new(Spec::parse("any.toml", &text).expect("a spec"));
        let description = manipulator.description();
        let (s, start) = (nominal_parameters(description), home(description));
        let arm = arm_length(&manipulator, &s).expect("an arm");
        let all: Vec<usize> = (0..start.len()).collect();
        for index in 0..10 {
            let q = joint_sample(description, arm, &all, 1000 + 7 * index);
            let pose = manipulator.pose(&q, &s).expect("a pose");
            let (axis, point) = (index % 3, pose.position());
            let target = Target::Axis { point, axis, direction: pose.0[axis] };
            let Ok(found) = inverse(&manipulator, &s, &start, &all, &target) else { continue };
            let there = manipulator.pose(&found, &s).expect("a pose");
            let difference =
                |a: [f64; 3], b: [f64; 3]| (0..3).map(|i| (a[i] - b[i]).abs()).fold(0.0, f64::max);
            assert!(difference(there.position(), point) < 1e-9 * arm, "{seed} {index}");
            assert!(difference(there.0[axis], pose.0[axis]) < 1e-9, "{seed} {index}");
            reached += 1;
        }
    }
    assert!(reached >= 235, "{reached} of 240");
}
