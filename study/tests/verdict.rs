//! The verdict, and what is said of how sure it is.

use abbe::analysis::Measurand;
use abbe_codegen::document::Document;
use abbe_codegen::spec::Spec;
use abbe_study::analyze::figures::Gathered;
use abbe_study::analyze::{Analyze, Report, Verdict, contributions};
use abbe_study::{Machine, Study};

/// A slide with a repeatable error of 0.1 mm along x, and four random ones of this size and distribution in the same direction.
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

/// One repeatable and four uniform errors of T/5: the equal share at which the tolerance is met for certain.
#[test]
fn bounded_errors_are_judged_for_certain() {
    let met = report("uniform", "0.1 mm", "\"0.5001 mm\"");
    assert_eq!(met.verdict(), Some(Verdict::Met));
    assert_eq!(met.verdict_line().unwrap(), "Verdict: met");
    assert!((met.judged[0].largest.unwrap() - 0.5).abs() < 1e-12);
    assert_eq!(met.judged[0].compliance.probability, 1.0);
    let admissible = met.admissible.as_ref().unwrap();
    assert_eq!(admissible.equal_probability, 1.0);
    assert!((admissible.share.unwrap() - 0.10002).abs() < 1e-12);
    assert!(met.conclusions().iter().any(|said| said.contains("it is met for certain")));

    // The extremes are beyond it, and few draws.
    let likely = report("uniform", "0.1 mm", "\"0.4 mm\"");
    assert_eq!(likely.verdict(), Some(Verdict::MetWithProbability));
    let compliance = likely.judged[0].compliance;
    // The sum of four uniform errors is within 3 of 4 widths but for twice 1/4!/16.
    let exact = 1.0 - 1.0 / 384.0;
    assert!(
        compliance.draws.is_some()
            && (compliance.probability - exact).abs() < 4.0 * compliance.error.max(1e-4)
    );

    let asked = report("uniform", "0.1 mm", "{ position = \"0.4 mm\", probability = 0.999 }");
    assert_eq!(asked.verdict(), Some(Verdict::NotMet));
    assert!(asked.verdict_sentences()[0].contains("99.9 % are asked for"), "{:?}", asked.verdict_sentences());
}

/// Four normal errors of 0.1 mm are one of 0.2 mm, about 0.1 mm.
#[test]
fn normal_errors_have_a_probability() {
    let report = report("normal", "0.1 mm", "\"0.5 mm\"");
    // Φ(2) − Φ(−3).
    let exact = 0.977_249_868_051_820_8 - 0.001_349_898_031_630_094_6;
    let compliance = report.judged[0].compliance;
    assert!(compliance.draws.is_none() && (compliance.probability - exact).abs() < 1e-9);
    assert_eq!(report.verdict(), Some(Verdict::MetWithProbability));
    assert_eq!(report.verdict_line().unwrap(), "Verdict: met with probability 97.59 %");
    assert!(report.judged[0].largest.is_none());
    let allowed = report.conclusions().join(" ");
    // 0.9973⁴, rounded down.
    assert!(
        allowed.contains("with a probability of at least 98.92 %") && !allowed.contains("certain"),
        "{allowed}"
    );
    // All along one line: 1.960 σ, not 2.796.
    assert!(allowed.contains("within ± 0.392 mm on a line"), "{allowed}");

    let json = serde_json::to_value(&report).unwrap();
    assert_eq!(json["verdict"]["verdict"], "met-with-probability");
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
    let [judged] = &report.judged[..] else { panic!("one tolerance") };
    assert_eq!((judged.measurand, judged.verdict), (Measurand::Orientation, Verdict::NotMet));
    let json = serde_json::to_value(&report).unwrap();
    assert_eq!(json["verdict"]["orientation"]["verdict"], "not-met");
    assert!(json["verdict"]["position"].is_null());
    // What each may do alone is what it says.
    for (alone, errors) in json["orientation"]["budget"]["sources"].as_array().unwrap().iter().zip(0..) {
        let source = &report.budget.orientation.sources
            [report.budget.tighten_first_for(Measurand::Orientation)[errors]];
        if let Some(scale) = alone["alone"].as_f64() {
            assert!((scale * source.plain_max.norm - 1e-4).abs() < 1e-15);
        }
    }
    // The rows of each source are those that stand beside its position.
    for (source, turned) in json["sources"].as_array().unwrap().iter().zip(&report.budget.orientation.sources)
    {
        assert_eq!(source["orientation"][2], turned.plain_max.z);
    }
}

#[test]
fn a_tolerance_that_says_nothing_is_a_mistake() {
    let machine = Machine::find("pps").unwrap();
    for (tolerance, said) in [
        ("{}", "this tolerance says nothing"),
        ("{ probability = 0.9 }", "this tolerance says nothing"),
        ("{ position = \"0 mm\" }", "`position` must be more than zero"),
        ("{ orientation = \"-1 mrad\" }", "`orientation` must be more than zero"),
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
    let Gathered::Cloud(points) = &figures[0].data else { panic!("a cloud") };
    let (norm, _) = points.worst.as_ref().unwrap();
    let largest = report.budget.orientation.combined.radius.value;
    assert!((norm - largest).abs() < 1e-12 * largest, "{norm} {largest}");
    let json = serde_json::to_value(&report.figures).unwrap();
    assert_eq!(json["figures"][3]["asked"]["measurand"], "orientation");
}

/// An encoder at its joint: its value is the angle, its sensitivity the lever, here 100 mm.
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
    let table = contributions(&report, &report.stated[0]);
    assert_eq!(table.rows[0][1..5], ["0.3 mrad", "triangular", "√6", "0.1 mm/mrad"]);
}
