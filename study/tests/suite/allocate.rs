//! Allocation of a tolerance over the workspaces of shipped machines.

use abbe::Class;
use abbe::analysis::sampling::norm;
use abbe::analysis::{Measurand, sweep, worst_case};
use abbe_spec::Spec;
use abbe_spec::document::Document;
use abbe_study::allocate::{Allocate, Report, printed};
use abbe_study::analyze::{Analyze, Verdict};
use abbe_study::study_file::Criterion;
use abbe_study::{Changes, Machine, Study, changed_text};

/// Returns the largest error of the machine of a study by its criterion, with any sizes of the
/// repeatable errors up to their own.
fn worst(spec: Spec, study: &Study) -> f64 {
    let mut machine = Machine::of_spec(spec, "written.toml");
    machine.change(&study.changes);
    machine.add_uncertainties();
    let is_repeatable: Vec<bool> =
        machine.spec.enabled_sources().map(|source| source.class == Class::Repeatable).collect();
    let manipulator = machine.evaluator(false);
    let workspace = study.region.workspace(&*manipulator, None).unwrap();
    let mut most = 0.0_f64;
    sweep(&*manipulator, &*workspace, &mut |row| {
        let (mut center, mut edges, mut square) = ([0.0; 3], Vec::new(), 0.0);
        for (error, is_repeatable) in row.sources.iter().zip(&is_repeatable) {
            let error = Measurand::Position.rows(error);
            match is_repeatable {
                true => {
                    center = std::array::from_fn(|i| center[i] + error[i] / 2.0);
                    edges.push(error.map(|error| error / 2.0));
                }
                false if study.criterion == Criterion::WorstCase => edges.push(error),
                false => square += norm(error).powi(2),
            }
        }
        most = most.max(norm(worst_case(center, &edges)) + square.sqrt());
    })
    .unwrap();
    most
}

fn study(machine: &Machine, tolerance: f64) -> Study {
    let mut study = Study::find(None, machine).unwrap();
    study.limit(&[format!("{tolerance} {}", machine.spec.length.symbol())], &machine.spec).unwrap();
    study
}

fn read(machine: &Machine, text: &str) -> Study {
    Study::read(Document::new("study.toml", text), &machine.spec).unwrap()
}

fn run(machine: &Machine, study: Study) -> Report {
    Allocate::new(machine.clone(), study).run(&mut ()).unwrap()
}

/// Returns the spec with changes and the factors as they are printed, written and read back.
fn written(machine: &Machine, changes: &Changes, report: &Report) -> Spec {
    let mut scaled = machine.clone();
    scaled.change(changes);
    scaled.change(&Changes::read([&[], &[], &[], &report.scales()], &machine.spec).unwrap());
    let text = changed_text(&machine.text().unwrap(), &machine.spec, &scaled.spec).unwrap();
    Spec::parse("written.toml", &text).unwrap()
}

/// Writes the factors as they are printed and reads them back: the machine keeps the tolerance, and
/// takes nearly all of it.
#[test]
fn the_written_machine_keeps_the_tolerance() {
    let both = |name| [(name, Criterion::WorstCase), (name, Criterion::RootSumOfSquares)];
    for (name, criterion) in
        ["pps", "machine3", "general6r", "puma560", "ur5", "wam", "hexapod", "palletizer"]
            .into_iter()
            .flat_map(both)
    {
        let machine = Machine::find(name).unwrap();
        if machine.spec.enabled_sources().next().is_none() {
            continue;
        }
        let mut loose = study(&machine, 1e6);
        loose.criterion = criterion;
        let as_built = worst(Spec::clone(&machine.spec), &loose);
        let tolerance = 0.4 * as_built;
        let mut study = study(&machine, tolerance);
        (study.criterion, study.unreachable) = (criterion, 1.0);
        let report = run(&machine, study.clone());
        assert!(report.residual <= 1e-9, "{name}: {:e}", report.residual);
        let written = written(&machine, &Changes::default(), &report);
        for source in &report.sources {
            let scale = if source.fixed { 1.0 } else { printed(source.factor) };
            assert_eq!(
                written.sources.iter().find(|one| one.name == source.source).unwrap().scale,
                scale,
                "{name}: {}",
                source.source
            );
        }
        let most = worst(Spec::clone(&written), &study);
        let judged = Analyze::new(Machine::of_spec(Spec::clone(&written), "written.toml"), study.clone());
        let verdicts = judged.run(&mut ()).unwrap().verdicts.unwrap();
        assert_eq!(verdicts.verdict, Verdict::Met, "{name}");
        assert!(most <= tolerance && most > 0.98 * tolerance, "{name}: {most} for {tolerance}");
        assert!(report.cost <= report.one_factor_cost * (1.0 + 1e-9), "{name}");
        let kept = run(&machine, loose);
        assert!(kept.sources.iter().all(|source| source.factor == 1.0) && kept.active.0.is_empty(), "{name}");
    }
}

const HEAD: &str = "[study]\ntitle = \"Few\"\ntolerance = \"0.5 mm\"\n\n[workspace.grid]\nd1 = [\"0 mm\", \"1000 mm\", \"2256 mm\"]\nd3 = [\"0 mm\", \"1473 mm\"]\n";

#[test]
fn a_fixed_source_stays_and_an_expensive_one_is_larger() {
    let pps = Machine::find("pps").unwrap();
    let head = HEAD.replace("0.5 mm", "0.6 mm");
    let factor = |report: &Report, name: &str| {
        report.sources.iter().find(|source| source.source == name).unwrap().factor
    };
    let plain = run(&pps, read(&pps, &head));
    let with = |cost: &str| run(&pps, read(&pps, &format!("{head}\n[allocation]\n{cost}\n")));
    let fixed = with("\"base rail curvature\" = { fixed = true }");
    assert!(factor(&plain, "base rail curvature") < 1.0);
    assert_eq!(factor(&fixed, "base rail curvature"), 1.0);
    let costly = with("\"arm deflection\" = { cost = 100, exponent = 2 }");
    assert!(factor(&costly, "arm deflection") > factor(&plain, "arm deflection"));
    let mut job = Allocate::new(pps.clone(), read(&pps, &head));
    job.loosen = true;
    let loose = job.run(&mut ()).unwrap();
    assert!(loose.cost <= plain.cost && loose.sources.iter().any(|source| source.factor > 1.0));
}

#[test]
fn a_tolerance_that_cannot_be_kept_names_the_fixed_sources() {
    let pps = Machine::find("pps").unwrap();
    let costs = "\n[allocation]\nassembly = { fixed = true }\n";
    let refused = Allocate::new(pps.clone(), read(&pps, &format!("{HEAD}{costs}"))).run(&mut ()).unwrap_err();
    assert!(refused.to_string().contains("the fixed sources alone take"), "{refused}");
    let none = HEAD.replace("tolerance = \"0.5 mm\"\n", "");
    let refused = Allocate::new(pps.clone(), read(&pps, &none)).run(&mut ()).unwrap_err();
    assert!(refused.to_string().contains("there is no tolerance to keep"), "{refused}");
}

/// Holds that both tolerances are kept, and that a source which follows another one has its factor.
#[test]
fn orientation_and_changes_count() {
    let pps = Machine::find("pps").unwrap();
    let both = HEAD.replace("\"0.5 mm\"\n", "{ position = \"0.5 mm\", orientation = \"0.1 mrad\" }\n");
    let report = run(&pps, read(&pps, &both));
    assert!(report.active.0.iter().any(|(at, _)| at.ends_with("orientation")), "{:?}", report.active);
    let mut job = Allocate::new(pps.clone(), read(&pps, HEAD));
    let changes = Changes::read([&[], &[], &["assembly".to_owned()], &[]], &pps.spec).unwrap();
    job.change(&changes);
    let report = job.run(&mut ()).unwrap();
    assert!(report.sources.iter().all(|source| source.source != "assembly"));
    let written = written(&pps, &changes, &report);
    assert!(written.enabled_sources().all(|source| source.name != "assembly"));
}

const SLIDE: &str = "[manipulator]\nname = \"slide\"\nlength = \"mm\"\n[[frame]]\nname = \"x\"\n\
    variable = { name = \"d\", kind = \"prismatic\", limits = [0, 1] }\ntransform = \"Tx(d)\"\n";

/// Checks one uniform error of ±1 mm against its closed form, and that factors by draws are met.
#[test]
fn factors_by_probability_and_yield_are_those_of_closed_forms() {
    let source = |name: &str, class: &str, error: &str| {
        format!(
            "[[source]]\nname = \"{name}\"\nclass = \"{class}\"\ndistribution = \"uniform\"\nframe = \"x\"\ne_x = \"{error}\"\n"
        )
    };
    let study = |required: &str| {
        format!(
            "[study]\ntitle = \"t\"\ntolerance = {{ position = \"0.5 mm\", {required} }}\n[workspace.grid]\nd = [0, 1]\n"
        )
    };
    let one = source("gap", "tolerance", "1 mm");
    // |x ξ| ≤ 0.5 with the probability 0.5/x.
    for required in ["probability = 0.9", "yield = 0.9"] {
        let machine =
            Machine::of_spec(Spec::parse("slide.toml", &(SLIDE.to_owned() + &one)).unwrap(), "slide.toml");
        let report = run(&machine, read(&machine, &study(required)));
        let factor = report.sources[0].factor;
        // Yield is the lower end of an interval.
        assert!(factor < 0.5 / 0.9 && factor > 0.98 * 0.5 / 0.9, "{required}: {factor}");
        assert_eq!(report.tolerance, Some(0.5));
    }
    let errors = one
        + &source("play", "random", "0.8 mm")
        + "[[source]]\nname = \"sag\"\nclass = \"repeatable\"\nframe = \"x\"\ne_x = \"-0.2 mm\"\n"
        + "[[source]]\nname = \"growth\"\nclass = \"repeatable\"\nframe = \"x\"\ne_x = \"0.3 mm\"\n";
    let machine =
        Machine::of_spec(Spec::parse("slide.toml", &(SLIDE.to_owned() + &errors)).unwrap(), "slide.toml");
    let likely = study("probability = 0.95");
    let report = run(&machine, read(&machine, &likely));
    let verdict = |without: &[&str], times: f64| {
        let mut scales = report.scales();
        scales.extend(report.sources.iter().map(|source| format!("{}={times}", source.source)));
        scales.extend(without.iter().map(|name| format!("{name}=0")));
        let mut job = Analyze::new(machine.clone(), read(&machine, &likely));
        job.change(&Changes::read([&[], &[], &[], &scales], &machine.spec).unwrap(), &mut ());
        job.run(&mut ()).unwrap().verdicts.unwrap().verdict
    };
    assert_eq!(verdict(&[], 1.0), Verdict::Met);
    // The sag counteracts the growth: without it the tolerance is kept, too.
    assert_eq!(verdict(&["sag"], 1.0), Verdict::Met);
    assert_eq!(verdict(&["sag"], 1.03), Verdict::NotMet);
    let fixed = format!("{likely}[allocation]\ngap = {{ fixed = true }}\n");
    let refused = Allocate::new(machine.clone(), read(&machine, &fixed)).run(&mut ()).unwrap_err();
    assert!(
        refused.to_string().contains("no factors keep the tolerance with the required probability"),
        "{refused}"
    );
}
