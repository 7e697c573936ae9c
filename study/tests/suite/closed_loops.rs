//! Jobs on machines that are not a chain: their figures are right, or they are refused.

use abbe::Manipulator;
use abbe::analysis::ReachError;
use abbe_interpreter::Interpreter;
use abbe_manipulators::MECHANISMS;
use abbe_spec::Spec;
use abbe_spec::diagnostic::Diagnostics;
use abbe_spec::document::Document;
use abbe_study::analyze::figures::FigureData;
use abbe_study::analyze::{Analyze, Report};
use abbe_study::bound::Bound;
use abbe_study::export::{Export, Format};
use abbe_study::open_loops::not_evaluated;
use abbe_study::{Machine, Study};

use crate::closed_machines::{FOUR_BAR, TWO_ARMS, hexapod, some_errors};

fn machine(text: &str) -> Machine {
    let spec = Spec::parse("machine.toml", text).unwrap_or_else(|mistakes| panic!("{mistakes}"));
    Machine::of_spec(spec, "machine.toml")
}

fn analyzed(text: &str) -> Report {
    let machine = machine(text);
    let study = Study::joint_samples(&machine.spec);
    let mut analysis = Analyze::new(machine, study);
    analysis.figures = true;
    analysis.run(&mut ()).unwrap_or_else(|mistakes| panic!("{mistakes}"))
}

fn all() -> [String; 3] {
    [TWO_ARMS.to_owned(), FOUR_BAR.to_owned(), hexapod(&some_errors(), "")]
}

/// Checks that jobs that write chains refuse other machines, and name their structure. Of bounds,
/// this holds for those of the dexterity and the stiffness.
#[test]
fn jobs_on_chains_are_refused() {
    for (text, structure) in all().iter().zip(["branches", "closed loops", "closed loops"]) {
        let machine = machine(text);
        let mut bound = Bound::new(machine.clone(), Study::joint_samples(&machine.spec));
        bound.least = true;
        let refused = |mistakes: Diagnostics| {
            let text = mistakes.to_string();
            assert!(
                text.contains(&format!("machines with {structure} are not supported here yet")),
                "{text}"
            );
            assert!(text.contains("help: use `abbe "), "{text}");
        };
        refused(bound.run(&mut ()).unwrap_err());
        let export = Export { machine, format: Format::Dh, samples: 10, seed: 1 };
        refused(export.run(&mut ()).unwrap_err());
    }
}

/// Nothing is certified. The exact machine agrees with first order to
/// second order: errors are of order 0.1 mm and the arm of 100 mm or more.
#[test]
fn analyses_certify_nothing() {
    for text in all() {
        let report = analyzed(&text);
        assert!(report.certified.is_none());
        let radius = report.budget.combined.radius.value;
        assert!(report.first_order.largest < 0.02 * radius, "{} {radius}", report.first_order.largest);
    }
}

/// The errors of the other arm do not move the tool.
#[test]
fn other_branches_have_no_share() {
    let report = analyzed(TWO_ARMS);
    let largest = |name: &str| {
        let index = report.sources.iter().position(|source| source.name == name).unwrap();
        report.budget.sources[index].plain_max.norm
    };
    assert!(largest("left bearing") > 0.02);
    assert_eq!(largest("right bearing"), 0.0);
}

/// Configurations where the loops do not close are counted, each with its reason.
#[test]
fn configurations_that_do_not_close_are_unreachable() {
    let report = analyzed(&hexapod(&some_errors(), ""));
    let [reason] = &report.unreachable_reasons[..] else { panic!("{:?}", report.unreachable_reasons) };
    assert!(reason.reason.contains("loops do not close"), "{}", reason.reason);
    assert_eq!(reason.count + report.budget.configurations, 1000);
    assert!(reason.count > 0 && reason.count < 500, "{}", reason.count);
}

/// Commands out of reach name the loop, what its links lack, and the end of the path from home.
#[test]
fn open_loops_are_named() {
    let links = [
        ("Tx(100) Rz(p2) Tx(80)", "Tx(120) Rz(p2) Tx(90)"),
        ("Tx(40)", "Tx(100)"),
        ("Rz(p1) Tx(120)", "Rz(p1) Tx(40)"),
    ];
    let text = links.iter().fold(FOUR_BAR.to_owned(), |text, (from, to)| text.replace(from, to));
    let machine = machine(&text);
    let (evaluator, q) = (machine.evaluator(true), [-100_f64.to_radians()]);
    let error = evaluator.pose(&q, &[]).unwrap_err();
    let spec = (&*machine.spec, &q[..], &[][..]);
    let message = not_evaluated("machine.toml", "here", &error, evaluator.description(), spec).to_string();
    // From the end of the crank to the ground, less the coupler and the rocker.
    let [x, y] = [120.0 - 100.0 * (-100_f64).to_radians().cos(), 100.0 * 100_f64.to_radians().sin()];
    let gap = f64::hypot(x, y) - 130.0;
    assert!(message.contains(&format!("loop \"knee\" stays open by {gap:.4}")), "{message}");
    // The knee is folded where (120 − 100 cos q)² + (100 sin q)² = (90 − 40)².
    let end = ((24_400.0_f64 - 2_500.0) / 24_000.0).acos().to_degrees();
    let share = 100.0 * (60.0 - end) / 160.0;
    assert!(message.contains(&format!("ends after {share:.0} % of the way")), "{message}");
}

/// The figure of the machine at home has a line from each frame to the one that it hangs on, and
/// one for each leg.
#[test]
fn the_figure_of_the_machine_is_a_tree() {
    let drawn = |text: &str| {
        let figures = analyzed(text).figures.unwrap().figures;
        let mut sticks = figures.into_iter().filter_map(|figure| match figure.data {
            FigureData::Manipulator(stick) => Some(stick.links),
            _ => None,
        });
        sticks.next_back().unwrap()
    };
    let legs = drawn(&hexapod(&some_errors(), ""));
    let length = |link: &Vec<[f64; 3]>| (0..3).map(|i| (link[1][i] - link[0][i]).powi(2)).sum::<f64>().sqrt();
    assert_eq!(legs.iter().filter(|leg| (length(leg) - 580.0).abs() < 1e-9).count(), 6);
    let four_bar: Vec<f64> = drawn(FOUR_BAR).iter().map(length).collect();
    // The rocker is drawn from the base: √(100² + 80² + 2 · 100 · 80 cos p2).
    for (found, expected) in four_bar.iter().zip([40.0, 120.0]) {
        assert!((found - expected).abs() < 1e-9, "{four_bar:?}");
    }
    assert_eq!(four_bar.len(), 4);
}

fn over(text: &str, workspace: &str) -> Result<(Machine, Study), String> {
    let machine = machine(text);
    let study = format!("[study]\ntitle = \"Platform\"\n\n{workspace}");
    let study = Study::read(Document::new("study.toml", study), &machine.spec);
    study.map(|study| (machine, study)).map_err(|mistakes| mistakes.to_string())
}

/// Legs follow from the poses of a platform: at every configuration the machine has the passive
/// variables of the grid. Poses beyond the limits of the legs are unreachable.
#[test]
fn legs_follow_from_poses() {
    let grid = "[workspace.grid]\nx = [-20, 20]\nz = { from = 500, to = 700, count = 5 }\n\
                a = [\"-3 deg\", \"3 deg\"]\nc = [\"2 deg\"]\n";
    let (machine, study) = over(&hexapod(&some_errors(), ""), grid).unwrap();
    let evaluator = machine.evaluator(true);
    let workspace = study.region.workspace(&*evaluator, None).unwrap();
    assert_eq!(workspace.len(), 20);
    let angle = 3.0_f64.to_radians();
    let mut outside = 0;
    for index in 0..20 {
        let [x, z] = [[-20.0, 20.0][index / 10], 500.0 + 50.0 * ((index / 2) % 5) as f64];
        match workspace.configuration(index) {
            Ok(at) => {
                let mut p = [0.0; 6];
                evaluator.passive(&at.q, &at.s, &mut p).unwrap();
                let expected = [x, 0.0, z, [-angle, angle][index % 2], 0.0, 2.0_f64.to_radians()];
                for (p, expected) in p.iter().zip(expected) {
                    assert!((p - expected).abs() < 1e-9, "{p} {expected}");
                }
            }
            Err(ReachError::OutsideLimits { value, limits: [lower, upper], .. }) => {
                assert!(value < lower || value > upper);
                outside += 1;
            }
            Err(error) => panic!("{error}"),
        }
    }
    assert!(outside > 0 && outside < 10, "{outside}");
    let report = Analyze::new(machine, study).run(&mut ()).unwrap();
    assert_eq!(report.budget.configurations, 20 - outside);
}

/// Checks that where legs do not follow in closed form, a grid of passive variables is a mistake
/// with its reason; so is a grid of both kinds of variables.
#[test]
fn grids_of_passive_variables_need_legs() {
    let refused = |text: &str, grid: &str| over(text, &format!("[workspace.grid]\n{grid}")).err().unwrap();
    let message = refused(FOUR_BAR, "p1 = [0]\n");
    assert!(message.contains("the loop \"knee\" is not a leg of the length `… + q`"), "{message}");
    let mixed = refused(&hexapod(&some_errors(), ""), "x = [0]\nq1 = [0]\n");
    assert!(mixed.contains("no passive variable `q1`"), "{mixed}");
    let two = hexapod(&some_errors(), "").replace("580 mm + q2", "580 mm + 2 * q2");
    let message = refused(&two, "x = [0]\n");
    assert!(message.contains("the loop \"leg 2\" is not a leg"), "{message}");
}

/// The condition of the loops of a four-bar linkage is that of the two directions in which its knee
/// moves, `120 (−sin, cos)(q1 + p1)` and `80 (−sin, cos) p2`: with the angle α between them and the
/// ratio r of their lengths, σ² = (1 + r² ± √((1 + r²)² − 4 r² sin² α)) / 2.
#[test]
fn the_condition_of_loops_is_that_of_theory() {
    let condition = |q1: f64| {
        let spec = machine(FOUR_BAR).spec.clone();
        let mut p = [0.0; 2];
        Interpreter::new(spec).passive(&[q1], &[], &mut p).unwrap();
        let sine = (q1 + p[0] - p[1]).sin();
        let sum: f64 = 1.0 + (80.0_f64 / 120.0).powi(2);
        let root = (sum * sum - 4.0 * (80.0_f64 / 120.0 * sine).powi(2)).sqrt();
        ((sum + root) / (sum - root)).sqrt()
    };
    let (machine, study) =
        over(FOUR_BAR, "[workspace.grid]\nq1 = [\"-90 deg\", \"0 deg\", \"100 deg\"]\n").unwrap();
    let report = Analyze::new(machine, study).run(&mut ()).unwrap();
    let expected = [-90.0_f64, 0.0, 100.0, 60.0].map(|q1| condition(q1.to_radians()));
    let largest = expected.into_iter().fold(0.0, f64::max);
    let loops = report.loops.as_ref().unwrap();
    assert!((loops.largest / largest - 1.0).abs() < 1e-9, "{} {largest}", loops.largest);
    assert!(!loops.is_nearly_singular());
    assert_eq!(loops.configurations, 3);
    assert!(analyzed(TWO_ARMS).loops.is_none());
}

/// Checks that the texts of the shipped machines with loops are those of their specs: `identify`
/// writes the identified machine from them.
#[test]
fn shipped_machines_with_loops_have_their_text() {
    for (name, _) in MECHANISMS {
        let machine = Machine::find(name).unwrap();
        let text = machine.text().unwrap();
        assert_eq!(Spec::parse("machine.toml", &text).unwrap().hash, machine.spec.hash);
    }
}

/// Checks that from a condition number of 1000 on, the verdict is that the machine is nearly
/// singular.
#[test]
fn nearly_singular_loops_are_a_verdict() {
    let mut report = analyzed(FOUR_BAR);
    for (largest, is_nearly_singular) in [(1000.0, false), (1001.0, true)] {
        let loops = report.loops.as_mut().unwrap();
        loops.largest = largest;
        assert_eq!(loops.is_nearly_singular(), is_nearly_singular);
    }
}
