//! Verdicts on tolerances and their uncertainty.

use abbe::analysis::{Compliance, Measurand, errors_at};
use abbe_report::budget;
use abbe_spec::Spec;
use abbe_spec::document::Document;
use abbe_study::analyze::figures::FigureData;
use abbe_study::analyze::{Analyze, Report, ToleranceVerdict, Verdict};
use abbe_study::{Machine, Study};

use abbe_tests::thorough;

/// Analyzes a slide with a repeatable error of 0.1 mm along x and four random errors of a size and
/// distribution in the same direction.
fn report(distribution: &str, size: &str, tolerance: &str) -> Report {
    let mut text = r#"
        [manipulator]
        name = "slide"
        length = "mm"
        [[frame]]
        name = "slide"
        variable = { name = "d1", kind = "prismatic", limits = ["0 mm", "100 mm"] }
        transform = "Tx(d1)"
        [tool]
        transform = "Ty(100)"
        [[source]]
        name = "offset"
        class = "repeatable"
        frame = "slide"
        e_x = "0.1 mm"
    "#
    .to_owned();
    for i in 1..5 {
        text += &format!(
            "[[source]]\nname = \"play {i}\"\nclass = \"random\"\ndistribution = \"{distribution}\"\nframe = \"slide\"\ne_x = \"{size}\"\n"
        );
    }
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("slide.toml");
    std::fs::write(&path, &text).unwrap();
    let machine = Machine::find(path.to_str().unwrap()).unwrap();
    let study =
        format!("[study]\ntitle = \"slide\"\ntolerance = {tolerance}\n[workspace.joints]\nsamples = 5\n");
    let spec = Spec::parse("slide.toml", &text).unwrap();
    let study = Study::read(Document::new("study.toml", study), &spec).unwrap();
    Analyze::new(machine, study).run(&mut ()).unwrap()
}

/// Returns the verdict on the only tolerance.
fn verdict(report: &Report) -> &ToleranceVerdict {
    let [verdict] = report.verdicts.as_ref().unwrap().all().collect::<Vec<_>>()[..] else {
        panic!("one tolerance")
    };
    verdict
}

/// Returns the words of all statements with a name.
fn stated(report: &Report, name: &str) -> String {
    let document = budget(report);
    let words = document.statements().filter(|(stated, _)| *stated == name).map(|(_, words)| words);
    words.collect::<Vec<_>>().join(" ")
}

/// A non-zero difference too small to print is not reported as 0.
#[test]
fn a_small_first_order_error_is_not_reported_as_0() {
    let machine = Machine::find("wam").unwrap();
    let study = Study::find(None, &machine).unwrap();
    let report = Analyze::new(machine, study).run(&mut ()).unwrap();
    assert!(report.first_order.largest > 0.0);
    let conclusions = stated(&report, "conclusion");
    assert!(conclusions.contains("by less than 0.00001 mm"), "{conclusions}");
    assert!(!conclusions.contains("by at most 0 mm"), "{conclusions}");
}

/// Nothing is certified of closed loops, and a sentence says so.
#[test]
fn nothing_is_certified_of_closed_loops() {
    let machine = Machine::find("palletizer").unwrap();
    let study = Study::find(None, &machine).unwrap();
    let report = Analyze::new(machine, study).run(&mut ()).unwrap();
    assert!(report.certified.is_none() && stated(&report, "conclusion").contains("Certified: nothing"));
}

/// One repeatable and four uniform errors of T/5 use up the tolerance in the worst case.
#[test]
fn bounded_errors_give_a_certain_verdict() {
    let met = report("uniform", "0.1 mm", "\"0.5001 mm\"");
    assert_eq!(met.verdict(), Some(Verdict::Met));
    assert_eq!(budget(&met).verdict().unwrap(), "Verdict: met in the worst case");
    assert!((verdict(&met).worst_case - 0.5).abs() < 1e-12 && verdict(&met).is_bounded);
    assert_eq!(verdict(&met).compliance.probability, 1.0);
    assert!((met.factor_for_all.unwrap() - 1.0002).abs() < 1e-12);
    assert_eq!(report("uniform", "0.1 mm", "\"0.4999 mm\"").verdict(), Some(Verdict::NotMet));

    // The sum of the extremes exceeds the tolerance, but few draws do.
    assert_eq!(report("uniform", "0.1 mm", "\"0.4 mm\"").verdict(), Some(Verdict::NotMet));
    let likely = report("uniform", "0.1 mm", "{ position = \"0.4 mm\", probability = 0.95 }");
    assert_eq!(likely.verdict(), Some(Verdict::Met));
    let compliance = verdict(&likely).compliance;
    // The sum S of the uniform errors may reach 0.3 of its 0.4 mm: P(S > 0.3 mm) = (1/2)⁴ / 4! =
    // 1/384.
    let exact = 1.0 - 1.0 / 384.0;
    assert!(
        compliance.draws.is_some()
            && (compliance.probability - exact).abs() < 4.0 * compliance.error.max(1e-4)
    );

    let asked = report("uniform", "0.1 mm", "{ position = \"0.4 mm\", probability = 0.999 }");
    assert_eq!(asked.verdict(), Some(Verdict::NotMet));
    assert!(stated(&asked, "verdict").contains("99.9 % is required"));
}

/// Four normal errors of 0.1 mm are equivalent to one of 0.2 mm, with a mean of 0.1 mm.
#[test]
fn normal_errors_have_a_probability() {
    let report = report("normal", "0.1 mm", "{ position = \"0.5 mm\", probability = 0.95 }");
    // Φ(2) − Φ(−3).
    let exact = 0.977_249_868_051_820_8 - 0.001_349_898_031_630_094_6;
    let compliance = verdict(&report).compliance;
    assert!(compliance.draws.is_none() && (compliance.probability - exact).abs() < 1e-9);
    assert_eq!(report.verdict(), Some(Verdict::Met));
    assert_eq!(budget(&report).verdict().unwrap(), "Verdict: met with probability 97.59 %");
    // In the worst case it is at 3 σ, and the sentence says so.
    let worst = self::report("normal", "0.1 mm", "\"1.31 mm\"");
    assert_eq!(budget(&worst).verdict().unwrap(), "Verdict: met in the worst case at 3 σ");
    assert!(budget(&worst).headline().contains("MET in the worst case at 3 σ, tolerance 1.31 mm"));
    assert!((verdict(&report).worst_case - 1.3).abs() < 1e-12 && !verdict(&report).is_bounded);
    let allowed = stated(&report, "conclusion");
    // All errors lie on one line: 1.960 σ instead of 2.796 σ.
    assert!(allowed.contains("within ± 0.392 mm on a line"), "{allowed}");

    let json = serde_json::to_value(&report).unwrap();
    assert_eq!(json["verdict"]["verdict"], "met");
    assert_eq!(json["verdict"]["criterion"], "probability");
    let uncertainty = &json["uncertainty"];
    let close = |value: &serde_json::Value, expected: f64| (value.as_f64().unwrap() - expected).abs() < 1e-6;
    assert!(
        close(&uncertainty["standard_uncertainty"][3], 0.2)
            && close(&uncertainty["expanded_uncertainty"][3], 0.391_993)
    );
    assert!(close(&uncertainty["bias"][3], 0.1) && close(&uncertainty["coverage"]["probability"], 0.95));
    for source in uncertainty["sources"].as_array().unwrap() {
        assert!(
            close(&source["value"], 0.1)
                && close(&source["sensitivity"][3], 1.0)
                && close(&source["share"], 0.25)
        );
        assert!(close(&source["divisor"], 1.0));
    }
}

#[test]
fn orientation_has_a_tolerance_of_its_own() {
    let machine = Machine::find("pps").unwrap();
    let mut study = Study::find(None, &machine).unwrap();
    study.tolerance = None;
    study.orientation_tolerance = Some(1e-4);
    let report = Analyze::new(machine, study).run(&mut ()).unwrap();
    let judged = verdict(&report);
    assert_eq!((judged.measurand, judged.verdict), (Measurand::Orientation, Verdict::NotMet));
    let json = serde_json::to_value(&report).unwrap();
    assert_eq!(json["verdict"]["orientation"]["verdict"], "not-met");
    assert!(json["verdict"]["position"].is_null());
    // All sources with this factor use up the tolerance, by the root sum of squares that the study
    // states.
    let orientation = &json["orientation"];
    let radius = orientation["radius"].as_f64().unwrap();
    assert!((orientation["factor_for_all"].as_f64().unwrap() * radius - 1e-4).abs() < 1e-15);
    let shares = orientation["sources"].as_array().unwrap().iter().map(|one| one["share"].as_f64().unwrap());
    assert!((shares.sum::<f64>() - 1.0).abs() < 1e-9);
    // The orientation rows of each source are in the same order as its position rows.
    for (source, turned) in json["sources"].as_array().unwrap().iter().zip(&report.budget.orientation.sources)
    {
        assert_eq!(source["orientation"][2], turned.plain_max.z);
    }
}

#[test]
fn an_empty_tolerance_is_a_mistake() {
    let machine = Machine::find("pps").unwrap();
    for (tolerance, said) in [
        ("{}", "this tolerance is empty"),
        ("{ probability = 0.9 }", "this tolerance is empty"),
        ("{ position = \"0 mm\" }", "`position` must be positive"),
        ("{ orientation = \"-1 mrad\" }", "`orientation` must be positive"),
        ("{ orientation = \"1 mm\" }", "length"),
        ("{ position = \"1 mm\", probability = 95 }", "`probability` must be between 0 and 1"),
        ("{ positon = \"1 mm\" }", "positon"),
    ] {
        let text =
            format!("[study]\ntitle = \"t\"\ntolerance = {tolerance}\n[workspace.joints]\nsamples = 5\n");
        let refused = Study::read(Document::new("study.toml", text), &machine.spec).unwrap_err().to_string();
        assert!(refused.contains(said), "{tolerance}: {refused}");
    }
}

/// A figure of the orientation shows rows 4 to 6: its largest error is that of the ledger.
#[test]
fn figures_of_the_orientation() {
    let machine = Machine::find("pps").unwrap();
    let mut text = "[study]\ntitle = \"t\"\n[workspace.joints]\nsamples = 50\n".to_owned();
    for kind in ["cloud\"", "histogram\"", "pareto\"", "travel\"\nover = \"q4\""] {
        text += &format!("[[figure]]\nkind = \"{kind}\nrows = \"orientation\"\n");
    }
    let study = Study::read(Document::new("study.toml", text), &machine.spec).unwrap();
    let mut job = Analyze::new(machine, study);
    job.figures = true;
    let report = job.run(&mut ()).unwrap();
    let figures = &report.figures.as_ref().unwrap().figures;
    let FigureData::Cloud(points) = &figures[0].data else { panic!("a cloud") };
    let (norm, _) = points.worst.as_ref().unwrap();
    let largest = report.budget.orientation.combined.radius.value;
    assert!((norm - largest).abs() < 1e-12 * largest, "{norm} {largest}");
    let json = serde_json::to_value(&report.figures).unwrap();
    assert_eq!(json["figures"][3]["request"]["measurand"], "orientation");
}

/// The value of a joint's encoder error is the angle, and its sensitivity the lever, here 100 mm.
#[test]
fn the_value_of_a_joint_is_its_angle() {
    let text = r#"
        [manipulator]
        name = "arm"
        length = "mm"
        [[frame]]
        name = "shoulder"
        variable = { name = "q1", kind = "revolute", limits = ["-90 deg", "90 deg"] }
        dh = { theta = "q1", d = 0, a = "60 mm", alpha = "90 deg" }
        [tool]
        transform = "Tx(40 mm)"
        [[source]]
        name = "encoder"
        class = "random"
        distribution = "triangular"
        joint = "q1"
        error = "0.3 mrad"
    "#;
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("arm.toml");
    std::fs::write(&path, text).unwrap();
    let machine = Machine::find(path.to_str().unwrap()).unwrap();
    let study = Study::joint_samples(&machine.spec);
    let report = Analyze::new(machine, study).run(&mut ()).unwrap();
    let json = serde_json::to_value(&report).unwrap();
    let source = &json["uncertainty"]["sources"][0];
    let close =
        |value: &serde_json::Value, expected: f64| (value.as_f64().unwrap() / expected - 1.0).abs() < 1e-9;
    assert!(close(&source["value"], 3e-4) && close(&source["sensitivity"][3], 100.0), "{source}");
    assert!(close(&source["standard_uncertainty"][3], 0.03 / 6_f64.sqrt()));
    let document = budget(&report);
    assert_eq!(
        document.rows("divisor").next().unwrap()[1..5],
        ["0.3 mrad", "triangular", "√6", "0.1 mm/mrad"]
    );
}

/// Analyzes a machine with its spec and study as texts.
fn analyzed(text: &str, study: &str) -> Report {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("machine.toml");
    std::fs::write(&path, text).unwrap();
    let machine = Machine::find(path.to_str().unwrap()).unwrap();
    let study = format!("[study]\ntitle = \"t\"\n{study}");
    let study = Study::read(Document::new("study.toml", study), &machine.spec).unwrap();
    Analyze::new(machine, study).run(&mut ()).unwrap()
}

const SLIDE: &str = r#"
    [manipulator]
    name = "slide"
    length = "mm"
    [[frame]]
    name = "slide"
    variable = { name = "d1", kind = "prismatic", limits = ["0 mm", "100 mm"] }
    transform = "Tx(d1)"
    [[source]]
    name = "scale"
    class = "repeatable"
    frame = "slide"
    e_x = "0.1 mm"
"#;

/// A magnitude of 0.5 ± 0.2 of an error of 0.1 mm gives a bias of 0.05 mm and a normal error of
/// 0.02 mm.
#[test]
fn a_magnitude_has_an_uncertainty() {
    let samples = "tolerance = \"0.0892 mm\"\n[workspace.joints]\nsamples = 5\n";
    let magnitude = "magnitude = { value = 0.5, standard_deviation = 0.2 }\n";
    let report = analyzed(&format!("{SLIDE}{magnitude}"), samples);
    let names = report.sources.iter().map(|source| source.name.clone()).collect::<Vec<_>>();
    assert_eq!(names, ["scale", "scale (its magnitude)"]);
    let budget = report.uncertainty.as_ref().unwrap();
    assert!((budget.standard_uncertainty[0] - 0.02).abs() < 1e-15 && (budget.bias[0] - 0.05).abs() < 1e-15);
    let document = self::budget(&report);
    assert_eq!(
        document.rows("divisor").next().unwrap()[..5],
        ["scale (its magnitude)", "0.2", "normal", "1", "0.1 mm"]
    );
    // Φ((0.0892 − 0.05)/0.02) = Φ(1.96); the lower limit is far away. The tolerance is no longer
    // met with certainty.
    let judged = verdict(&report);
    assert!((judged.compliance.probability - 0.975_002_1).abs() < 1e-6, "{judged:?}");
    assert!(!judged.is_bounded && (report.budget.combined.random_radius.value - 0.06).abs() < 1e-15);
    // Without a magnitude the source has its full value; disabled, it contributes nothing.
    let plain = analyzed(SLIDE, samples);
    assert_eq!((plain.sources.len(), plain.uncertainty_budgets().count()), (1, 0));
    let off = analyzed(&format!("{SLIDE}{magnitude}"), &format!("disable = [\"scale\"]\n{samples}"));
    assert!(off.sources.is_empty());
}

/// Student's t with nine degrees of freedom gives the coverage factor, in the table and in the
/// verdict.
#[test]
fn few_degrees_of_freedom_are_reported() {
    let estimated = "[[source]]\nname = \"probing\"\nclass = \"random\"\ndistribution = \"normal\"\ndegrees_of_freedom = 9\n\
                     frame = \"slide\"\ne_y = \"0.01 mm\"\n";
    let text = SLIDE.replace("0.1 mm", "0 mm") + estimated;
    let report = analyzed(&text, "tolerance = \"0.022621572 mm\"\n[workspace.joints]\nsamples = 5\n");
    let (budget, judged) = (report.uncertainty.as_ref().unwrap(), verdict(&report));
    assert!((budget.expanded_uncertainty[3] - 0.022_621_572).abs() < 1e-9);
    let document = self::budget(&report);
    assert_eq!(document.rows("divisor").next().unwrap()[6], "9");
    assert_eq!(document.rows("U = k u").nth(3).unwrap()[2], "9");
    let said = stated(&report, "uncertainty");
    assert!(said.contains("Student's t") && said.contains("(2.262 × 0.01 mm)"), "{said}");
    assert!(!said.contains("infinite degrees of freedom"), "{said}");
    let Compliance { probability, error, draws } = judged.compliance;
    assert!(draws.is_some() && (probability - 0.95).abs() < 4.0 * error, "{probability}");
    let json = serde_json::to_value(&report).unwrap();
    assert_eq!(json["uncertainty"]["sources"][0]["degrees_of_freedom"], 9.0);
    assert!(json["uncertainty"]["effective_degrees_of_freedom"][0].is_null());
}

/// The probability of the verdict is the smallest of all configurations, to 0.1 %, for arms with
/// normal sources.
#[test]
fn the_least_likely_configuration_is_found() {
    let number = |seed: u64, i: u64| {
        // Deterministic pseudo-random numbers.
        let mixed = (seed * 1000 + i).wrapping_mul(0x9E37_79B9_7F4A_7C15);
        ((mixed ^ (mixed >> 29)).wrapping_mul(0xBF58_476D_1CE4_E5B9) >> 11) as f64 / (1_u64 << 53) as f64
    };
    let mut elsewhere = 0;
    // An ordinary run has one arm, whose two configurations differ.
    for seed in if thorough() { 8..18 } else { 16..17 } {
        let n = |i: u64| 2.0 * number(seed, i) - 1.0;
        let mut text = "[manipulator]\nname = \"arm\"\nlength = \"mm\"\n".to_owned();
        for i in 0..3 {
            let motion = ["Rz", "Ry", "Rx"][(number(seed, 20 + i) * 3.0) as usize];
            text += &format!(
                "[[frame]]\nname = \"f{i}\"\nvariable = {{ name = \"q{i}\", kind = \"revolute\", limits = [\"-2 rad\", \"2 rad\"] }}\n\
                 transform = \"{motion}(q{i}) Tx({})\"\n",
                100.0 + 400.0 * number(seed, i)
            );
        }
        for i in 0..6 {
            let class = if i < 2 {
                "class = \"repeatable\""
            } else {
                "class = \"random\"\ndistribution = \"normal\""
            };
            let size = if i < 2 { 0.2 } else { 0.05 };
            text += &format!(
                "[[source]]\nname = \"s{i}\"\n{class}\nframe = \"f{}\"\ne_x = \"{:.4} mm * (1 + sin(2*q0))\"\ne_r = \"{:.4} mrad * cos(q1)\"\n",
                i % 3,
                size * (1.0 + n(30 + i)),
                size * (1.0 + n(40 + i)),
            );
        }
        let of = |tolerance: f64| {
            analyzed(
                &text,
                &format!(
                    "criterion = \"probability\"\ntolerance = \"{tolerance} mm\"\n[workspace.random]\nsamples = 250\nseed = {seed}\n"
                ),
            )
        };
        let tolerance = (0.5 + 0.5 * number(seed, 60)) * of(1.0).budget.combined.radius.value;
        let report = of(tolerance);
        let machine = Machine::of_spec(Spec::parse("arm.toml", &text).unwrap(), "arm.toml");
        let evaluator = machine.evaluator(true);
        let workspace = report.study.region.workspace(&*evaluator, None).unwrap();
        let likely = |index: usize| {
            let errors = errors_at(&*evaluator, &workspace.configuration(index).unwrap()).unwrap();
            errors.distribution(Measurand::Position, None).normal_within(tolerance)
        };
        let least = (0..workspace.len()).map(likely).fold(1.0, f64::min);
        let judged = verdict(&report);
        assert!(judged.compliance.probability < least + 1e-3, "{seed}: {judged:?}, {least}");
        elsewhere += usize::from(likely(report.budget.combined.radius.configuration.unwrap()) > least + 5e-3);
        assert!(stated(&report, "verdict").contains("the lowest of"));
    }
    // The test is meaningful only if the two configurations differ at least once.
    assert!(elsewhere > 0);
}

/// An arm whose tolerance is met by far everywhere, so that no probability tells its configurations
/// apart. `play` is the distribution of its wrist.
fn arm(play: &str, q: Option<Vec<f64>>) -> Report {
    let text = format!(
        r#"
        [manipulator]
        name = "arm"
        length = "mm"
        [[frame]]
        name = "shoulder"
        variable = {{ name = "q1", kind = "revolute", limits = ["-100 deg", "100 deg"] }}
        dh = {{ theta = "q1", d = 0, a = 455, alpha = 0 }}
        [[frame]]
        name = "elbow"
        variable = {{ name = "q2", kind = "revolute", limits = ["-120 deg", "150 deg"] }}
        dh = {{ theta = "q2", d = 0, a = 400, alpha = 0 }}
        [[frame]]
        name = "wrist"
        variable = {{ name = "q3", kind = "revolute", limits = ["-150 deg", "150 deg"] }}
        dh = {{ theta = "q3", d = 0, a = 150, alpha = 0 }}
        [[source]]
        name = "zero"
        class = "repeatable"
        joint = "q2"
        error = "0.1 mrad"
        [[source]]
        name = "length"
        class = "repeatable"
        frame = "shoulder"
        e_x = "0.1 mm"
        [[source]]
        name = "backlash"
        class = "random"
        distribution = "uniform"
        joint = "q1"
        error = "0.06 mrad"
        [[source]]
        name = "play"
        class = "random"
        distribution = "{play}"
        frame = "wrist"
        e_x = "0.01 mm"
        e_y = "0.01 mm"
        "#
    );
    let spec = Spec::parse("arm.toml", &text).unwrap();
    let study = "[study]\ntitle = \"arm\"\ntolerance = \"5 mm\"\n[workspace.joints]\nsamples = 120\n";
    let study = Study::read(Document::new("study.toml", study), &spec).unwrap();
    let mut job = Analyze::new(Machine::of_spec(spec, "arm.toml"), study);
    if let Some(q) = q {
        job.restrict(vec![q], &mut ());
    }
    job.run(&mut ()).unwrap()
}

/// Compares U95 with that of every configuration of the workspace by itself.
#[test]
fn u95_is_the_largest_of_the_workspace() {
    for play in ["normal", "uniform"] {
        let whole = arm(play, None);
        let mut largest = 0.0_f64;
        let limits = [[-100.0, 100.0], [-120.0, 150.0], [-150.0, 150.0_f64]];
        for i in 1..=120 {
            let joint = |k: usize| {
                let [lower, upper] = limits[k].map(f64::to_radians);
                lower + (upper - lower) * abbe::analysis::sampling::halton(i, k)
            };
            largest = largest.max(verdict(&arm(play, Some((0..3).map(joint).collect()))).u95);
        }
        let found = verdict(&whole).u95;
        assert!((0.995 * largest..=1.005 * largest).contains(&found), "{play}: {found}, not {largest}");
    }
}

/// A yield is of at most 10,000 configurations, which the headline and the sentence say.
#[test]
fn a_yield_says_at_how_many_configurations() {
    // Two sources, because each of 10,000 machines is drawn at each of 10,000 configurations.
    let play = "[[source]]\nname = \"play\"\nclass = \"random\"\ndistribution = \"normal\"\nframe = \"slide\"\ne_y = \"0.1 mm\"\n";
    let study = "tolerance = { position = \"5 mm\", yield = 0.9 }\n[workspace.joints]\nsamples = 12000\n";
    let report = analyzed(&format!("{SLIDE}{play}"), study);
    let document = budget(&report);
    let headline = document.headline();
    assert!(headline.starts_with("MET: yield 99.9 … 100.0 % of machines, 90 % required"), "{headline}");
    assert!(headline.ends_with("at 10000 of 12000 configurations"), "{headline}");
    assert!(stated(&report, "verdict").contains("at all of 10000 configurations"));
}
