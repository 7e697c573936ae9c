//! Joint variables of platforms from their poses, in closed form.

use abbe::analysis::sampling::nominal_parameters;
use abbe::analysis::{InverseKinematics, sampling};
use abbe::{Manipulator, Pose};
use abbe_codegen::chain::LoopEquations;
use abbe_interpreter::Interpreter;
use abbe_spec::Spec;
use abbe_tests::platforms::{BODIES, platform};
use abbe_tests::{sample_size, specs};
use rand::{RngExt, SeedableRng};
use rand_xoshiro::Xoshiro256PlusPlus;

/// Returns a rotation about an axis.
fn turn(axis: usize, angle: f64) -> Pose {
    let (i, j, mut pose) = ((axis + 1) % 3, (axis + 2) % 3, Pose::IDENTITY);
    let (sine, cosine) = angle.sin_cos();
    (pose.0[i][i], pose.0[i][j], pose.0[j][i], pose.0[j][j]) = (cosine, sine, -sine, cosine);
    pose
}

/// Returns the solutions that the function marks as found.
fn solutions(robot: &Interpreter, start: &[f64], s: &[f64], target: &Pose) -> Vec<Vec<f64>> {
    let count = robot.description().solutions;
    let (mut solutions, mut found) = (vec![0.0; count * start.len()], vec![0.0; count]);
    robot.inverse(start, s, target, &mut solutions, &mut found).unwrap();
    let rows = solutions.chunks(start.len()).zip(&found);
    rows.filter(|(_, found)| **found == 1.0).map(|(row, _)| row.to_vec()).collect()
}

/// Checks a machine at random configurations around home, with other parameters in every second
/// one: the joint variables are among the solutions for their pose, and all solutions close the
/// loops there. Returns the number of poses.
fn check(spec: &Spec, random: &mut Xoshiro256PlusPlus, count: usize) -> usize {
    let robot = Interpreter::new(spec.clone());
    let (description, equations) = (robot.description(), LoopEquations::new(spec));
    let home = sampling::home(description);
    let mut poses = 0;
    for index in 0..count {
        let mut s = nominal_parameters(description);
        if index % 2 == 1 {
            s.iter_mut().for_each(|s| *s *= 1.0 + 1e-3 * random.random_range(-1.0..1.0));
        }
        let variables = home.iter().zip(description.variables.iter());
        let size = |kind| if kind == abbe::VariableKind::Revolute { 0.1 } else { 15.0 };
        let q: Vec<f64> = variables
            .map(|(home, variable)| home + size(variable.kind) * random.random_range(-1.0..1.0))
            .collect();
        let (Ok(target), mut passive) = (robot.pose(&q, &s), vec![0.0; spec.passive.len()]) else { continue };
        robot.passive(&q, &s, &mut passive).unwrap();
        let found = solutions(&robot, &home, &s, &target);
        let differs = |row: &Vec<f64>| row.iter().zip(&q).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        let nearest = found.iter().map(differs).fold(f64::INFINITY, f64::min);
        assert!(nearest < 1e-8, "{q:?} is not one of {found:?}");
        for row in &found {
            let open = equations.residual_at(row, &passive, &s);
            assert!(open.iter().all(|open| open.abs() < 2e-9), "{row:?} leaves {open:?}");
        }
        let nearest = InverseKinematics::new(&robot, &s).unwrap().solve(&q, &target).unwrap();
        assert!(differs(&nearest[0]) < 1e-8, "{q:?}: {nearest:?}");
        poses += 1;
    }
    poses
}

/// Random platforms with three to six legs of three kinds: see [`check`]. Poses that the passive
/// joints do not permit have no solution.
#[test]
fn platforms_have_all_their_solutions() {
    let [mut poses, mut machines] = [0; 2];
    for (body, seed) in
        BODIES.iter().flat_map(|body| (0..sample_size(60).max(6)).map(move |seed| (body, seed as u64)))
    {
        let (text, branches) = platform(body, seed);
        let spec =
            Spec::parse("platform.toml", &text).unwrap_or_else(|mistakes| panic!("{mistakes}\n{text}"));
        let robot = Interpreter::new(spec.clone());
        assert_eq!(robot.description().solutions, 1 << branches, "{text}");
        let mut random = Xoshiro256PlusPlus::seed_from_u64(seed);
        poses += check(&spec, &mut random, 10);
        machines += 1;
        let home = sampling::home(robot.description());
        let Ok(pose) = robot.pose(&home, &[]) else { continue };
        assert!(!solutions(&robot, &home, &[], &pose).is_empty());
        let foot = turn(0, 0.3).then(&turn(2, 0.2)).then(&turn(1, -0.4));
        // What counts as reached is as the chapter on controllers says.
        for (axis, [angle, way], is_found) in
            (0..3).flat_map(|axis| [(axis, [0.5e-6, 1e-4], true), (axis, [3e-6, 5e-3], false)])
        {
            let turned = foot.then(&turn(axis, angle)).then(&foot.inverse()).then(&pose);
            let turned = Pose([turned.0[0], turned.0[1], turned.0[2], pose.0[3]]);
            let mut shifted = pose;
            (0..3).for_each(|i| shifted.0[3][i] += way * foot.0[axis][i]);
            for (target, lacks) in [turned, shifted].iter().zip(body.lacks) {
                let found = !solutions(&robot, &home, &[], target).is_empty();
                assert!(found == (is_found || !lacks.contains(&axis)), "{axis} {angle} {lacks:?}\n{text}");
            }
        }
        let mut far = pose;
        far.0[3][0] += 3000.0;
        assert!(solutions(&robot, &home, &[], &far).is_empty());
    }
    println!("{poses} poses of {machines} platforms");
    assert!(10 * poses > 9 * 10 * machines, "{poses} of {machines}");
}

/// The rods of a pair have to agree: the delta reaches no pose that is tilted.
#[test]
fn shipped_platforms_have_all_their_solutions() {
    for (name, expected) in [("hexapod", 1), ("delta", 8), ("palletizer", 0), ("pps_hexapod", 0)] {
        let robot = super::mechanism(name);
        assert_eq!(robot.description().solutions, expected, "{name}");
        if expected > 0 {
            let path = format!("{}/../manipulators/mechanisms/{name}.toml", env!("CARGO_MANIFEST_DIR"));
            let spec = Spec::read(path).unwrap();
            let mut random = Xoshiro256PlusPlus::seed_from_u64(1);
            let count = sample_size(1000).max(40);
            // Other parameters of a delta move all rods of a pair alike.
            assert_eq!(check(&spec, &mut random, count), count, "{name}");
        }
    }
    let delta = super::mechanism("delta");
    let (home, s) = (sampling::home(delta.description()), nominal_parameters(delta.description()));
    let pose = delta.pose(&home, &s).unwrap();
    assert!(!solutions(&delta, &home, &s, &pose).is_empty());
    let tilted = pose.then(&turn(0, 1e-4));
    assert!(solutions(&delta, &home, &s, &tilted).is_empty());
}

/// Generated code has the solutions of the interpreter.
#[test]
fn generated_code_has_the_same_solutions() {
    let machine = Interpreter::new(Spec::read(specs::path("planar")).unwrap());
    assert_eq!(machine.description().solutions, 4);
    let parameters = super::planar::Parameters::NOMINAL;
    for q in super::samples(&machine, 20) {
        let target = machine.pose(&q, &parameters.to_array()).unwrap();
        let expected = solutions(&machine, &[0.0; 3], &parameters.to_array(), &target);
        let (found, exists) = super::planar::inverse(&[0.0; 3], &parameters, &target.0).unwrap();
        let found = found.iter().zip(exists).filter(|(_, exists)| *exists == 1.0);
        let found: Vec<Vec<f64>> = found.map(|(row, _)| row.to_vec()).collect();
        assert_eq!(found.len(), expected.len());
        found.iter().zip(expected).for_each(|(found, expected)| super::assert_close(found, &expected, 1e3));
    }
}
