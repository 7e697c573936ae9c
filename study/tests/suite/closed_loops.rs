//! Jobs on machines that are not a chain: their figures are right, or they are refused.

use abbe_spec::Spec;
use abbe_spec::diagnostic::Diagnostics;
use abbe_study::analyze::figures::FigureData;
use abbe_study::analyze::{Analyze, Report};
use abbe_study::bound::Bound;
use abbe_study::explore::Explore;
use abbe_study::export::{Export, Format};
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

/// What proves, searches or writes chains refuses other machines, and names their structure.
#[test]
fn jobs_on_chains_are_refused() {
    for (text, structure) in all().iter().zip(["branches", "closed loops", "closed loops"]) {
        let machine = machine(text);
        let study = Study::joint_samples(&machine.spec);
        let refused = |mistakes: Diagnostics| {
            let text = mistakes.to_string();
            assert!(
                text.contains(&format!("machines with {structure} are not supported here yet")),
                "{text}"
            );
            assert!(text.contains("help: use `abbe "), "{text}");
        };
        refused(Bound::new(machine.clone(), study).run(&mut ()).unwrap_err());
        refused(Explore::measured(machine.clone(), None).run(&mut ()).unwrap_err());
        assert!(Explore::measured(machine.clone(), None).panel(&mut ()).unwrap().is_none());
        let export = Export { machine, format: Format::Dh, samples: 10, seed: 1 };
        refused(export.run(&mut ()).unwrap_err());
    }
}

/// Nothing is certified, and a sentence says so. The exact machine agrees with first order to
/// second order: errors are of order 0.1 mm and the arm of 100 mm or more.
#[test]
fn analyses_certify_nothing() {
    for text in all() {
        let report = analyzed(&text);
        assert!(report.certified.is_none());
        assert!(report.conclusions().iter().any(|sentence| sentence.starts_with("Certified: nothing")));
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

/// The figure of the machine at home has a line from each frame to the one that it hangs on, and
/// one for each leg.
#[test]
fn the_figure_of_the_machine_is_a_tree() {
    let drawn = |text: &str| {
        let figures = analyzed(text).figures.unwrap().figures;
        let sticks = figures.into_iter().filter_map(|figure| match figure.data {
            FigureData::Manipulator(stick) => Some(stick.links),
            _ => None,
        });
        sticks.last().unwrap()
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
