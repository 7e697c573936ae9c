//! Balls and discs: errors with one radius and any direction, over workspaces.

use abbe::analysis::sampling::stream;
use abbe_spec::Spec;
use abbe_spec::document::Document;
use abbe_study::allocate::Allocate;
use abbe_study::analyze::{Analyze, Report};
use abbe_study::bound::Bound;
use abbe_study::{Changes, Machine, Study};
use rand::RngExt;

fn source(name: &str, class: &str, frame: &str, errors: &str) -> String {
    format!("[[source]]\nname = \"{name}\"\nclass = \"{class}\"\nframe = \"{frame}\"\n{errors}\n")
}

fn ball(name: &str, class: &str, frame: &str, radius: f64) -> String {
    let errors = format!("distribution = \"ball\"\ne_x = {radius}\ne_y = {radius}\ne_z = {radius}");
    source(name, class, frame, &errors)
}

/// Returns a chain of random links with a normal, a repeatable and an unsigned error.
fn chain(seed: u64) -> String {
    let mut random = stream(seed, 0);
    let mut any = |from: f64, to: f64| random.random_range(from..to);
    let mut text = "[manipulator]\nname = \"chain\"\nlength = \"mm\"\n".to_owned();
    for i in 1..=3 {
        let (length, twist, offset) = (any(50.0, 400.0), any(-1.5, 1.5), any(0.0, 100.0));
        text += &format!(
            "[[frame]]\nname = \"f{i}\"\nvariable = {{ name = \"q{i}\", kind = \"revolute\", limits = [\"-90 deg\", \
             \"90 deg\"] }}\ntransform = \"Rz(q{i}) Tx({length}) Rx({twist} rad) Tz({offset})\"\n"
        );
    }
    let (offset, zero) = (any(0.01, 0.1), any(1e-5, 4e-4));
    text += &source("offset", "repeatable", "f1", &format!("e_x = {offset}\ne_r = {zero}"));
    text += &source("bend", "tolerance", "f2", &format!("e_y = {offset}\ne_p = {zero}"));
    text + &source("noise", "random", "f3", &format!("distribution = \"normal\"\ne_z = {offset}"))
}

fn machine(text: &str) -> Machine {
    Machine::of_spec(Spec::parse("chain.toml", text).unwrap(), "chain.toml")
}

fn study(machine: &Machine, keys: &str, workspace: &str) -> Study {
    let text = format!("[study]\ntitle = \"t\"\n{keys}\n{workspace}");
    Study::read(Document::new("study.toml", text), &machine.spec).unwrap()
}

fn analyzed(machine: &Machine, keys: &str) -> Report {
    let study = study(machine, keys, "[workspace.joints]\nsamples = 30\n");
    Analyze::new(machine.clone(), study).run(&mut ()).unwrap()
}

/// A ball with one radius adds this radius to the worst case of a chain at every configuration,
/// whatever frame it belongs to, and nothing to the orientation. It is one source of
/// every table, can be switched and scaled by its name, and `bound` finds the same.
#[test]
fn a_ball_adds_its_radius_to_a_chain() {
    let keys = "tolerance = \"1 mm\"\ncriterion = \"worst-case\"";
    for seed in 0..4 {
        let alone = chain(seed);
        let balls = ball("play", "tolerance", "f2", 0.04) + &ball("clearance", "random", "f1", 0.03);
        let with = machine(&format!("{alone}{balls}"));
        let alone = machine(&alone);
        let [without, report] = [analyzed(&alone, keys), analyzed(&with, keys)];
        let close = |a: f64, b: f64| assert!((a - b).abs() < 1e-12, "{seed}: {a}, not {b}");
        close(report.combined.worst_case_radius, without.combined.worst_case_radius + 0.07);
        close(report.orientation.worst_case_radius, without.orientation.worst_case_radius);
        let root = without.combined.radii.random_radius.powi(2) + 0.04_f64.powi(2) + 0.03_f64.powi(2);
        close(report.combined.radii.random_radius, root.sqrt());
        assert_eq!((report.sources.len(), report.orientation.sources.len()), (5, 5));
        for (name, radius) in [("play", 0.04), ("clearance", 0.03)] {
            let entry = report.ledger.sources.iter().find(|entry| entry.name == name).unwrap();
            close(entry.max, radius);
            close(entry.share.unwrap(), radius / report.combined.worst_case_radius);
        }
        let shares: f64 = report.ledger.sources.iter().filter_map(|entry| entry.share).sum();
        close(shares, 1.0);
        let budget = report.uncertainty.as_ref().unwrap();
        let play = budget.sources.iter().find(|one| one.source == "play").unwrap();
        (0..3).for_each(|row| close(play.standard_uncertainty[row], 0.04 / 5_f64.sqrt()));
        close(play.divisor, 5_f64.sqrt());
        // By its name: switched off, and half as large.
        for (off, scaled, expected) in
            [(&["play"][..], &[][..], 0.03), (&[], &["play=0.5", "clearance=2"], 0.08)]
        {
            let [off, scaled] =
                [off, scaled].map(|all| all.iter().map(|text| (*text).to_owned()).collect::<Vec<_>>());
            let mut changed = with.clone();
            changed.change(&Changes::read([&[], &[], &off, &scaled], &with.spec).unwrap());
            let changed = analyzed(&changed, keys);
            close(changed.combined.worst_case_radius, without.combined.worst_case_radius + expected);
        }
        let region = "[workspace.joints]\nmoved = [\"q2\"]\nsamples = 9\n";
        let [sampled, bound] = [
            Analyze::new(with.clone(), study(&with, keys, region))
                .run(&mut ())
                .unwrap()
                .combined
                .worst_case_radius,
            Bound::new(with.clone(), study(&with, keys, region))
                .run(&mut ())
                .unwrap()
                .total
                .norm
                .certified
                .unwrap(),
        ];
        assert!(sampled <= bound && bound < 1.1 * sampled, "{seed}: {bound}, but {sampled}");
    }
}

/// A slide with a tolerance of `a` along x and a ball of `r`: the factors x of `(1, 1)` at least
/// `1/x_1 + 1/x_2` with `a x_1 + r x_2 = T` are `T/(a + √(a r))` and `T/(r + √(a r))`.
#[test]
fn a_ball_has_one_factor() {
    let (a, r, limit) = (0.1_f64, 0.4_f64, 0.3);
    let slide = "[manipulator]\nname = \"slide\"\nlength = \"mm\"\n[[frame]]\nname = \"slide\"\nvariable = { name = \
                 \"d\", kind = \"prismatic\", limits = [0, 100] }\ntransform = \"Tx(d)\"\n";
    let text = format!("{slide}{}", source("stop", "tolerance", "slide", &format!("e_x = {a}")))
        + &ball("play", "tolerance", "slide", r);
    let machine = machine(&text);
    let asked = format!("tolerance = \"{limit} mm\"\ncriterion = \"worst-case\"");
    let study = study(&machine, &asked, "[workspace.joints]\nsamples = 3\n");
    let report = Allocate::new(machine, study).run(&mut ()).unwrap();
    let factors: Vec<(&str, f64)> = report.sources.iter().map(|one| (&*one.source, one.factor)).collect();
    let expected = [("stop", limit / (a + (a * r).sqrt())), ("play", limit / (r + (a * r).sqrt()))];
    for ((name, factor), (other, expected)) in factors.iter().zip(expected) {
        assert!(*name == other && (factor - expected).abs() < 1e-5, "{factors:?}");
    }
    assert_eq!(factors.len(), 2);
    assert!((report.sources[1].largest - r).abs() < 1e-12);
}

/// A disc of radius r in the plane of x and y: along any direction of the plane the probability of
/// being within t is `(2/π) (t √(1 − t²) + asin t)`, of being within a circle t², with t in units
/// of r.
#[test]
fn a_disc_has_its_probability() {
    let slide = "[manipulator]\nname = \"slide\"\nlength = \"mm\"\n[[frame]]\nname = \"slide\"\nvariable = { name = \
                 \"d\", kind = \"prismatic\", limits = [0, 100] }\ntransform = \"Tx(d)\"\n";
    let errors = "distribution = \"disc\"\ne_x = 0.2\ne_y = 0.2";
    let machine = machine(&format!("{slide}{}", source("journal", "random", "slide", errors)));
    let report = analyzed(&machine, "tolerance = { position = \"0.15 mm\", probability = 0.5 }");
    let verdict = report.verdicts.as_ref().unwrap().as_built.position.clone().unwrap();
    let exact = 0.75_f64.powi(2);
    assert!((verdict.compliance.probability - exact).abs() < 4.0 * verdict.compliance.error, "{verdict:?}");
    assert!((report.combined.worst_case_radius - 0.2).abs() < 1e-12);
}

/// A clearance of the joint at the end of a leg acts as an error of the leg's length, at the tool
/// and at every configuration: a ball of radius r as ± r.
#[test]
fn a_clearance_in_a_leg_is_an_error_of_its_length() {
    let legs = crate::closed_machines::hexapod(&[[0.0; 7]; 6], "");
    let keys = "criterion = \"worst-case\"";
    let study_of = |text: &str| {
        let machine = machine(&format!("{legs}{text}"));
        let workspace = "[workspace.grid]\nx = [-20, 20]\nz = [620, 640]\na = [\"-3 deg\", \"2 deg\"]\n";
        let study = study(&machine, keys, workspace);
        Analyze::new(machine, study).run(&mut ()).unwrap()
    };
    for leg in [1, 4] {
        let length = format!(
            "[[source]]\nname = \"length\"\nclass = \"tolerance\"\njoint = \"q{leg}\"\nerror = 0.05\n"
        );
        let length = study_of(&length);
        for end in ["base", "joint"] {
            let ball = study_of(&ball("clearance", "tolerance", &format!("{end} {leg}"), 0.05));
            let figures =
                |report: &Report| [report.combined.worst_case_radius, report.orientation.worst_case_radius];
            for (found, expected) in figures(&ball).into_iter().zip(figures(&length)) {
                assert!((found / expected - 1.0).abs() < 1e-9, "{end} {leg}: {found}, not {expected}");
            }
        }
    }
}
