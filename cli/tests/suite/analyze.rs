//! `abbe analyze`: the figures of the paper, studies, output files.

use std::fs;

use abbe_manipulators::SHIPPED;
use serde_json::Value;
use tempfile::tempdir;

use crate::analyses::analysis;
use crate::bad_input::refused;
use crate::running::{abbe, full, json, narrow, prints, shipped, write};

/// Asserts agreement to the last printed digit.
fn near(found: &Value, expected: f64, digits: i32) {
    let found = found.as_f64().expect("a number");
    assert!((found - expected).abs() <= 0.5 * 10_f64.powi(-digits), "{found} instead of {expected}");
}

fn source<'v>(report: &'v Value, name: &str) -> &'v Value {
    let sources = report["sources"].as_array().expect("a list");
    sources.iter().find(|source| source["name"] == name).expect("this source")
}

fn axes(value: &Value, expected: [f64; 3], digits: i32) {
    for (axis, expected) in ["x", "y", "z"].into_iter().zip(expected) {
        near(&value[axis], expected, digits);
    }
}

#[test]
fn the_papers_own_job_gives_the_papers_figures() {
    let report = json(&["analyze", "pps", "--json"]);
    assert_eq!(report["manipulator"], "pps");
    assert_eq!(report["configurations"], 999);
    assert_eq!(report["unreachable"], 0);

    let rail = source(&report, "base rail curvature");
    assert_eq!(rail["class"], "repeatable");
    axes(&rail["half_peak_to_peak"], [0.2197, 0.0, 0.0774], 4);
    axes(&rail["plain_max"], [0.3341, 0.0, 0.2042], 4);
    let spin = source(&report, "spin encoder");
    assert_eq!(spin["class"], "random");
    axes(&spin["plain_max"], [0.0710, 0.0, 0.0710], 4);
    assert_eq!(spin["half_peak_to_peak"], spin["plain_max"]);
    axes(&source(&report, "arm deflection")["plain_max"], [0.120, 0.440, 0.250], 3);
    for encoder in ["lateral encoder", "vertical encoder", "longitudinal encoder"] {
        near(&source(&report, encoder)["plain_max"]["norm"], 0.04, 12);
    }
    near(&report["combined"]["random_radius"], 0.0992, 4);
    near(&report["combined"]["repeatable_radius"], 5.381, 3);
    near(&report["combined"]["radius"], 5.480, 3);
    near(&report["after_compensation"]["total"], 0.3492, 4);

    // All published figures agree but one.
    let published = report["published"].as_array().expect("a list");
    let met = published.iter().map(|figure| figure["met"].as_bool()).collect::<Vec<_>>();
    assert_eq!(met, [Some(true), Some(false), Some(true), Some(true), Some(true)]);
    assert_eq!(published[1]["figure"], "spin encoder");
    assert_eq!(published[1]["x"], 0.074);
    assert_eq!(published[1]["y"], Value::Null);
    // The neglected second-order part is far smaller than the errors, but not zero.
    let neglected = report["first_order"]["largest_difference"].as_f64().expect("a number");
    assert!((0.01..0.02).contains(&neglected), "{neglected}");
}

#[test]
fn json_has_its_keys_in_order() {
    let text = prints(&["analyze", "pps", "--json"]);
    let mut rest = text.as_str();
    for key in [
        "manipulator",
        "configurations",
        "unreachable",
        "sources",
        "name",
        "class",
        "plain_max",
        "x",
        "y",
        "z",
        "norm",
        "half_peak_to_peak",
        "relative_to_home",
        "worst",
        "d1",
        "d2",
        "d3",
        "q4",
        "q5",
        "q6",
        "combined",
        "repeatable_radius",
        "random_radius",
        "radius",
    ] {
        let at = rest.find(&format!("\"{key}\":")).unwrap_or_else(|| panic!("{key} is missing or misplaced"));
        rest = &rest[at + 1..];
    }
}

#[test]
fn people_see_the_papers_figures_beside_ours() {
    let text = full(&["analyze", "pps"]);
    let squeezed = text.lines().map(|line| line.split_whitespace().collect::<Vec<_>>().join(" "));
    let lines = squeezed.collect::<Vec<_>>();
    for expected in [
        "repeatable half peak-to-peak 0.2197 0 0.0774 0.2329",
        "frame lateral the paper 0.22 0 0.08 – met",
        "spin encoder plain maximum 0.0710 0 0.0710 0.0711",
        "random, uniform the paper 0.074 – 0.074 – misses by 4 %",
        "arm deflection plain maximum 0.1200 0.4400 0.2501 0.5190",
        "repeatable the paper 0.12 0.44 0.25 – met",
        "the paper – – – 5.48 met",
        "Reached 999, all reachable",
    ] {
        assert!(lines.iter().any(|line| line == expected), "{expected}\n{text}");
    }
    for word in ["Not reproducible from the paper", "0.000125", "560 mm", "Figures 8 to 11, 13 and 14"] {
        assert!(text.contains(word), "{word}");
    }
}

#[test]
fn every_shipped_manipulator_can_be_analyzed() {
    for shipped in SHIPPED {
        narrow(&full(&["analyze", shipped.name]));
        let report = &analysis(shipped.name).report;
        // The temperature of machine3 is evaluated at both ends of its range.
        let expected = match shipped.name {
            _ if shipped.study.is_some() => 999,
            "machine3" => 2000,
            _ => 1000,
        };
        assert_eq!(report["configurations"], expected, "{}", shipped.name);
        assert!(report["combined"]["radius"].as_f64().is_some_and(|radius| radius >= 0.0));
    }
}

#[test]
fn the_same_input_gives_the_same_bytes() {
    let (first, second) = (tempdir().unwrap(), tempdir().unwrap());
    let run = |folder: &std::path::Path, more: &[&str]| {
        let out = folder.to_str().unwrap();
        prints(&[&["analyze", "pps", "--out", out], more].concat())
    };
    assert_eq!(run(first.path(), &[]), run(second.path(), &[]));
    assert_eq!(run(first.path(), &["--json"]), run(second.path(), &["--json"]));
    for name in ["configurations.csv", "sources.csv", "unreachable.csv"] {
        let read = |folder: &tempfile::TempDir| fs::read(folder.path().join(name)).unwrap();
        assert_eq!(read(&first), read(&second), "{name}");
    }
    let left = |ending: &str| {
        let files = fs::read_dir(first.path()).unwrap().map(|file| file.unwrap().file_name());
        files.filter(|name| name.to_string_lossy().ends_with(ending)).count()
    };
    assert_eq!(
        [left(".csv"), left("")],
        [3, 12],
        "tables, the report and its figures, the record, nothing else"
    );
}

#[test]
fn files_hold_every_configuration() {
    let folder = tempdir().unwrap();
    let out = folder.path().join("new").join("folder");
    let report = json(&["analyze", "pps", "--json", "--out", out.to_str().unwrap()]);
    let mut reader = csv::Reader::from_path(out.join("configurations.csv")).unwrap();
    let headers = reader.headers().unwrap().clone();
    let column =
        |name: &str| headers.iter().position(|header| header == name).unwrap_or_else(|| panic!("{name}"));
    for name in ["configuration", "d1 (mm)", "q4 (rad)", "x (mm)", "ideal x (mm)", "assembly z (mm)"] {
        column(name);
    }
    assert!(!headers.iter().any(|header| header.starts_with("couch_mass")), "it is the same everywhere");
    let records = reader.records().collect::<Result<Vec<_>, _>>().unwrap();
    assert_eq!(records.len(), 999);

    let mut largest = 0.0;
    for (index, record) in records.iter().enumerate() {
        let number = |name: &str| record[column(name)].parse::<f64>().unwrap();
        assert_eq!(record[0], index.to_string());
        for (axis, isocentre) in [("x", 1128.0), ("y", 1626.0), ("z", 1846.0)] {
            assert!((number(&format!("ideal {axis} (mm)")) - isocentre).abs() < 1e-6);
            let repeatable = ["base rail curvature", "arm deflection", "assembly"];
            let sum = repeatable.map(|source| number(&format!("{source} {axis} (mm)"))).iter().sum::<f64>();
            assert!((sum - number(&format!("repeatable {axis} (mm)"))).abs() < 1e-12);
            let random = ["spin encoder", "lateral encoder", "vertical encoder", "longitudinal encoder"];
            let squares =
                random.map(|source| number(&format!("{source} {axis} (mm)")).powi(2)).iter().sum::<f64>();
            assert!((squares.sqrt() - number(&format!("random {axis} (mm)"))).abs() < 1e-12);
        }
        let norm = |what: &str| {
            let squares = ["x", "y", "z"].map(|axis| number(&format!("{what} {axis} (mm)")).powi(2));
            squares.iter().sum::<f64>().sqrt()
        };
        largest = f64::max(largest, norm("repeatable") + norm("random"));
    }
    let radius = report["combined"]["radius"].as_f64().unwrap();
    assert!((largest - radius).abs() < 1e-12);
}

#[test]
fn sources_can_be_switched_and_parameters_set() {
    let printed = "base rail curvature, signs as printed";
    let report = json(&[
        "analyze",
        "pps",
        "--json",
        "--disable",
        "base rail curvature",
        "--enable",
        printed,
        "--disable",
        "assembly",
    ]);
    let names = report["sources"].as_array().unwrap().iter().map(|source| source["name"].as_str().unwrap());
    assert_eq!(names.collect::<Vec<_>>()[..2], [printed, "spin encoder"]);
    // With the printed signs, the error in Z cannot be below 0.154 mm.
    assert!(source(&report, printed)["half_peak_to_peak"]["z"].as_f64().unwrap() > 0.154);

    let nominal = json(&["analyze", "pps", "--json"]);
    let softer = ["--set", "arm_EI=1.177e13 N*mm^2", "--set", "arm_GJ=1.6225e13 N*mm^2"];
    let doubled = json(&[&["analyze", "pps", "--json"], &softer[..]].concat());
    let deflection = |report| source(report, "arm deflection")["plain_max"]["norm"].as_f64().unwrap();
    assert!((deflection(&doubled) / deflection(&nominal) - 2.0).abs() < 1e-12);
    let warm = json(&["analyze", "machine3", "--json", "--set", "temperature_rise=10K"]);
    assert!(source(&warm, "thermal expansion")["plain_max"]["norm"].as_f64().unwrap() > 0.01);
}

#[test]
fn a_spec_of_ones_own_is_sampled_within_its_limits() {
    let folder = tempdir().unwrap();
    let spec = write(folder.path(), "mine.toml", shipped("pps"));
    let spec = spec.to_str().unwrap();
    // Each sample with both ends of the ranges of the three inputs.
    assert_eq!(json(&["analyze", spec, "--json"])["configurations"], 8 * 1000);

    let study = r#"
        [study]
        title = "Spin and reach"
        tolerance = "1 mm"
        set = { couch_mass = "60 kg", patient = "40 kg", patient_x = 0, patient_z = 700 }
        disable = ["assembly"]
        [workspace.grid]
        q4 = { from = "-90 deg", to = "90 deg", step = "45 deg" }
        d3 = ["0 mm", "1 m"]
    "#;
    let study = write(folder.path(), "study.toml", study);
    let report = json(&["analyze", spec, "--study", study.to_str().unwrap(), "--json"]);
    assert_eq!(report["configurations"], 10);
    assert_eq!(report["study"], "Spin and reach");
    assert_eq!(report["tolerance"], 1.0);
    assert_eq!(report["sources"].as_array().unwrap().len(), 6);
    let worst = &source(&report, "arm deflection")["worst"];
    assert_eq!((worst["d3"].as_f64(), worst["q4"].as_f64()), (Some(1000.0), Some(0.0)));
}

const OUT_OF_REACH: &str = r#"
    [study]
    title = "Beyond the travels"
    set = { patient = "300 lb", patient_x = 0, patient_z = 700 }
    [workspace.presented]
    point = ["1128 mm", "1626 mm", "1846 mm"]
    solve = ["d1", "d2", "d3"]
    tool_points = { y = ["100 mm", "900 mm"] }
    approaches = { q4 = ["0 deg", "120 deg"] }
"#;

#[test]
fn what_cannot_be_reached_is_counted_with_its_reason() {
    let folder = tempdir().unwrap();
    let study = write(folder.path(), "study.toml", OUT_OF_REACH);
    let (study, out) = (study.to_str().unwrap(), folder.path().join("out"));
    let run = ["analyze", "pps", "--study", study, "--out", out.to_str().unwrap()];
    let text = full(&run);
    assert!(
        text.contains("Reached   1, 3 unreachable: q4 outside its limits (2), d2 outside its limits (1)")
    );
    assert!(text.contains("y = 900 mm: needs d2 = -520 mm, outside its limits 0 mm … 560 mm"), "{text}");
    let report = json(&[&run[..], &["--json"]].concat());
    assert_eq!((&report["configurations"], &report["unreachable"]), (&1.into(), &3.into()));
    let mut reader = csv::Reader::from_path(out.join("unreachable.csv")).unwrap();
    assert_eq!(reader.records().count(), 3);
    // What cannot be reached does not keep a tolerance, unless the study permits it.
    for (permitted, status) in [("", 1), (", unreachable = 0.74", 1), (", unreachable = 0.75", 0)] {
        let tolerance = format!("title = \"Beyond\"\ntolerance = {{ position = \"9 mm\"{permitted} }}");
        let text = OUT_OF_REACH.replace("title = \"Beyond the travels\"", &tolerance);
        let study = write(folder.path(), "judged.toml", &text);
        let run = abbe(&["analyze", "pps", "--study", study.to_str().unwrap(), "--check"]);
        let said = run.stdout.contains("NOT MET: 3 of 4 configurations cannot be reached, tolerance 9 mm");
        assert_eq!((run.status, said), (status, status == 1), "{}", run.stdout);
        // Nor do any factors keep it there.
        let allocated = abbe(&["allocate", "pps", "--study", study.to_str().unwrap()]);
        let said = allocated.stderr.contains("3 of 4 configurations cannot be reached");
        assert_eq!((allocated.status == 2, said), (status == 1, status == 1), "{}", allocated.stderr);
    }

    let study = write(folder.path(), "far.toml", &OUT_OF_REACH.replace("1846 mm", "18 m"));
    let run = abbe(&["analyze", "pps", "--study", study.to_str().unwrap()]);
    assert_eq!((run.status, run.stdout.as_str()), (2, ""));
    assert!(run.stderr.contains("no configuration of the workspace is reachable"), "{}", run.stderr);
}

/// Every change of the spec stands in the answer, also where no source is left.
#[test]
fn changes_stand_with_the_verdict() {
    let folder = tempdir().unwrap();
    let spec =
        write(folder.path(), "an arm.toml", &shipped("ur5").replace("shoulder encoder", "shoulder of arm"));
    let spec = spec.to_str().unwrap();
    let sources = json(&["analyze", spec, "--json"])["sources"].as_array().unwrap().clone();
    let names: Vec<&str> = sources.iter().map(|source| source["name"].as_str().unwrap()).collect();
    let all: Vec<&str> = names.iter().flat_map(|name| ["--disable", *name]).collect();
    for command in ["analyze", "bound"] {
        let scaled = prints(&[command, spec, "--scale", "shoulder of arm=0.5"]);
        assert!(scaled.contains("Changed   --scale \"shoulder of arm=0.5\"\n"), "{scaled}");
        let none = prints(&[&[command, spec][..], &all].concat());
        let words = none.split_whitespace().collect::<Vec<_>>().join(" ");
        assert!(
            words.contains("No error source is enabled") && words.contains("Changed --disable"),
            "{none}"
        );
        assert!(words.contains("--disable \"shoulder of arm\""), "{none}");
        assert!(!prints(&[command, spec]).contains("Changed"));
    }
}

/// A tolerance is given without a study file, for the position and for the orientation; `bound`
/// judges by it, too.
#[test]
fn a_tolerance_may_be_given_by_an_option() {
    let run = |command: &str, options: &[&str]| abbe(&[&[command, "ur5"], options].concat());
    for (given, status) in [("1 mm", 0), ("10 um", 1)] {
        let analyzed = run("analyze", &["--tolerance", given, "--check"]);
        assert_eq!(analyzed.status, status, "{}", analyzed.stdout);
        let bounded = run("bound", &["--tolerance", given]).stdout;
        assert_eq!(bounded.contains("MET everywhere in the box"), status == 0, "{bounded}");
        assert_eq!(bounded.contains("EXCEEDED"), status == 1, "{bounded}");
    }
    let both = run("analyze", &["--tolerance", "1 mm", "--tolerance", "5 mrad"]).stdout;
    assert!(both.contains("MET in the worst case, tolerance 1 mm and 5 mrad at 1000"), "{both}");
    refused(&["analyze", "ur5", "--tolerance", "1 kg"], &["--tolerance:1:1", "length"]);
    for size in ["-1 mm", "-1 mrad", "0 mm", ""] {
        refused(
            &["analyze", "ur5", "--tolerance", size],
            &["the tolerance must be positive", "0.5 mm", "0.5 mrad"],
        );
    }
    let twice = ["analyze", "ur5", "--tolerance", "1 mm", "--tolerance", "2 mm"];
    refused(&twice, &["two tolerances of one kind"]);
}

/// The comparison with the exact chain covers random errors beside repeatable ones: 0.3 rad at 1 m,
/// and 1 mm along the arm.
#[test]
fn the_exact_chain_has_all_errors() {
    let folder = tempdir().unwrap();
    let text = "[manipulator]\nname = \"arm\"\nlength = \"mm\"\n[[frame]]\nname = \"a\"\n\
                variable = { name = \"q1\", kind = \"revolute\", limits = [\"-90 deg\", \"90 deg\"] }\n\
                transform = \"Rz(q1)\"\n[tool]\ntransform = \"Tx(1000)\"\n[[source]]\nname = \"zero\"\nclass = \"random\"\n\
                distribution = \"uniform\"\njoint = \"q1\"\nerror = \"0.3 rad\"\n[[source]]\nname = \"length\"\n\
                class = \"repeatable\"\nframe = \"a\"\ne_x = 1\n";
    let spec = write(folder.path(), "arm.toml", text);
    let found = &json(&["analyze", spec.to_str().unwrap(), "--json"])["first_order"]["largest_difference"];
    // The length is turned by the zero, which first order leaves out.
    let (along, across) = (1001.0 * (0.3_f64.cos() - 1.0), 1001.0 * 0.3_f64.sin() - 300.0);
    let found = found.as_f64().unwrap();
    assert!((found - along.hypot(across)).abs() < 1e-3, "{found}");
}

#[test]
fn a_spec_without_sources_has_nothing_to_add_up() {
    let folder = tempdir().unwrap();
    let spec = write(folder.path(), "slide.toml", SLIDE);
    let spec = spec.to_str().unwrap();
    assert!(full(&["analyze", spec]).contains("No error source is enabled"));
    let report = json(&["analyze", spec, "--json"]);
    assert_eq!(report["combined"]["radius"], 0.0);
}

const SLIDE: &str = r#"
    [manipulator]
    name = "slide"
    length = "mm"
    [[frame]]
    name = "carriage"
    variable = { name = "d", kind = "prismatic" }
    transform = "Tx(d)"
"#;

/// Published figures do not apply to a machine with changes.
#[test]
fn published_figures_are_of_the_machine_as_it_is() {
    let run = abbe(&["analyze", "pps", "--set", "arm_EI=5e13 N*mm^2"]);
    assert_eq!(run.status, 0);
    assert!(run.stderr.contains("published figures are not compared"), "{}", run.stderr);
    assert!(!run.stdout.contains("the paper  "), "{}", run.stdout);
    assert!(full(&["analyze", "pps"]).contains("the paper  "));
}
