//! The doctor gets rows with one or two mistakes, and noise, and must name them.
//!
//! Cases are seeded. `ABBE_DOCTOR_CASES` sets their number per kind and robot; the full proof has
//! 100.

mod case;

use std::f64::consts::PI;
use std::path::Path;

use abbe::Manipulator;
use abbe::analysis::sampling;
use abbe_interpreter::Interpreter;
use abbe_metrology::data::{Data, Map};
use abbe_metrology::doctor::{Change, Doctor, Interpretation, Report};
use abbe_metrology::measure::Measure;
use abbe_spec::Spec;
use abbe_study::Machine;
use abbe_tests::closed_machines::FOUR_BAR;
use nalgebra::{Rotation3, Vector3};

use case::Mistake::*;
use case::{ALL, Case, Mistake, Random, case, is_layout, text};

const ROBOTS: [&str; 6] = ["ur5", "puma560", "stanford", "panda", "iiwa", "wam"];

fn run(spec: &str, data: &str, folder: &Path) -> Report {
    let (file, rows) = (folder.join("robot.toml"), folder.join("rows.csv"));
    std::fs::write(&file, spec).unwrap();
    std::fs::write(&rows, data).unwrap();
    Doctor { machine: Machine::find(&file).unwrap(), data: (&rows).into(), within: None }
        .run(&mut ())
        .unwrap()
}

/// Checks that the written map, with the corrected spec if necessary, leaves the reported residual
/// of these rows, up to the different treatment of a fitted base. Returns whether the spec was
/// corrected.
fn map_holds(report: &Report, folder: &Path) -> bool {
    let file = folder.join("robot.toml");
    let machine = Machine::find(&file).unwrap();
    let text = std::fs::read_to_string(&file).unwrap();
    let corrected = report.corrected(&machine.spec, &text, "corrected.toml").unwrap();
    let is_corrected = corrected.is_some();
    let of_rows = |change: &Change| matches!(change, Change::PoseInverted);
    let rest = report.found.first().is_some_and(|found| found.interpretation.changes.iter().any(of_rows));
    let differs = report.of_spec.iter().any(|line| line.starts_with("differences"));
    let held = report.of_spec.is_empty() || (is_corrected && !rest && !differs);
    // All corrections of these specs can be written as text.
    assert!(
        held || rest || differs || report.found.is_empty(),
        "{}: {:?}",
        machine.spec.name,
        report.of_spec
    );
    let Some(text) = report.map.as_ref().filter(|_| held) else { return is_corrected };
    let machine = match &corrected {
        Some(text) => Machine::of_spec(Spec::parse("corrected.toml", text).unwrap(), "corrected.toml"),
        None => machine,
    };
    let map =
        Map::parse("map.toml", text, &machine.spec).unwrap_or_else(|mistakes| panic!("{text}\n{mistakes}"));
    let data = Data::read(folder.join("rows.csv").as_path(), &map).unwrap();
    let measured = Measure { machine, map, data, accept: Default::default() }.run(&mut ()).unwrap();
    let left = measured.errors.iter().find(|size| size.name == "norm").unwrap().rms;
    let said = report.found[0].residual;
    assert!((left - said).abs() < 0.05 * said, "{left} is left, {said} was said\n{text}");
    is_corrected
}

/// Returns whether two interpretations are equal, with zeros to 0.02 rad or 2 mm.
fn is_same(a: &Interpretation, b: &Interpretation, in_mm: f64) -> bool {
    let near = |change: &Change| {
        b.changes.iter().any(|other| match (change, other) {
            (Change::Zero { joint, offset }, Change::Zero { joint: of, offset: other }) => {
                let off = (offset - other).abs();
                let turn = (off % (2.0 * PI)).min((2.0 * PI - off % (2.0 * PI)).abs());
                joint == of && (turn < 0.02 || off < 2.0 / in_mm)
            }
            _ => change == other,
        })
    };
    (a.joints_in_degrees, a.slides_in, a.lengths_in) == (b.joints_in_degrees, b.slides_in, b.lengths_in)
        && a.layout == b.layout
        && a.changes.len() == b.changes.len()
        && a.changes.iter().all(near)
}

#[derive(Debug, Default)]
struct Score {
    cases: usize,
    /// Cases with the correct interpretation first.
    first: usize,
    /// Cases with the correct interpretation among the indistinguishable ones.
    among: usize,
    /// Total number of indistinguishable interpretations.
    found: usize,
}

impl Score {
    fn add(&mut self, case: &Case, report: &Report, what: &str) {
        let in_mm = if report.length == "mm" { 1.0 } else { 1e3 };
        let place =
            report.found.iter().position(|finding| is_same(&case.right, &finding.interpretation, in_mm));
        self.cases += 1;
        self.first += usize::from(place == Some(0));
        self.among += usize::from(place.is_some());
        self.found += report.found.len();
        if place.is_none() {
            println!("{what}: {:?}\n  {:?}", case.right, report.found);
        }
    }
}

fn cases() -> usize {
    std::env::var("ABBE_DOCTOR_CASES").ok().and_then(|count| count.parse().ok()).unwrap_or(1)
}

fn suits(robot: &str, mistake: Mistake) -> bool {
    // The others have no DH parameters.
    mistake != Convention || !["iiwa", "puma560"].contains(&robot)
}

#[test]
fn single_mistakes_are_named() {
    let folder = tempfile::tempdir().unwrap();
    let mut score = Score::default();
    for robot in ROBOTS {
        let mut random = Random(1);
        for k in 0..cases() {
            let shift = ROBOTS.iter().position(|name| *name == robot).unwrap() * 3;
            let mistake =
                (0..).map(|i| ALL[(k + shift + i) % ALL.len()]).find(|one| suits(robot, *one)).unwrap();
            let case = case(robot, &[mistake], &mut random);
            let report = run(&case.spec, &case.data, folder.path());
            score.add(&case, &report, &format!("{robot}, {mistake:?}"));
            map_holds(&report, folder.path());
        }
    }
    println!("single: {score:?}");
    assert!(score.among * 100 >= score.cases * 98, "{score:?}");
}

#[test]
fn pairs_of_mistakes_are_named() {
    let folder = tempfile::tempdir().unwrap();
    let mut score = Score::default();
    for robot in ROBOTS {
        let mut random = Random(2 + robot.len() as u64);
        for _ in 0..cases() {
            let pair = loop {
                let pair = [ALL[random.below(ALL.len())], ALL[random.below(ALL.len())]];
                let [a, b] = pair;
                let alike = a == b || (is_layout(a) && is_layout(b));
                // Positions alone cannot be inverted to the tool's frame.
                let blind = pair.contains(&Difference) && pair.contains(&Pose);
                if !alike && !blind && suits(robot, a) && suits(robot, b) {
                    break pair;
                }
            };
            let case = case(robot, &pair, &mut random);
            let report = run(&case.spec, &case.data, folder.path());
            score.add(&case, &report, &format!("{robot}, {pair:?}"));
            map_holds(&report, folder.path());
        }
    }
    println!("pairs: {score:?}");
    assert!(score.among * 100 >= score.cases * 95, "{score:?}");
}

/// A coupled joint is found where several others turn the other way, too.
#[test]
fn couplings_and_several_signs_are_named() {
    let folder = tempfile::tempdir().unwrap();
    let mut score = Score::default();
    for robot in ["ur5", "puma560", "panda"] {
        let mut random = Random(5 + robot.len() as u64);
        for layout in [Quaternion, Position] {
            let case = case(robot, &[Coupled, Signs, layout], &mut random);
            let report = run(&case.spec, &case.data, folder.path());
            score.add(&case, &report, &format!("{robot}, {layout:?}"));
            map_holds(&report, folder.path());
        }
    }
    println!("coupled with signs: {score:?}");
    assert!(score.among == score.cases, "{score:?}");
}

/// Checks that corrections of a spec are written into it and change nothing else: spec and map
/// together predict the rows.
#[test]
fn the_spec_is_corrected() {
    let folder = tempfile::tempdir().unwrap();
    let mut corrected = 0;
    for (robot, mistakes) in [
        ("ur5", &[Convention][..]),
        ("panda", &[Convention, Tool]),
        ("ur5", &[Coupled]),
        ("stanford", &[Coupled, Sign]),
        ("wam", &[Coupled, Zero]),
        ("puma560", &[Base]),
        ("iiwa", &[Tool]),
        ("ur5", &[Ends, Matrix]),
        ("panda", &[Ends, Tool]),
        ("iiwa", &[Coupled]),
        ("slanted iiwa", &[Coupled, Zero]),
    ] {
        for seed in 1..=3 {
            let case = case(robot, mistakes, &mut Random(seed));
            let report = run(&case.spec, &case.data, folder.path());
            corrected += usize::from(map_holds(&report, folder.path()));
        }
    }
    assert!(corrected >= 28, "{corrected}");
    // The lines of the spec are unchanged, except for corrections and the comments above them.
    let case = case("ur5", &[Tool], &mut Random(1));
    let report = run(&case.spec, &case.data, folder.path());
    let spec = Spec::parse("robot.toml", &case.spec).unwrap();
    let new = report.corrected(&spec, &case.spec, "corrected.toml").unwrap().unwrap();
    let changed: Vec<&str> = new.lines().filter(|line| !case.spec.lines().any(|old| old == *line)).collect();
    let expected = [
        "# The spec as `abbe doctor` reads it:",
        "# - the tool transform is inverted",
        "transform = \"Ry(-0.4) Tz(-(110 mm)) Ty(-(20 mm)) Tx(-(30 mm))\"",
    ];
    assert_eq!(changed, expected);
    assert_eq!(new.lines().count(), case.spec.lines().count() + 2);
}

/// Checks an end effector that the spec lacks, with poses and with positions: the map contains its
/// position.
#[test]
fn another_tool_stands_in_the_map() {
    let folder = tempfile::tempdir().unwrap();
    for layout in [Matrix, Position] {
        let case = case("ur5", &[layout], &mut Random(11));
        let spec = case.spec.replace("Tx(30 mm)", "Tx(75 mm)");
        assert_ne!(spec, case.spec);
        let report = run(&spec, &case.data, folder.path());
        assert_eq!(report.found[0].interpretation.changes, [Change::ToolElsewhere], "{:?}", report.found);
        assert!(report.of_spec.is_empty() && report.map.as_ref().unwrap().contains("[placement]"));
        map_holds(&report, folder.path());
    }
}

/// Checks positions alone of a machine that stands elsewhere, with a target elsewhere, whose joints
/// move by 0.3 to 3 rad about some pose: the base and the target are found, exactly and with noise,
/// and are said and written.
#[test]
fn base_and_target_elsewhere_are_found_by_small_motions() {
    let folder = tempfile::tempdir().unwrap();
    let mut random = Random(3);
    for (i, robot) in ["ur5", "puma560", "iiwa", "wam"].into_iter().cycle().take(16).enumerate() {
        let spec = text(robot);
        let parsed = Spec::parse("robot.toml", &spec).unwrap();
        let unit = 1e-3 / parsed.length.in_metres();
        let arm = Interpreter::new(parsed.clone());
        let s = sampling::nominal_parameters(arm.description());
        let motion = [0.3, 0.6, 1.5, 3.0][i / 4];
        let noise = if i % 2 == 0 { 0.0 } else { 0.01 * unit };
        let base = elsewhere(&mut random, 900.0 * unit);
        let target: [f64; 3] = std::array::from_fn(|_| random.between(-120.0, 120.0) * unit);
        let middle: Vec<f64> = parsed.variables.iter().map(|_| random.between(-1.5, 1.5)).collect();
        let names: Vec<&str> = parsed.variables.iter().map(|variable| &*variable.name).collect();
        let mut rows = format!("{},x,y,z\n", names.join(","));
        for _ in 0..40 {
            let q: Vec<f64> = middle.iter().map(|at| at + motion * random.between(-0.5, 0.5)).collect();
            let point = base.then(&arm.pose(&q, &s).unwrap()).apply(target);
            let point = point.map(|value| value + noise * random.normal());
            let cells: Vec<String> = q.iter().chain(&point).map(|value| format!("{value:.9}")).collect();
            rows += &(cells.join(",") + "\n");
        }
        let report = run(&spec, &rows, folder.path());
        let first = report.found.first().unwrap_or_else(|| panic!("{robot} {motion}: {:?}", report.others));
        let is_elsewhere = |change: &Change| matches!(change, Change::BaseElsewhere | Change::ToolElsewhere);
        println!("{robot} {motion}: {} {}", first.residual, first.words);
        assert!(first.interpretation.changes.iter().all(is_elsewhere), "{robot} {motion}: {}", first.words);
        assert!(first.residual < 1e-5 * unit + 2.0 * noise, "{robot} {motion}: {}", first.residual);
        let map = report.map.as_ref().unwrap();
        assert!(
            first.words.contains("F_0 stands at (") && map.contains("[[station]]"),
            "{}\n{map}",
            first.words
        );
        assert!(first.words.contains("in the frame of the tool") && map.contains("targets = "), "{map}");
    }
}

/// Returns a random pose, with its position within a distance along each axis.
fn elsewhere(random: &mut Random, far: f64) -> abbe::Pose {
    let vector = Vector3::from_fn(|_, _| random.between(-1.8, 1.8));
    let turn = Rotation3::from_scaled_axis(vector).into_inner();
    let column = |i: usize| turn.column(i).into_owned().into();
    abbe::Pose([column(0), column(1), column(2), std::array::from_fn(|_| random.between(-far, far))])
}

/// Checks a machine with a small zero error: it is found, and the spec is offered if errors of this
/// size are accepted.
#[test]
fn what_less_changed_leaves_is_said_and_can_be_accepted() {
    let folder = tempfile::tempdir().unwrap();
    for layout in [Position, Matrix] {
        let case = case("ur5", &[layout], &mut Random(21));
        let spec = case.spec.clone();
        let shifted: String = case
            .data
            .lines()
            .enumerate()
            .map(|(i, line)| match line.split_once(',') {
                // The first column is the first joint, in rad.
                Some((q, rest)) if i > 0 => format!("{},{rest}\n", q.parse::<f64>().unwrap() + 0.004),
                _ => format!("{line}\n"),
            })
            .collect();
        let report = run(&spec, &shifted, folder.path());
        assert!(!report.found[0].interpretation.changes.is_empty(), "{:?}", report.found);
        let simpler = report.simpler.unwrap();
        assert!(simpler.interpretation.changes.is_empty() && simpler.both > report.found[0].both);
        let machine = Machine::find(folder.path().join("robot.toml")).unwrap();
        let within = Some(1.2 * simpler.both);
        let rows = folder.path().join("rows.csv");
        let asked = Doctor { machine, data: (&rows).into(), within }.run(&mut ()).unwrap();
        assert_eq!(asked.found[0].interpretation, simpler.interpretation, "{:?}", asked.found);
    }
}

/// Checks that few rows consistent with the spec yield no corrections, also for a robot with a
/// prismatic joint.
#[test]
fn few_rows_of_what_is_as_in_the_spec_are_as_in_the_spec() {
    let folder = tempfile::tempdir().unwrap();
    for (robot, layout) in
        [("ur5", Position), ("ur5", Quaternion), ("stanford", Position), ("stanford", Quaternion)]
    {
        for seed in 0..4 {
            let case = case(robot, &[layout], &mut Random(seed));
            let rows: String = case.data.lines().take(5).map(|line| line.to_owned() + "\n").collect();
            let report = run(&case.spec, &rows, folder.path());
            assert!(
                is_same(&report.found[0].interpretation, &case.right, 1.0),
                "{robot}: {:?}",
                report.found
            );
            map_holds(&report, folder.path());
        }
    }
}

/// Checks that a malformed cell removes its row, not its column.
#[test]
fn a_row_that_is_not_whole_is_left_out() {
    let folder = tempfile::tempdir().unwrap();
    let case = case("ur5", &[Quaternion], &mut Random(5));
    for slip in ["", "n/a", "nan", "−0.5"] {
        let mut lines: Vec<String> = case.data.lines().map(str::to_owned).collect();
        let (before, _) = lines[4].rsplit_once(',').unwrap();
        lines[4] = format!("{before},{slip}");
        let report = run(&case.spec, &lines.join("\n"), folder.path());
        assert_eq!(report.rows, 9);
        assert!(is_same(&report.found[0].interpretation, &case.right, 1.0), "{slip}: {:?}", report.found);
    }
}

/// Columns are found by their names, in any order, and others than joints and pose are ignored.
#[test]
fn columns_are_found_by_name() {
    let folder = tempfile::tempdir().unwrap();
    for layout in [Position, Quaternion] {
        let case = case("ur5", &[layout], &mut Random(5));
        let mut rows = String::new();
        for (i, line) in case.data.lines().enumerate() {
            let cells: Vec<&str> = line.split(',').collect();
            let (joints, pose) = cells.split_at(6);
            let (joints, others) = match i {
                0 => ((1..=6).map(|k| format!("J{k} [deg]")).collect(), "temperature,u95"),
                _ => (joints.iter().map(|cell| (*cell).to_owned()).collect::<Vec<_>>(), "20.5,0.03"),
            };
            rows += &format!("{others},{},{}\n", pose.join(",").replace("x,y,z", "X,Y,Z"), joints.join(","));
        }
        let report = run(&case.spec, &rows, folder.path());
        assert!(is_same(&report.found[0].interpretation, &case.right, 1.0), "{:?}", report.found);
        map_holds(&report, folder.path());
    }
}

/// Checks that ten visits of one configuration are rejected.
#[test]
fn equal_rows_are_refused() {
    let folder = tempfile::tempdir().unwrap();
    let case = case("ur5", &[Quaternion], &mut Random(5));
    let (heading, rows) = case.data.split_once('\n').unwrap();
    let row = rows.lines().next().unwrap();
    let data = format!("{heading}\n{}", format!("{row}\n").repeat(10));
    std::fs::write(folder.path().join("robot.toml"), &case.spec).unwrap();
    std::fs::write(folder.path().join("rows.csv"), data).unwrap();
    let machine = Machine::find(folder.path().join("robot.toml")).unwrap();
    let rows = folder.path().join("rows.csv");
    let refused = Doctor { machine, data: (&rows).into(), within: None }.run(&mut ());
    assert!(
        refused.unwrap_err().to_string().contains("the 10 rows of this file have one configuration only")
    );
}

#[test]
fn another_robot_is_said_to_be_another() {
    let folder = tempfile::tempdir().unwrap();
    let mut random = Random(3);
    let pairs = [
        ("ur5", "puma560"),
        ("panda", "iiwa"),
        ("puma560", "ur5"),
        ("iiwa", "wam"),
        ("wam", "panda"),
        ("ur5", "general6r"),
    ];
    // Without optimization the full set takes minutes.
    let (pairs, layouts) = if cases() == 1 {
        (&pairs[..2], &[Quaternion][..])
    } else {
        (&pairs[..], &[Quaternion, Difference][..])
    };
    for (robot, other) in pairs {
        for &layout in layouts.iter().cycle().take(layouts.len() * cases()) {
            let case = case(robot, &[layout], &mut random);
            let report = run(&text(other), &case.data, folder.path());
            println!("{robot} as {other}: {:?}", report.found);
            assert!(!report.fits, "{robot} as {other}: {:?}", report.found);
        }
    }
}

/// Rows of a machine with closed loops are read, too: its command in degrees with the other sign.
#[test]
fn rows_of_a_linkage_are_read() {
    let robot = Interpreter::new(Spec::parse("linkage.toml", FOUR_BAR).unwrap());
    let mut rows = "q1,x,y,z\n".to_owned();
    for k in 0..12 {
        let degrees = 35.0 + 6.5 * f64::from(k);
        let [x, y, z] = robot.real_pose(&[degrees.to_radians()], &[], &[]).unwrap().position();
        rows += &format!("{},{x:.4},{y:.4},{z:.4}\n", -degrees);
    }
    let folder = tempfile::tempdir().unwrap();
    let report = run(FOUR_BAR, &rows, folder.path());
    assert!(report.fits, "{:?}", report.found);
    let map = report.map.unwrap();
    assert!(map.contains("unit = \"deg\"") && map.contains("sign = -1"), "{map}");
}
