//! Laws of corrections cycle after cycle: along smooth paths through singular poses, at random
//! commands within and beyond the limits, and where not the whole pose is to be reached.
//!
//! What is left is compared with the exact chain, multiplied frame by frame.

use abbe::compensator::{Begun, Compensated, Cycle, REACHED, Status, begin, compensate, norms};
use abbe::{
    Description, Function, Manipulator, Orientation, Pose, VariableKind, deviation, drawn_pose,
    repeatable_magnitudes,
};
use abbe_interpreter::Interpreter;
use abbe_manipulators::SHIPPED;
use abbe_spec::Spec;
use abbe_tests::{sample_size, thorough};
use rand::{RngExt, SeedableRng};
use rand_xoshiro::Xoshiro256PlusPlus;

use super::with_errors_in;

/// Trunnion machine: the tool's turn about its own axis is out of reach.
const FIVE_AXIS: &str = r#"
[manipulator]
name = "five_axis"
length = "mm"
[[frame]]
name = "C"
variable = { name = "c", kind = "revolute", limits = ["-180 deg", "180 deg"] }
transform = "Rz(c)"
[[frame]]
name = "A"
variable = { name = "a", kind = "revolute", limits = ["-110 deg", "30 deg"] }
transform = "Tz(-50) Rx(a)"
[[frame]]
name = "X"
variable = { name = "x", kind = "prismatic", limits = [0, 500], home = 250 }
transform = "Tx(-250) Ty(-200) Tz(250) Tx(x)"
[[frame]]
name = "Y"
variable = { name = "y", kind = "prismatic", limits = [0, 400], home = 200 }
transform = "Ty(y)"
[[frame]]
name = "Z"
variable = { name = "z", kind = "prismatic", limits = [0, 400], home = 200 }
transform = "Tz(z)"
[tool]
transform = "Tz(-120)"
"#;

/// A robot with errors, the rotations that its joints reach, and the joints whose zero is a
/// singular pose.
pub(crate) struct Case {
    pub(crate) robot: Interpreter,
    pub(crate) rotations: [f64; 3],
    singular: &'static [usize],
}

pub(crate) fn cases() -> Vec<Case> {
    let case = |name: &str, rotations, singular| {
        let shipped = SHIPPED.iter().find(|shipped| shipped.name == name);
        let text = shipped.map_or(FIVE_AXIS, |shipped| shipped.spec);
        Case { robot: Interpreter::new(with_errors_in(text)), rotations, singular }
    };
    vec![
        case("ur5", [1.0; 3], &[4, 2]),
        case("pps", [1.0; 3], &[]),
        case("five_axis", [1.0, 1.0, 0.0], &[1]),
        case("puma560", [1.0; 3], &[4]),
        case("iiwa", [1.0; 3], &[3, 5, 1]),
        case("scara", [0.0, 0.0, 1.0], &[1]),
        case("general6r", [1.0; 3], &[4, 2]),
    ]
}

/// Two more robots with errors, whose wrists have singular poses.
fn arms_with_wrists() -> impl Iterator<Item = Case> {
    let case = |(name, singular): (&str, _)| {
        let shipped = SHIPPED.iter().find(|shipped| shipped.name == name).unwrap();
        Case { robot: Interpreter::new(with_errors_in(shipped.spec)), rotations: [1.0; 3], singular }
    };
    [("stanford", &[4][..]), ("panda", &[1][..])].into_iter().map(case)
}

/// A robot with what the laws need of it.
pub(crate) struct Machine<'a> {
    robot: &'a Interpreter,
    description: &'a Description,
    pub(crate) s: Vec<f64>,
    pub(crate) u: Vec<f64>,
    magnitudes: Vec<f64>,
}

impl<'a> Machine<'a> {
    pub(crate) fn new(robot: &'a Interpreter) -> Self {
        use abbe::analysis::sampling::{nominal_inputs, nominal_parameters};
        let description = robot.description();
        let (s, u) = (nominal_parameters(description), nominal_inputs(description));
        Self { robot, description, s, u, magnitudes: repeatable_magnitudes(description) }
    }

    /// Runs the generated compensator's steps.
    pub(crate) fn corrected(
        &self,
        q: &[f64],
        cycle: &Cycle<Vec<f64>>,
    ) -> Result<Compensated<Vec<f64>>, abbe::Error> {
        let pose =
            |numbers: &[f64]| Pose(std::array::from_fn(|i| std::array::from_fn(|j| numbers[3 * i + j])));
        let target = self.robot.pose(q, &self.s)?;
        let columns = vec![[0.0; 6]; q.len()];
        compensate(self.description, &target, &q.to_vec(), cycle, columns, |q, columns| {
            let step = self
                .robot
                .evaluate_unchecked(Function::CompensatorStep, &[&q[..], &self.s, &self.u].concat())?;
            columns.as_flattened_mut().copy_from_slice(&step[12..]);
            Ok(pose(&step))
        })
    }

    /// Returns the command that the drives carry out where they stand.
    fn begun(&self, drives: &[f64], rotations: [f64; 3]) -> Begun<Vec<f64>> {
        let target = self.robot.real_pose(drives, &self.s, &self.u).unwrap();
        let columns = vec![[0.0; 6]; drives.len()];
        begin(self.description, &target, &drives.to_vec(), rotations, columns, |q, columns| {
            let given = [&q[..], &self.s, &self.u].concat();
            let step = self.robot.evaluate_unchecked(Function::CompensatorStep, &given)?;
            columns.as_flattened_mut().copy_from_slice(&step[12..]);
            self.robot.pose(q, &self.s)
        })
        .unwrap()
    }

    /// Returns what is left at `corrected` by the exact chain, frame by frame.
    fn left(&self, q: &[f64], corrected: &[f64]) -> [f64; 6] {
        let real = drawn_pose(self.robot, corrected, &self.s, &self.u, &self.magnitudes).unwrap();
        deviation(Orientation::RotationVector, &self.robot.pose(q, &self.s).unwrap(), &real)
    }

    /// Returns the distance in metres and the angle of the rotations to be reached of what is left.
    fn remaining(&self, q: &[f64], left: &[f64; 6], rotations: [f64; 3]) -> [f64; 2] {
        let pose = self.robot.pose(q, &self.s).unwrap();
        let turns: [f64; 3] =
            std::array::from_fn(|k| rotations[k] * (0..3).map(|i| pose.0[k][i] * left[3 + i]).sum::<f64>());
        let angle = turns.iter().map(|turn| turn * turn).sum::<f64>().sqrt();
        [norms(left).0 * self.description.length.in_metres(), angle]
    }

    /// Returns the first cycle of a controller.
    pub(crate) fn first(&self, rotations: [f64; 3]) -> Cycle<Vec<f64>> {
        let each = |[angle, length]: [f64; 2]| {
            let metre = 1.0 / self.description.length.in_metres();
            let kinds = self.description.variables.iter().map(|variable| variable.kind);
            kinds.map(|kind| if kind == VariableKind::Revolute { angle } else { length * metre }).collect()
        };
        let (change, largest) = (each(abbe::compensator::CHANGE), each(abbe::compensator::LARGEST));
        Cycle { last: vec![0.0; self.description.variables.len()], change, largest, rotations }
    }

    fn limits(&self, j: usize) -> [f64; 2] {
        self.description.variables[j].limits
    }

    /// Checks what holds in every cycle: commands within the limits and bounds, and what is left to
    /// a nanometre and a nanorad. `OK` leaves no more than it says.
    fn check(&self, q: &[f64], cycle: &Cycle<Vec<f64>>, done: &Compensated<Vec<f64>>) -> [f64; 2] {
        let left = self.left(q, &done.q);
        let metre = 1.0 / self.description.length.in_metres();
        for (k, (found, exact)) in done.after.iter().zip(&left).enumerate() {
            let nano = if k < 3 { 1e-9 * metre } else { 1e-9 };
            // A command of 1e300 has an error of its own rounding.
            let rounding = 1e-12 * exact.abs();
            assert!((found - exact).abs() <= nano + rounding, "at {q:?}: {found}, not {exact}");
        }
        for (j, value) in done.q.iter().enumerate() {
            let [lower, upper] = self.limits(j);
            assert!((lower..=upper).contains(value), "joint {j} at {value}");
            let command = q[j].clamp(lower, upper);
            assert!((done.correction[j] - (value - command)).abs() <= 1e-12 * (1.0 + value.abs()));
            let change = (done.correction[j] - cycle.last[j]).abs();
            let may_change = cycle.change[j].max(0.0);
            let rounding = 1e-12 * (1.0 + command.abs());
            let is_at_limit = *value == lower || *value == upper;
            assert!(change <= may_change + rounding || is_at_limit, "joint {j} changes by {change}");
        }
        let remaining = self.remaining(q, &left, cycle.rotations);
        let is_outside = (0..q.len()).any(|j| !(self.limits(j)[0]..=self.limits(j)[1]).contains(&q[j]));
        assert_eq!(done.status == Status::OutsideLimits, is_outside, "{:?} at {q:?}", done.status);
        if done.status == Status::Reached {
            assert!(remaining[0] <= REACHED[0] + 1e-9 && remaining[1] <= REACHED[1] + 1e-9, "{remaining:?}");
        }
        remaining
    }
}

/// Smooth path of 1 kHz through a singular pose: one joint passes through its zero at constant
/// speed, the others swing over a part of their range.
pub(crate) struct Path {
    middle: Vec<f64>,
    swing: Vec<f64>,
    speed: Vec<f64>,
    phase: Vec<f64>,
    through: Option<usize>,
}

impl Path {
    pub(crate) fn new(
        case: &Case,
        machine: &Machine<'_>,
        index: usize,
        random: &mut Xoshiro256PlusPlus,
    ) -> Self {
        let count = machine.description.variables.len();
        let mut path = Self {
            middle: vec![0.0; count],
            swing: vec![0.0; count],
            speed: (0..count).map(|_| random.random_range(0.2..1.0)).collect(),
            phase: (0..count).map(|_| random.random_range(0.0..core::f64::consts::TAU)).collect(),
            through: case.singular.get(index % (case.singular.len() + 1)).copied(),
        };
        for j in 0..count {
            let [lower, upper] = machine.limits(j);
            let half = (0.5 * (upper - lower)).min(if upper - lower > 50.0 { 1e9 } else { 2.0 });
            path.swing[j] = half * random.random_range(0.05..0.3);
            path.middle[j] = 0.5 * (lower + upper) + half * random.random_range(-0.5..0.5);
        }
        path
    }

    pub(crate) fn at(&self, t: f64) -> Vec<f64> {
        let one = |j| match self.through == Some(j) {
            true => 0.4 - 0.8 * t,
            false => {
                self.middle[j]
                    + self.swing[j] * (core::f64::consts::TAU * self.speed[j] * t + self.phase[j]).sin()
            }
        };
        (0..self.middle.len()).map(one).collect()
    }
}

/// Checks random smooth paths of a second at 1 kHz, half of them through singular poses: no
/// correction changes by more than the bound, and what is left is reported to a nanometre. A
/// thorough run has 1,000 paths.
#[test]
fn no_correction_changes_by_more_than_its_bound() {
    let (paths, cycles) = (if thorough() { 143 } else { 4 }, 1000);
    for case in cases() {
        let machine = Machine::new(&case.robot);
        let mut random = Xoshiro256PlusPlus::seed_from_u64(7);
        let (mut counts, mut most, mut worst) = ([0; 5], [0.0_f64; 2], [0.0_f64; 2]);
        for index in 0..paths {
            let path = Path::new(&case, &machine, index, &mut random);
            let mut cycle = machine.first(case.rotations);
            let mut drives: Option<(Vec<f64>, Vec<f64>)> = None;
            for k in 0..cycles {
                let q = path.at(k as f64 / 1000.0);
                let done = machine.corrected(&q, &cycle).unwrap();
                let [distance, angle] = machine.check(&q, &cycle, &done);
                worst = [worst[0].max(distance), worst[1].max(angle)];
                counts[Status::ALL.iter().position(|status| *status == done.status).unwrap()] += 1;
                for j in 0..q.len() {
                    let unit =
                        cycle.largest[j] / abbe::compensator::LARGEST[usize::from(cycle.largest[j] > 1.0)];
                    most[0] = most[0].max((done.correction[j] / unit).abs());
                    most[1] = most[1].max(((done.correction[j] - cycle.last[j]) / unit).abs());
                    assert!(done.correction[j].abs() <= cycle.largest[j] * (1.0 + 1e-9));
                    // No drive moves further than its command and the bound.
                    if let Some((command, before)) = &drives {
                        let [moved, commanded] = [done.q[j] - before[j], q[j] - command[j]].map(f64::abs);
                        assert!(moved <= commanded + cycle.change[j] + 1e-12 * (1.0 + q[j].abs()));
                    }
                }
                drives = Some((q, done.q));
                cycle.last = done.correction;
            }
        }
        println!(
            "{}: {counts:?} (reached, not converged, held, outside, not reached); corrections up to {:.4}, changes up to \
             {:.5} a cycle; left {:.1e} m, {:.1e} rad",
            machine.description.name, most[0], most[1], worst[0], worst[1]
        );
        assert!(counts[0] > paths * cycles / 3, "{counts:?}");
    }
}

/// Checks that corrections do not buzz: along smooth paths at 1 kHz, through and beside singular
/// poses and in several modes of `rotations`, no correction goes forth, back and forth again in
/// successive cycles more than five times in a second; in one path of twenty it may, where a
/// stretched elbow cannot reach the pose. A thorough run has 2,000 paths.
#[test]
fn corrections_do_not_go_back_and_forth() {
    let paths = if thorough() { 84 } else { 4 };
    let modes = |name: &str| match name {
        "pps" | "scara" => vec![[1.0; 3], [0.0; 3]],
        "five_axis" => vec![[1.0, 1.0, 0.0], [1.0; 3]],
        _ => vec![[1.0; 3], [1.0, 1.0, 0.0], [0.0; 3]],
    };
    let (mut all, mut buzzing) = (0, 0);
    for case in cases().into_iter().chain(arms_with_wrists()) {
        let machine = Machine::new(&case.robot);
        for rotations in modes(&machine.description.name) {
            let mut random = Xoshiro256PlusPlus::seed_from_u64(7);
            let found: Vec<usize> = (0..paths)
                .map(|index| {
                    let mut path = Path::new(&case, &machine, index, &mut random);
                    // Every other path stays beside the singular pose.
                    if let Some(j) = path.through.filter(|_| index % 2 == 0) {
                        (path.through, path.middle[j]) = (None, random.random_range(-0.1..0.1));
                        path.swing[j] = random.random_range(0.0..0.1);
                    }
                    returns(&machine, &path, rotations)
                })
                .collect();
            println!(
                "{}, {rotations:?}: {} in {paths} s",
                machine.description.name,
                found.iter().sum::<usize>()
            );
            all += paths;
            buzzing += found.iter().filter(|returns| **returns > 5).count();
        }
    }
    println!("{buzzing} of {all} paths buzz");
    assert!(20 * buzzing <= all, "{buzzing} of {all} paths buzz");
}

/// Returns how often a correction goes forth, back and forth again in successive cycles of a
/// second.
fn returns(machine: &Machine<'_>, path: &Path, rotations: [f64; 3]) -> usize {
    let mut cycle = machine.first(rotations);
    let (mut count, mut steps) = (0, vec![[0.0; 2]; cycle.last.len()]);
    for k in 0..1000 {
        let done = machine.corrected(&path.at(f64::from(k) / 1000.0), &cycle).unwrap();
        for (j, [first, second]) in steps.iter_mut().enumerate() {
            // In parts of the largest change: 1 µrad or 0.5 µm.
            let third = (done.correction[j] - cycle.last[j]) / cycle.change[j];
            let is_large = [*first, *second, third].into_iter().all(|step| step.abs() > 5e-4);
            count += usize::from(is_large && *first * *second < 0.0 && *second * third < 0.0);
            (*first, *second) = (*second, third);
        }
        cycle.last = done.correction;
    }
    count
}

/// A million random commands in a thorough run, within and beyond the limits, with bounds and
/// corrections before them of any kind: nothing is out of bounds, and `OK` leaves no more than it
/// says.
#[test]
fn ok_is_true_at_random_commands() {
    let count = sample_size(100_000) / 7 * if thorough() { 10 } else { 1 };
    for case in cases() {
        let machine = Machine::new(&case.robot);
        let mut random = Xoshiro256PlusPlus::seed_from_u64(11);
        let mut counts = [0; 5];
        for index in 0..count {
            let q: Vec<f64> = (0..machine.description.variables.len())
                .map(|j| {
                    let [lower, upper] = machine.limits(j);
                    let beyond = if index % 2 == 0 { 0.0 } else { 0.05 };
                    let share = random.random_range(-beyond..1.0 + beyond);
                    lower + share * (upper - lower)
                })
                .collect();
            let mut cycle = machine.first([case.rotations, [1.0; 3], [0.0; 3], [1.0, 0.0, 1.0]][index % 4]);
            for j in 0..q.len() {
                cycle.last[j] = cycle.largest[j] * random.random_range(-1.0..1.0);
                match random.random_range(0..5) {
                    0 => {
                        (cycle.change[j], cycle.largest[j], cycle.last[j]) =
                            (f64::INFINITY, f64::INFINITY, 0.0);
                    }
                    1 => cycle.change[j] = [0.0, -1.0, f64::NAN][index % 3],
                    2 => cycle.largest[j] = [0.0, -1.0, f64::NAN][index % 3],
                    _ => {}
                }
            }
            if index % 3 == 0 {
                let no_last = vec![0.0; q.len()];
                let any = vec![f64::INFINITY; q.len()];
                cycle = Cycle { last: no_last, change: any.clone(), largest: any, ..cycle };
            }
            let done = machine.corrected(&q, &cycle).unwrap();
            machine.check(&q, &cycle, &done);
            counts[Status::ALL.iter().position(|status| *status == done.status).unwrap()] += 1;
        }
        println!("{}: {counts:?} of {count}", machine.description.name);
        assert!(counts[0] > count / 10 && counts[3] > count / 10, "{counts:?}");
    }
}

/// Commands far beyond the limits are a status of their own, with commands within the limits.
/// The first cycle after a stop moves no drive further than its `change`, wherever the command is;
/// at the command where a path begins, none by more than a thousandth of it, or of a redundant arm
/// by a quarter.
#[test]
fn paths_begin_where_the_drives_stand() {
    let count = sample_size(20_000) / 7;
    for case in cases().into_iter().chain(arms_with_wrists()) {
        let machine = Machine::new(&case.robot);
        let mut random = Xoshiro256PlusPlus::seed_from_u64(13);
        let (mut reached, mut most) = (0, 0.0_f64);
        for _ in 0..count {
            let [drives, elsewhere] = [(); 2].map(|()| -> Vec<f64> {
                let limits = (0..machine.description.variables.len()).map(|j| machine.limits(j));
                limits
                    .map(|[lower, upper]| lower + random.random_range(0.05..0.95) * (upper - lower))
                    .collect()
            });
            let mut cycle = machine.first(case.rotations);
            for (last, (drive, command)) in cycle.last.iter_mut().zip(drives.iter().zip(&elsewhere)) {
                *last = drive - command;
            }
            let done = machine.corrected(&elsewhere, &cycle).unwrap();
            machine.check(&elsewhere, &cycle, &done);
            for (j, (now, before)) in done.q.iter().zip(&drives).enumerate() {
                let moved = (now - before).abs();
                assert!(moved <= cycle.change[j] + 1e-12 * (1.0 + before.abs()), "{j}: {moved}");
            }
            let begun = machine.begun(&drives, case.rotations);
            let held = begun.last.iter().zip(&cycle.largest).any(|(last, largest)| last.abs() > *largest);
            if begun.status != Status::Reached || held {
                continue;
            }
            reached += 1;
            cycle.last = begun.last;
            let done = machine.corrected(&begun.command, &cycle).unwrap();
            assert_eq!(done.status, Status::Reached, "{drives:?}");
            let moved = done.q.iter().zip(&drives).zip(&cycle.change);
            let moved =
                moved.map(|((now, before), change)| (now - before).abs() / change).fold(0.0, f64::max);
            most = most.max(moved);
        }
        println!("{}: {reached} of {count} begin, {most:e} of the change", machine.description.name);
        // Of a redundant arm, the shortest correction is not exactly that of the drives.
        let is_redundant = machine.description.variables.len() > 6;
        assert!(reached * 10 >= 8 * count && most <= if is_redundant { 0.25 } else { 1e-3 });
    }
}

#[test]
fn commands_beyond_limits_have_a_status() {
    let case = cases().swap_remove(0);
    let machine = Machine::new(&case.robot);
    for far in [6.3, 1e3, 1e9, 1e308] {
        let q = [0.1, -1.0, 1.2, -0.5, 0.8, far];
        let cycle = machine.first([1.0; 3]);
        let done = machine.corrected(&q, &cycle).unwrap();
        assert_eq!(done.status, Status::OutsideLimits);
        machine.check(&q, &cycle, &done);
    }
    // At a limit, a unit in the last place is rounding.
    let upper = machine.limits(5)[1];
    for (far, is_outside) in [(upper.next_up(), false), (upper, false), (upper + 1e-9, true)] {
        let q = [0.1, -1.0, 1.2, -0.5, 0.8, far];
        let done = machine.corrected(&q, &machine.first([1.0; 3])).unwrap();
        assert_eq!(done.status == Status::OutsideLimits, is_outside, "{far}");
    }
}

/// A wrist passes through its singular pose, and an elbow its stretched one: the wrist of a UR5
/// moved by 1.81 rad in a cycle with λ = 1e-14, one pass and no bounds. Prints the table.
#[test]
fn wrist_and_elbow_pass_singular_poses() {
    let case = cases().swap_remove(0);
    let machine = Machine::new(&case.robot);
    for (name, joint) in [("wrist, q5 = 0", 4), ("elbow, q3 = 0", 2)] {
        for bounded in [false, true] {
            let mut cycle = machine.first([1.0; 3]);
            if !bounded {
                let any = vec![f64::INFINITY; 6];
                cycle = Cycle { change: any.clone(), largest: any, ..cycle };
            }
            let (mut largest, mut change, mut counts) = (0.0_f64, 0.0_f64, [0; 5]);
            let (mut left, mut away) = ([0.0_f64; 2], [0.0_f64; 2]);
            for k in 0..1000 {
                let t = f64::from(k) / 1000.0;
                let mut q: Vec<f64> = [0.3, -1.2, 1.4, -0.9, 0.8, 0.2].to_vec();
                (0..6).for_each(|j| q[j] += 0.2 * (t + j as f64).sin());
                q[joint] = 0.5 - t;
                let done = machine.corrected(&q, &cycle).unwrap();
                let remaining = machine.check(&q, &cycle, &done);
                counts[Status::ALL.iter().position(|status| *status == done.status).unwrap()] += 1;
                for j in 0..6 {
                    largest = largest.max(done.correction[j].abs());
                    if k > 0 {
                        change = change.max((done.correction[j] - cycle.last[j]).abs());
                    }
                }
                let most = if (t - 0.5).abs() > 0.3 && k > 200 { &mut away } else { &mut left };
                *most = std::array::from_fn(|i| most[i].max(remaining[i]));
                cycle.last = done.correction;
            }
            println!(
                "| {name} | {} | {largest:.3} rad | {change:.5} rad | {counts:?} | {:.1e} m, {:.1e} rad | {:.1e} m, {:.1e} rad |",
                if bounded { "bounded" } else { "any size" },
                left[0],
                left[1],
                away[0],
                away[1],
            );
            if bounded {
                assert!(largest <= 0.05 + 1e-12 && change <= 0.002 + 1e-12);
                // Not on the other side of a singular pose for good.
                assert!(away[0] < 1e-9 && away[1] < 1e-8, "{away:?}");
            } else if joint == 4 {
                // The figures of docs/in-a-controller.md.
                assert!(largest < 0.0275 && change < 0.0017, "{largest} rad, {change} rad a cycle");
                assert!(left[0] < 1e-9 && left[1] < 9.2e-4 && counts[0] >= 840, "{left:?} {counts:?}");
            }
        }
    }
}

/// Rotations that are not to be reached are free: a drill's arm needs the shortest correction.
#[test]
fn free_rotations_shorten_the_correction() {
    let case = cases().swap_remove(0);
    let machine = Machine::new(&case.robot);
    let q = [0.3, -1.2, 1.4, -0.9, 0.8, 0.2];
    let sizes = [[1.0; 3], [1.0, 1.0, 0.0], [0.0; 3]].map(|rotations| {
        let any = vec![f64::INFINITY; 6];
        let cycle = Cycle { change: any.clone(), largest: any, ..machine.first(rotations) };
        let done = machine.corrected(&q, &cycle).unwrap();
        machine.check(&q, &cycle, &done);
        let size = done.correction.iter().map(|d| d * d).sum::<f64>().sqrt();
        (done.status, size)
    });
    println!("{sizes:?}");
    assert!(sizes.iter().all(|(status, _)| *status == Status::Reached), "{sizes:?}");
    assert!(sizes[0].1 > sizes[1].1 && sizes[1].1 > sizes[2].1);
}

/// A spec without errors is its own correction: every command is reached as it is.
#[test]
fn without_errors_nothing_is_corrected() {
    let shipped = SHIPPED.iter().find(|shipped| shipped.name == "ur5").unwrap();
    let robot = Interpreter::new(Spec::parse("ur5", shipped.spec).unwrap());
    let machine = Machine::new(&robot);
    let q = [0.3, -1.2, 0.0, -0.9, 0.0, 0.2];
    let done = machine.corrected(&q, &machine.first([1.0; 3])).unwrap();
    assert_eq!((done.status, done.q), (Status::Reached, q.to_vec()));
}
