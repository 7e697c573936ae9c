//! Inverse kinematics with all solutions: they reach the pose, and none is missing.

use std::f64::consts::TAU;
use std::fmt::Write;

use abbe::analysis::sampling::{halton, nominal_parameters};
use abbe::analysis::{InverseKinematics, Target, inverse};
use abbe::lanes::{Evaluate, InstructionSet, Inverse, Tiles};
use abbe::{Error, Function, Manipulator, Orientation, Pose, Quantity, VariableKind, deviation, laws};
use abbe_interpreter::Interpreter;
use abbe_manipulators::{SHIPPED, pps, puma560, stanford, ur5};
use abbe_spec::Spec;
use abbe_tests::sample_size;
use rand::{RngExt, SeedableRng};
use rand_xoshiro::Xoshiro256PlusPlus;

fn shipped(name: &str) -> &'static dyn Manipulator {
    SHIPPED.iter().find(|shipped| shipped.name == name).unwrap().compiled
}

/// Returns a configuration within the limits, or within half a turn without them.
fn sample(robot: &dyn Manipulator, index: usize) -> Vec<f64> {
    let variables = robot.description().variables.iter().enumerate();
    let value = |(i, variable): (usize, &abbe::Variable)| {
        let [lower, upper] = variable.limits.map(|limit| limit.clamp(-3.1, f64::INFINITY));
        let upper = if upper.is_finite() { upper } else { 3.1 };
        lower + (upper - lower) * halton(index + 1, i)
    };
    variables.map(value).collect()
}

/// Returns the largest difference of two configurations, up to full turns.
fn distance(robot: &dyn Manipulator, a: &[f64], b: &[f64]) -> f64 {
    let variables = robot.description().variables.iter();
    let one = |((a, b), variable): ((&f64, &f64), &abbe::Variable)| match variable.kind {
        VariableKind::Revolute => (a - b - TAU * ((a - b) / TAU).round()).abs(),
        VariableKind::Prismatic => (a - b).abs(),
    };
    a.iter().zip(b).zip(variables).map(one).fold(0.0, f64::max)
}

/// Checks the solutions for the pose of a configuration, and returns their number: they are within
/// the limits and reach the pose, and the configuration is one of them.
fn check(robot: &dyn Manipulator, kinematics: &InverseKinematics<'_>, q: &[f64], tolerance: f64) -> usize {
    let description = robot.description();
    let s = nominal_parameters(description);
    let target = robot.pose(q, &s).unwrap();
    let found = kinematics.solve(q, &target).unwrap_or_else(|error| panic!("{q:?}: {error}"));
    for one in &found {
        let difference = deviation(Orientation::RotationVector, &robot.pose(one, &s).unwrap(), &target);
        let scale = 1.0 + target.position().iter().fold(0.0, |a: f64, b| a.max(b.abs()));
        assert!(difference.iter().all(|x| x.abs() < 1e-9 * scale), "{q:?}: {one:?} misses by {difference:?}");
        for (value, variable) in one.iter().zip(description.variables.iter()) {
            assert!((variable.limits[0]..=variable.limits[1]).contains(value), "{q:?}: {one:?}");
        }
    }
    let nearest = found.iter().map(|one| distance(robot, one, q)).fold(f64::INFINITY, f64::min);
    assert!(nearest < tolerance, "{q:?} is not one of {found:?}");
    for (i, one) in found.iter().enumerate() {
        assert!(found[..i].iter().all(|other| distance(robot, one, other) > 1e-7), "{one:?} twice");
    }
    found.len()
}

#[test]
fn shipped_robots_have_all_their_solutions() {
    for (name, most, average) in [("puma560", 8, 2.0), ("ur5", 8, 4.0), ("stanford", 8, 2.0), ("pps", 2, 1.0)]
    {
        let robot = shipped(name);
        let kinematics = InverseKinematics::new(robot, &nominal_parameters(robot.description())).unwrap();
        assert!(kinematics.is_closed_form(), "{name}");
        let count = sample_size(20_000).max(500);
        let counts: Vec<usize> =
            (0..count).map(|index| check(robot, &kinematics, &sample(robot, index), 1e-6)).collect();
        let mean = counts.iter().sum::<usize>() as f64 / count as f64;
        println!("{name}: {mean} solutions on average, {:?} at most", counts.iter().max());
        assert!(counts.iter().all(|count| *count <= most) && mean >= average, "{name}: {mean}");
    }
}

/// Solutions that searches find from many starts are among those of the closed form.
#[test]
fn searches_find_no_others() {
    for name in ["puma560", "ur5", "stanford"] {
        let robot = shipped(name);
        let description = robot.description();
        let s = nominal_parameters(description);
        let kinematics = InverseKinematics::new(robot, &s).unwrap();
        let all: Vec<usize> = (0..6).collect();
        for index in 0..sample_size(500).max(20) {
            let target = robot.pose(&sample(robot, index), &s).unwrap();
            let found = kinematics.solve(&[0.0; 6], &target).unwrap();
            for start in 0..10 {
                let start = sample(robot, 1000 + 10 * index + start);
                let other = inverse(robot, &s, &start, &all, &Target::Pose(target)).unwrap();
                let nearest = found.iter().map(|one| distance(robot, one, &other)).fold(9.0, f64::min);
                assert!(nearest < 1e-6, "{name} {index}: {other:?} is not one of {found:?}");
            }
        }
    }
}

/// Generated functions give the same solutions one by one, in lanes and interpreted; each reaches
/// the pose without any improvement, and the configuration of the pose is one of them.
#[test]
fn generated_solutions_reach_their_poses() {
    generated(&puma560::Puma560);
    generated(&ur5::Ur5);
    generated(&stanford::Stanford);
    generated(&pps::Pps);
}

fn generated(robot: &impl Evaluate<Inverse>) {
    let description = robot.description();
    let name = &*description.name;
    let spec = SHIPPED.iter().find(|shipped| shipped.name == name).unwrap().spec;
    let interpreter = Interpreter::new(Spec::parse(name, spec).unwrap());
    let s = nominal_parameters(description);
    let count = sample_size(100_000).max(300);
    let signature = Function::Inverse.signature();
    let set = InstructionSet::best();
    let mut arguments = Tiles::new(set, signature.arguments_len(description), count);
    let mut results = Tiles::new(set, signature.results_len(description), count);
    // Every fourth wrist is nearly straight, with joints that hardly matter by themselves.
    let is_straight = |index: usize| index.is_multiple_of(4) && name != "pps";
    let given = |index: usize| {
        let mut q = sample(robot, index);
        if is_straight(index) {
            q[4] = 0.1_f64.powi((index / 4 % 16) as i32);
        }
        (sample(robot, 2 * index + 1), robot.pose(&q, &s).unwrap(), q)
    };
    for index in 0..count {
        let (start, target, _) = given(index);
        let numbers = start.iter().chain(&s).chain(target.0.as_flattened());
        numbers.enumerate().for_each(|(row, value)| arguments.set_value(row, index, *value));
    }
    arguments.pad();
    abbe::lanes::run(robot, Inverse, &arguments, &mut results).unwrap();
    let rows = description.solutions;
    let solve = |robot: &dyn Manipulator, start: &[f64], target: &Pose| {
        let (mut solutions, mut found) = (vec![0.0; 6 * rows], vec![0.0; rows]);
        robot.inverse(start, &s, target, &mut solutions, &mut found).unwrap();
        [solutions, found].concat()
    };
    let mut worst = [0.0_f64; 2];
    for index in 0..count {
        let (start, target, q) = given(index);
        let one = solve(robot, &start, &target);
        let in_lanes: Vec<f64> = (0..7 * rows).map(|row| results.get(row, index)).collect();
        let size = target.position().iter().fold(1.0, |a: f64, b| a.max(b.abs()));
        for other in [in_lanes, solve(&interpreter, &start, &target)] {
            if is_straight(index) {
                continue;
            }
            assert_eq!(one[6 * rows..], other[6 * rows..], "{name} {index}");
            let difference = one.iter().zip(&other).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
            worst[1] = worst[1].max(difference / size);
        }
        let mut nearest = f64::INFINITY;
        for (row, found) in one[..6 * rows].chunks(6).zip(&one[6 * rows..]) {
            assert!([0.0, 1.0].contains(found));
            if *found == 0.0 {
                continue;
            }
            let reached = robot.pose(row, &s).unwrap();
            let difference = deviation(Orientation::RotationVector, &reached, &target);
            let scale = |i: usize| if i < 3 { size } else { 1.0 };
            worst[0] = (0..6).map(|i| difference[i].abs() / scale(i)).fold(worst[0], f64::max);
            for ((value, start), variable) in row.iter().zip(&start).zip(description.variables.iter()) {
                let [lower, upper] = variable.limits;
                assert!((lower..=upper).contains(value), "{name} {index}: {row:?}");
                let turn = TAU * (start - value).signum();
                let is_nearest = (value - start).abs() <= TAU / 2.0 + 1e-9;
                let is_revolute = variable.kind == VariableKind::Revolute;
                assert!(!is_revolute || is_nearest || !(lower..=upper).contains(&(value + turn)));
            }
            nearest = nearest.min(distance(robot, row, &q));
        }
        assert!(nearest < 1e-6 || is_straight(index), "{name} {index}: {q:?} is not one of {one:?}");
        let is_almost_straight = is_straight(index) && (9e-15..2e-9).contains(&q[4]);
        assert!(nearest.is_finite() || is_almost_straight, "{name} {index}: nothing found for {q:?}");
    }
    println!(
        "{name}: {count} poses missed by {:e} at most, {:e} between lanes and others",
        worst[0], worst[1]
    );
    assert!(worst[0] < 2e-12 && worst[1] < 1e-6, "{name}: {worst:?}");
}

/// Robot with wrong results of `inverse`.
struct Wrong(&'static dyn Manipulator, Change);

/// Change of solutions, and of whether they exist.
type Change = fn(&mut [f64], &mut [f64]);

impl Manipulator for Wrong {
    fn description(&self) -> &abbe::Description {
        self.0.description()
    }

    fn evaluate(
        &self,
        function: Function,
        arguments: &[&[f64]],
        results: &mut [&mut [f64]],
    ) -> Result<(), Error> {
        self.0.evaluate(function, arguments, results)?;
        if let (Function::Inverse, [solutions, found]) = (function, results) {
            self.1(solutions, found);
        }
        Ok(())
    }
}

/// `test_manipulator!` finds solutions that miss by 1e-7 of a joint, in a single joint, and missing
/// ones.
#[test]
fn the_law_of_inverses_holds_and_finds_wrong_solutions() {
    for name in ["puma560", "ur5", "stanford", "pps"] {
        let robot = shipped(name);
        let found = laws::inverse(robot, laws::SAMPLES).unwrap();
        println!("{name}: {:e}", found.relative);
        found.within("inverse", laws::ROUNDING_TOLERANCE).unwrap();
        let wrong: [Change; 4] = [
            |solutions, _| solutions.iter_mut().step_by(6).for_each(|q| *q += 1e-7),
            |solutions, _| solutions.iter_mut().skip(5).step_by(6).for_each(|q| *q -= 1e-7),
            |solutions, _| solutions.chunks_exact_mut(6).for_each(|q| q.swap(3, 4)),
            |_, found| found.fill(0.0),
        ];
        for change in wrong {
            let law = laws::inverse(&Wrong(robot, change), 20)
                .and_then(|found| found.within("inverse", laws::ROUNDING_TOLERANCE));
            assert!(law.is_err(), "{name}");
        }
    }
    for name in ["iiwa", "scara"] {
        assert_eq!(laws::inverse(shipped(name), 20).unwrap().compared, 0);
    }
}

/// Without a closed form, the solutions are those of searches.
#[test]
fn other_arms_are_searched() {
    for (name, least) in [("general6r", 2), ("scara", 1), ("iiwa", 1)] {
        let robot = shipped(name);
        let kinematics = InverseKinematics::new(robot, &nominal_parameters(robot.description())).unwrap();
        assert!(!kinematics.is_closed_form(), "{name}");
        let found = (0..5).map(|index| check(robot, &kinematics, &sample(robot, index), 1e-5)).max();
        assert!(found.unwrap() >= least, "{name}: {found:?}");
    }
}

/// No closed form is claimed for arms that cannot bring the wrist to all places around it.
#[test]
fn arms_without_room_have_no_closed_form() {
    let frame = |i: usize, transform: &str| {
        format!(
            "[[frame]]\nname = \"f{i}\"\nvariable = {{ name = \"q{i}\", kind = \"revolute\", limits = [-3, 3] }}\n\
             transform = \"Rz(q{i}) {transform}\"\n"
        )
    };
    let tilt = "Rx(1.2) Rz(0.4)";
    for transforms in [
        // The first three axes intersect, too.
        [tilt, tilt, "Tx(0.4) Tz(0.3)", tilt, tilt, "Tz(0.1)"],
        // The first two axes are one.
        ["Tz(0.3)", "Tx(0.4) Rx(1)", "Tx(0.4) Tz(0.3)", tilt, tilt, "Tz(0.1)"],
        // The third axis goes through the wrist.
        ["Tx(0.3)", "Tx(0.4) Rx(1)", "Tz(0.3)", tilt, tilt, "Tz(0.1)"],
    ] {
        let frames = transforms.iter().enumerate().map(|(i, transform)| frame(i, transform));
        let text = format!("[manipulator]\nname = \"arm\"\nlength = \"m\"\n{}", frames.collect::<String>());
        let robot =
            Interpreter::new(Spec::parse("arm.toml", &text).unwrap_or_else(|mistakes| panic!("{mistakes}")));
        assert_eq!(robot.description().solutions, 0, "{transforms:?}");
        let pose = robot.pose(&[0.1, 0.2, 0.3, 0.4, 0.5, 0.6], &[]).unwrap();
        assert!(robot.inverse(&[0.0; 6], &[], &pose, &mut [], &mut []).is_ok());
        assert!(robot.inverse(&[0.0; 6], &[], &pose, &mut [0.0; 48], &mut [0.0; 8]).is_err());
    }
}

/// At singular poses the solutions reach the pose.
#[test]
fn singular_poses_are_reached() {
    use std::f64::consts::FRAC_PI_2;
    for (name, q) in [
        // Straight wrist, stretched arm, wrist above the first axis.
        ("puma560", [0.3, 0.9, -0.4, 0.2, 0.0, 0.1]),
        ("puma560", [0.3, FRAC_PI_2, -FRAC_PI_2, 0.2, 0.0, 0.1]),
        ("ur5", [0.3, -0.9, 0.0, 0.2, 0.7, 0.1]),
        ("ur5", [0.3, -0.9, 0.8, 0.2, 0.0, 0.1]),
        ("ur5", [0.0; 6]),
        ("pps", [100.0, 50.0, 20.0, 0.0, 0.0, 0.0]),
    ] {
        let robot = shipped(name);
        let s = nominal_parameters(robot.description());
        let kinematics = InverseKinematics::new(robot, &s).unwrap();
        check(robot, &kinematics, &q, f64::INFINITY);
    }
}

/// A joint that is free to move stays where it is.
#[test]
fn free_joints_stay() {
    for (name, q, free) in [
        ("puma560", [0.3, 0.9, -0.4, 0.7, 0.0, 0.1], 3),
        ("stanford", [0.3, 0.9, 0.6, 0.7, 0.0, 0.1], 3),
        ("ur5", [0.3, -0.9, 0.8, 0.2, 0.0, 0.1], 5),
    ] {
        let robot = shipped(name);
        let s = nominal_parameters(robot.description());
        let kinematics = InverseKinematics::new(robot, &s).unwrap();
        let found = kinematics.solve(&q, &robot.pose(&q, &s).unwrap()).unwrap();
        assert!(distance(robot, &found[0], &q) < 1e-5, "{name}: {:?} for {q:?}", found[0]);
        assert!((found[0][free] - q[free]).abs() < 1e-5);
    }
}

/// Numbers beyond all sizes end in an error or a pose that is reached.
#[test]
fn huge_numbers_end() {
    let skew = Interpreter::new(Spec::parse("robot.toml", &random_robot(Structure::Wrist, 1)).unwrap());
    for robot in [shipped("puma560"), shipped("ur5"), shipped("stanford"), shipped("pps"), &skew] {
        let s = nominal_parameters(robot.description());
        let kinematics = InverseKinematics::new(robot, &s).unwrap();
        let home = abbe::analysis::sampling::home(robot.description());
        let pose = robot.pose(&home, &s).unwrap();
        for size in [1e9, 1e80, 1e160, 1e300] {
            let mut target = pose;
            target.0[3] = [size, -size, size];
            assert!(kinematics.solve(&home, &target).is_err(), "{size}");
            let start = vec![size; 6];
            for q in kinematics.solve(&start, &pose).unwrap() {
                let difference = deviation(Orientation::RotationVector, &robot.pose(&q, &s).unwrap(), &pose);
                assert!(difference.iter().all(|x| x.abs() < 1e-6), "{q:?}: {difference:?}");
            }
        }
        for wrong in [f64::NAN, f64::INFINITY] {
            let mut start = home.clone();
            start[2] = wrong;
            let expected = Error::NotFinite { quantity: Quantity::Variables, index: 2 };
            assert_eq!(kinematics.solve(&start, &pose), Err(expected.into()));
            let mut target = pose;
            target.0[3][1] = wrong;
            assert!(kinematics.solve(&home, &target).is_err());
        }
    }
}

#[test]
fn unreachable_poses_are_refused_with_the_reason_of_the_search() {
    let robot = shipped("ur5");
    let s = nominal_parameters(robot.description());
    let kinematics = InverseKinematics::new(robot, &s).unwrap();
    let mut target = Pose::IDENTITY;
    target.0[3] = [3000.0, 0.0, 0.0];
    let all: Vec<usize> = (0..6).collect();
    let expected = inverse(robot, &s, &[0.0; 6], &all, &Target::Pose(target));
    assert_eq!(kinematics.solve(&[0.0; 6], &target), expected.map(|q| vec![q]));
}

/// Structure of a random robot.
#[derive(Clone, Copy, Debug)]
enum Structure {
    Wrist,
    /// The third joint turns back with the second, as behind the parallelogram of a large arm, and
    /// the last two with those of the wrist before them.
    Coupled,
    WristAtBase,
    Slide,
    Parallel,
    ParallelBackwards,
    Gantry,
}

/// Writes a random robot of a structure. All offsets and angles are random where the structure
/// leaves them free; some of those of arms are zero or right angles, as of real robots.
fn random_robot(structure: Structure, seed: u64) -> String {
    let mut random = Xoshiro256PlusPlus::seed_from_u64(seed);
    let mut text = "[manipulator]\nname = \"robot\"\nlength = \"m\"\n".to_owned();
    let mut number = || random.random_range(-1.0..1.0_f64);
    let is_regular = seed.is_multiple_of(3);
    for i in 0..6 {
        let [x, y, z, a, b] = core::array::from_fn(|_| number());
        let quarters = match ((a * 2.0).round(), structure) {
            // Three parallel axes would not bring the wrist to all places around it.
            (even, Structure::Wrist | Structure::Coupled | Structure::WristAtBase) if even % 2.0 == 0.0 => {
                1.0
            }
            (quarters, _) => quarters,
        };
        let angle = if is_regular { quarters * TAU / 4.0 } else { 3.0 * a };
        let apart = format!(
            "Tx({x:.3}) Ty({y:.3}) Tz({z:.3}) Rx({angle:?}) Ry({:?})",
            if is_regular { 0.0 } else { b }
        );
        let tilted = format!("Rx({:?}) Rz({b:?})", 0.5 + a.abs());
        let shifted = format!("Tx({:.3}) Ty({y:.3}) Tz({z:.3})", x + x.signum() * 0.2);
        let behind = match (structure, i) {
            (Structure::Wrist | Structure::Coupled | Structure::Slide, 3 | 4)
            | (Structure::WristAtBase, 0 | 1) => tilted,
            (Structure::Slide, 0) if seed.is_multiple_of(2) => tilted,
            // Of the axes of the arm two are parallel, or two intersect.
            (Structure::Wrist | Structure::Coupled, 0) if seed.is_multiple_of(2) => tilted,
            (Structure::Wrist | Structure::Coupled, 1) if !seed.is_multiple_of(2) => shifted,
            (Structure::WristAtBase, 4) if seed.is_multiple_of(2) => tilted,
            (Structure::WristAtBase, 3) if !seed.is_multiple_of(2) => shifted,
            (Structure::Parallel, 1 | 2) | (Structure::Slide, 0) => shifted,
            (Structure::Parallel, 0 | 3) => format!("{shifted} {tilted}"),
            (Structure::Parallel, 4) => tilted,
            (Structure::ParallelBackwards, 2 | 3) => shifted,
            (Structure::ParallelBackwards, 1 | 4) => format!("{shifted} {tilted}"),
            (Structure::ParallelBackwards, 0) => tilted,
            (Structure::Gantry, _) => format!("{shifted} {tilted}"),
            _ => apart,
        };
        let is_slide = match structure {
            Structure::Gantry => i % 2 == (seed % 2) as usize,
            Structure::Slide => i == 2,
            _ => false,
        };
        let amount = match (structure, i) {
            (Structure::Coupled, 2) => "q2 - q1".to_owned(),
            (Structure::Coupled, 4) => "q4 + q3".to_owned(),
            (Structure::Coupled, 5) => "-q5 + q4 - q3".to_owned(),
            (Structure::Gantry, 2 | 3) => format!("q{i} + q{}", i - 2),
            // Every fifth robot of other structures has coupled joints as well.
            (Structure::WristAtBase | Structure::Parallel | Structure::ParallelBackwards, 2 | 4)
                if seed % 5 == 4 =>
            {
                format!("q{i} - q{}", i - 1)
            }
            _ => format!("q{i}"),
        };
        let (kind, motion) = if is_slide { ("prismatic", "Tz") } else { ("revolute", "Rz") };
        let _ = write!(
            text,
            "[[frame]]\nname = \"f{i}\"\nvariable = {{ name = \"q{i}\", kind = \"{kind}\", limits = [-3.2, 3.2] }}\n\
             transform = \"{motion}({amount}) {behind}\"\n"
        );
    }
    text
}

#[test]
fn random_robots_have_all_their_solutions() {
    let structures = [
        Structure::Wrist,
        Structure::Coupled,
        Structure::WristAtBase,
        Structure::Slide,
        Structure::Parallel,
        Structure::ParallelBackwards,
        Structure::Gantry,
    ];
    for structure in structures {
        let (mut most, mut closed) = (0, 0);
        let robots = sample_size(40).max(6);
        for seed in 0..robots as u64 {
            let text = random_robot(structure, seed);
            let spec = Spec::parse("robot.toml", &text).unwrap_or_else(|mistakes| panic!("{mistakes}"));
            let robot = Interpreter::new(spec);
            let kinematics = InverseKinematics::new(&robot, &[]).unwrap();
            closed += usize::from(kinematics.is_closed_form());
            if !kinematics.is_closed_form() {
                println!("{structure:?} {seed}");
                continue;
            }
            for index in 0..50 {
                most = most.max(check(&robot, &kinematics, &sample(&robot, index), 1e-5));
            }
        }
        println!("{structure:?}: {closed} of {robots}, {most} solutions at most");
        assert!(closed * 10 >= robots * 9, "{structure:?}: {closed} of {robots}");
    }
}

/// Axes that are almost parallel are parallel, or the arm has no closed form: none is claimed that
/// finds nothing.
#[test]
fn almost_parallel_axes_have_their_joints() {
    let mut closed = 0;
    for structure in [Structure::Parallel, Structure::ParallelBackwards, Structure::Wrist] {
        for (seed, tilt) in
            (0..6).flat_map(|seed| (0..20).map(move |k| (seed, 10_f64.powf(-13.0 + 0.5 * f64::from(k)))))
        {
            let text = random_robot(structure, seed);
            let tilted = text.lines().map(|line| match line.strip_prefix("transform = \"Rz(q") {
                Some(rest) if rest.starts_with(['1', '2', '3']) => {
                    format!("{} Rx({tilt:?})\"\n", line.trim_end_matches('"'))
                }
                _ => format!("{line}\n"),
            });
            let robot = Interpreter::new(Spec::parse("robot.toml", &tilted.collect::<String>()).unwrap());
            let rows = robot.description().solutions;
            closed += usize::from(rows > 0);
            for index in (0..10).filter(|_| rows > 0) {
                let q = sample(&robot, index);
                let target = robot.pose(&q, &[]).unwrap();
                let (mut joints, mut found) = (vec![0.0; 6 * rows], vec![0.0; rows]);
                robot.inverse(&q, &[], &target, &mut joints, &mut found).unwrap();
                let misses =
                    joints.chunks_exact(6).zip(&found).filter(|(_, found)| **found > 0.0).map(|(row, _)| {
                        let there = robot.pose(row, &[]).unwrap();
                        let left = deviation(Orientation::RotationVector, &there, &target);
                        left.iter().fold(0.0, |most: f64, one| most.max(one.abs()))
                    });
                let least = misses.fold(f64::INFINITY, f64::min);
                assert!(least < 1e-9 + 30.0 * tilt.min(1e-8), "{structure:?} {seed} {tilt:e}: {least:e}");
            }
        }
    }
    println!("{closed} of 360 in closed form");
    assert!(closed > 100);
}
