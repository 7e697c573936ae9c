//! `abbe bound`: the shape of its JSON, its text, and that no sampled error exceeds a bound.

use serde_json::Value;
use tempfile::tempdir;

use crate::bad_input::refused;
use crate::running::{abbe, full, json, prints, write};

const KINDS: [&str; 3] = ["repeatable", "random", "total"];
const ERRORS: [&str; 5] = ["norm", "x", "y", "z", "orientation"];

fn number(value: &Value) -> f64 {
    value.as_f64().unwrap_or_else(|| panic!("a number: {value}"))
}

#[test]
fn the_json_is_as_documented() {
    let report = json(&["bound", "machine3", "--json"]);
    assert_eq!((&report["manipulator"], &report["length"]), (&"machine3".into(), &"mm".into()));
    assert_eq!((number(&report["gap"]), report["complete"].as_bool()), (0.01, Some(true)));
    assert!(report["boxes"].as_u64().is_some() && report["contains_more"] == false);
    assert_eq!(report["box"]["temperature_rise"], serde_json::json!([-15.0, 15.0]));
    for kind in KINDS {
        for error in ERRORS {
            let largest = &report[kind][error];
            let (found, certified) = (number(&largest["found"]), number(&largest["certified"]));
            assert!(found <= certified && certified <= 1.01 * found + 1e-9, "{kind} {error}: {largest}");
            let at: Vec<&String> = largest["at"].as_object().unwrap().keys().collect();
            assert_eq!(at, ["x", "y", "z", "temperature_rise"]);
        }
    }
}

/// The bound of a normal source is 3σ, as in the analysis: 0.3 mm/m · 400 mm.
#[test]
fn a_normal_source_stands_at_three_standard_deviations() {
    let folder = tempdir().unwrap();
    let spec = write(
        folder.path(),
        "arm.toml",
        "[manipulator]\nname = \"arm\"\nlength = \"mm\"\n[[frame]]\nname = \"a\"\n\
         variable = { name = \"q1\", kind = \"revolute\", limits = [\"-90 deg\", \"90 deg\"] }\ntransform = \"Rz(q1)\"\n\
         [tool]\ntransform = \"Tx(400)\"\n[[source]]\nname = \"encoder\"\nclass = \"random\"\ndistribution = \"normal\"\n\
         joint = \"q1\"\nerror = \"0.1 mrad\"\n",
    );
    let norm = &json(&["bound", spec.to_str().unwrap(), "--json"])["random"]["norm"];
    assert!(number(&norm["found"]) <= 0.12 + 1e-15 && number(&norm["certified"]) >= 0.12 - 1e-15, "{norm}");
    let sampled = number(&json(&["analyze", spec.to_str().unwrap(), "--json"])["combined"]["random_radius"]);
    assert!((sampled - 0.12).abs() < 1e-12, "{sampled}");
}

/// A tolerance is met in the box only if the worst case of all signs keeps it: two errors of 0.1
/// mrad at 1 m are up to 0.2 mm. What a normal error exceeds is said.
#[test]
fn a_tolerance_is_met_by_the_worst_case() {
    let folder = tempdir().unwrap();
    let arm = |distribution: &str| {
        let source = |name: &str| {
            format!(
                "[[source]]\nname = \"{name}\"\nclass = \"random\"\ndistribution = \"{distribution}\"\n\
                 joint = \"q1\"\nerror = \"0.1 mrad\"\n"
            )
        };
        let text = format!(
            "[manipulator]\nname = \"arm\"\nlength = \"mm\"\n[[frame]]\nname = \"a\"\n\
             variable = {{ name = \"q1\", kind = \"revolute\", limits = [\"-90 deg\", \"90 deg\"] }}\n\
             transform = \"Rz(q1)\"\n[tool]\ntransform = \"Tx(1000)\"\n{}{}",
            source("encoder"),
            source("zero")
        );
        write(folder.path(), &format!("{distribution}.toml"), &text)
    };
    let verdict = |distribution: &str, tolerance: &str| {
        let study = format!(
            "[study]\ntitle = \"Arc\"\ntolerance = \"{tolerance}\"\n[workspace.joints]\nsamples = 9\n"
        );
        let study = write(folder.path(), "study.toml", &study);
        let (arm, study) = (arm(distribution), study.to_str().unwrap().to_owned());
        abbe(&["bound", arm.to_str().unwrap(), "--study", &study]).stdout.lines().next().unwrap().to_owned()
    };
    assert!(verdict("uniform", "0.15 mm").ends_with("tolerance 0.15 mm EXCEEDED: 0.2 mm found"));
    assert!(verdict("uniform", "0.201 mm").ends_with("MET everywhere in the box, to first order"));
    assert!(verdict("normal", "0.61 mm").ends_with("MET everywhere in the box at 3 σ, to first order"));
    assert!(verdict("normal", "0.5 mm").ends_with("EXCEEDED: 0.6 mm found"));
}

/// A study that exceeds the tolerance decides, although the box contains more.
#[test]
fn a_study_that_exceeds_the_tolerance_decides() {
    let text = prints(&["bound", "pps"]);
    let headline = text.split_whitespace().collect::<Vec<_>>().join(" ");
    assert!(headline.contains("tolerance 0.5 mm EXCEEDED: 5.49 mm in the study"), "{text}");
    let text = prints(&["bound", "pps", "--tolerance", "6 mm"]);
    assert!(text.contains("UNDECIDED: it is exceeded in the joint box"), "{text}");
}

/// Sampled errors lie below the bound, and close to it where the workspace is the box.
#[test]
fn nothing_that_is_sampled_exceeds_it() {
    for name in ["pps", "machine3", "puma560"] {
        let analysis = json(&["analyze", name, "--json"]);
        let bound = json(&["bound", name, "--json", "--gap", "5%"]);
        // What the analysis finds counts for the bound, too, however little it searches.
        let worst = number(&analysis["combined"]["worst_case_radius"]);
        let hasty = json(&["bound", name, "--json", "--boxes", "1"]);
        assert!(number(&hasty["total"]["norm"]["found"]) >= worst * (1.0 - 1e-9), "{name}: {worst}");
        assert!(worst <= number(&bound["total"]["norm"]["certified"]) * (1.0 + 1e-9), "{name}: {worst}");
        for (sampled, kind) in ["repeatable_radius", "random_radius", "radius"].into_iter().zip(KINDS) {
            let sampled = number(&analysis["combined"][sampled]);
            let certified = number(&bound[kind]["norm"]["certified"]);
            assert!(sampled <= certified * (1.0 + 1e-12), "{name} {kind}: {sampled} > {certified}");
            // The root sum of squares of several random errors is far below their worst case.
            let least = if kind == "repeatable" { 0.7 } else { 0.3 };
            assert!(sampled >= least * number(&bound[kind]["norm"]["found"]), "{name} {kind}: {sampled}");
            // With sources of one class only, the total is not repeated.
            if let Some(own) = analysis["certified"][kind]["certified"].as_f64() {
                assert!(sampled <= own * (1.0 + 1e-12), "{name} {kind}: {sampled} > {own}");
                assert!(own >= number(&bound[kind]["norm"]["found"]), "{name} {kind}: {own}");
            }
        }
    }
}

/// An analysis states the bound in a sentence and on its page; for chains with too many joints to
/// bound, it states nothing.
#[test]
fn an_analysis_says_it_too() {
    let folder = tempdir().unwrap();
    let words = |text: &str| text.split_whitespace().collect::<Vec<_>>().join(" ");
    let page = |name: &str, folder: &std::path::Path| {
        let said = words(&full(&["analyze", name, "--out", folder.to_str().unwrap()]));
        (said, std::fs::read_to_string(folder.join("report.html")).unwrap())
    };
    let (said, shown) = page("pps", &folder.path().join("pps"));
    let certified =
        "Certified, to first order: over the enclosing joint box, which is larger than the workspace,";
    assert!(said.contains(certified), "{said}");
    assert!(words(&shown).contains(certified), "it is on the page, too");
    let (said, _) = page("machine3", &folder.path().join("machine3"));
    assert!(said.contains("over the whole box of the workspace the worst case over all signs is at most"));
    let source = "[[source]]\nname = \"off\"\nclass = \"repeatable\"\nframe = \"1\"\ne_x = \"0.1 mm\"\n";
    let long = write(folder.path(), "long.toml", &(abbe_tests::chains::revolute_chain(33) + source));
    let (said, _) = page(long.to_str().unwrap(), &folder.path().join("long"));
    assert!(!said.contains("Certified"), "{said}");
}

/// The error at the printed configuration is the largest error found.
#[test]
fn the_place_has_the_error_that_was_found() {
    let report = json(&["bound", "general6r", "--json", "--boxes", "500"]);
    let norm = &report["repeatable"]["norm"];
    let q: Vec<String> =
        norm["at"].as_object().unwrap().values().map(|value| number(value).to_string()).collect();
    let there = json(&["jacobian", "general6r", "--q", &q.join(","), "--json"]);
    let errors: Vec<f64> = there["generalized_errors"].as_array().unwrap().iter().map(number).collect();
    let row = |i: usize| -> f64 {
        let row = there["error_jacobian"][i].as_array().unwrap().iter().map(number);
        row.zip(&errors).map(|(entry, error)| entry * error).sum()
    };
    let size = (0..3).map(|i| row(i).powi(2)).sum::<f64>().sqrt();
    assert!((size - number(&norm["found"])).abs() < 1e-9 * size, "{size} {norm}");
}

#[test]
fn the_text_says_what_is_proved() {
    let text = full(&["bound", "machine3"]);
    for part in
        ["Box: x from 0 mm to 600 mm", "at least", "at most", "no error in the box exceeds the second"]
    {
        assert!(
            text.replace('\u{a0}', " ").split_whitespace().collect::<Vec<_>>().join(" ").contains(part),
            "{part}\n{text}"
        );
    }
    // Printed bounds are rounded up.
    let report = json(&["bound", "machine3", "--json"]);
    let line = text.lines().find(|line| line.trim_start().starts_with("norm")).unwrap();
    let numbers: Vec<f64> = line.split_whitespace().filter_map(|word| word.parse().ok()).collect();
    let norm = &report["repeatable"]["norm"];
    assert!(
        numbers[0] <= number(&norm["found"]) && numbers[1] >= number(&norm["certified"]),
        "{line} {norm}"
    );
}

/// The first joint of this arm makes full turns: along x and y the error is as large as along the
/// worst direction normal to z.
#[test]
fn along_x_and_y_it_is_as_large_as_across_z() {
    let random = &json(&["bound", "ur5", "--json", "--boxes", "100000"])["random"];
    let [x, y] = ["x", "y"].map(|row| number(&random[row]["found"]));
    assert!((x - y).abs() < 1e-9 * x, "{x} {y}");
    assert!(["x", "y"].iter().all(|row| random[row]["complete"] == true), "{random}");
}

#[test]
fn what_is_not_reached_is_said() {
    let outcome = abbe(&["bound", "ur5", "--boxes", "10", "--full"]);
    assert!(outcome.stdout.contains("gap not reached"), "{}", outcome.stdout);
    assert!(outcome.stderr.contains("the bounds hold"), "{}", outcome.stderr);
    let report = json(&["bound", "ur5", "--boxes", "10", "--json"]);
    assert_eq!(report["complete"], false);
}

#[test]
fn threads_change_nothing() {
    let one = abbe(&["bound", "puma560", "--threads", "1", "--json"]).stdout;
    assert_eq!(one, abbe(&["bound", "puma560", "--threads", "3", "--json"]).stdout);
}

/// The certified remainder, the exact chain minus its first order, exceeds the sampled one, but not
/// by much. Without repeatable sources there is none.
#[test]
fn what_first_order_leaves_out_is_certified() {
    for name in ["machine3", "pps"] {
        let sampled = number(&json(&["analyze", name, "--json"])["first_order"]["largest_difference"]);
        let report = json(&["bound", name, "--json"]);
        let certified = number(&report["remainder"]["certified"]);
        assert!(sampled <= certified && certified < 3.0 * sampled, "{name}: {sampled} {certified}");
        let text = full(&["bound", name]).split_whitespace().collect::<Vec<_>>().join(" ");
        let (_, printed) = text.split_once("differs from first order by no more than ").unwrap();
        let printed: f64 = printed.split(' ').next().unwrap().parse().unwrap();
        assert!(printed >= certified && printed < 1.2 * certified, "{name}: {printed} {certified}");
    }
    assert!(json(&["bound", "puma560", "--json"])["remainder"].is_null());
    assert!(!full(&["bound", "puma560"]).contains("differs from first order"));
}

/// The remainder after compensation is bounded where the joints can compensate; elsewhere the
/// report states that they cannot.
#[test]
fn what_compensation_leaves_is_certified() {
    for (name, orients) in [("machine3", false), ("pps", true)] {
        let report = json(&["bound", name, "--json"]);
        let (before, left) = (&report["repeatable"], &report["after_one_step"]);
        let position = number(&left["position"]);
        assert!(position < 0.01 * number(&before["norm"]["found"]), "{name}: {left}");
        assert_eq!(left["orientation"].is_number(), orients, "{name}: {left}");
        let text = full(&["bound", name]).split_whitespace().collect::<Vec<_>>().join(" ");
        let (_, printed) = text.split_once("the repeatable error of the tool point is at most ").unwrap();
        let printed: f64 = printed.split(' ').next().unwrap().parse().unwrap();
        assert!(printed >= position && printed < 1.2 * position, "{name}: {printed} {position}");
    }
    let report = json(&["bound", "pps", "--json"]);
    let margin = &report["margin"];
    let certified = |place: &serde_json::Value| number(&place["norm"]["certified"]);
    assert_eq!(number(&margin["tolerance"]), 0.5);
    assert!((number(&margin["certified"]) - 0.5 + certified(&report["total"])).abs() < 1e-12, "{margin}");
    let left = 0.5 - number(&report["after_one_step"]["position"]) - certified(&report["random"]);
    assert!((number(&margin["after_one_step"]) - left).abs() < 1e-12 && left > 0.0, "{margin}");
    assert!(json(&["bound", "machine3", "--json"])["margin"].is_null());
    assert!(json(&["bound", "puma560", "--json"])["after_one_step"].is_null());
    let outcome =
        full(&["bound", "scara", "--boxes", "200"]).split_whitespace().collect::<Vec<_>>().join(" ");
    assert!(outcome.contains("compensation could not be bounded: near q1"), "{outcome}");
}

/// The dexterity is reported if requested, also for a machine without errors.
#[test]
fn dexterity_is_said_where_it_is_asked_for() {
    assert!(json(&["bound", "machine3", "--json"])["dexterity"].is_null());
    let dexterity = &json(&["bound", "machine3", "--least", "--json"])["dexterity"];
    let (certified, found) = (number(&dexterity["point"]["certified"]), number(&dexterity["point"]["found"]));
    assert!((certified - 1.0).abs() < 1e-9 && (found - 1.0).abs() < 1e-9, "{dexterity}");
    assert!(dexterity["pose"].is_null());
    // The stretched wrist of this robot is singular.
    let report = json(&["bound", "puma560", "--least", "--boxes", "2000", "--json"]);
    let pose = &report["dexterity"]["pose"];
    assert!(number(&pose["found"]) < 1e-6 && number(&pose["certified"]) == 0.0, "{pose}");
    assert!(full(&["bound", "machine3", "--least"]).contains("tool point"));
}

/// A clamped beam has a stiffness of 3 EI/L³ and is softest at full length.
#[test]
fn stiffness_is_said_where_something_gives_way() {
    assert!(json(&["bound", "machine3", "--least", "--json"])["stiffness"].is_null());
    let folder = tempdir().unwrap();
    let spec = "[manipulator]\nname = \"quill\"\nlength = \"mm\"\n\
         [[frame]]\nname = \"1\"\nvariable = { name = \"out\", kind = \"prismatic\", limits = [\"100 mm\", \"400 mm\"], home = \"100 mm\" }\n\
         transform = \"Tz(out)\"\n\
         [[source]]\nname = \"quill\"\nclass = \"repeatable\"\nframe = \"1\"\n\
         beam = { axis = \"z\", length = \"out\", EI_x = \"1.3e5 N*m^2\", EI_y = \"2e5 N*m^2\" }\n\
         [[load]]\nname = \"cuts\"\nforce = [\"10 N\", 0, 0]\nframe = \"1\"\n";
    let quill = write(folder.path(), "quill.toml", spec);
    let quill = quill.to_str().unwrap();
    let stiffness = &json(&["bound", quill, "--least", "--json"])["stiffness"];
    let exact = 3.0 * 1.3e5 / 0.4_f64.powi(3);
    let (certified, found) = (number(&stiffness["certified"]), number(&stiffness["found"]));
    assert!(certified <= exact && certified > 0.985 * exact && found < 1.01 * exact, "{stiffness}");
    assert!(json(&["bound", quill, "--json"])["stiffness"].is_null());
    let text = full(&["bound", quill, "--least"]);
    assert!(text.contains("tool point, N/mm") && text.contains("out = 400"), "{text}");

    // A force at the tool point has no lever about the spindle's axis. Nothing is found where the
    // stiffness has no number.
    let beam = "beam = { axis = \"z\", length = \"out\", EI_x = \"1.3e5 N*m^2\", EI_y = \"2e5 N*m^2\" }";
    let turns = |about_z: &str| {
        let text = spec.replace(beam, &format!("compliance = {{ diagonal = [0, 0, 0, 0, 0, {about_z}] }}"));
        write(folder.path(), "turns.toml", &text)
    };
    let bearing = turns("\"1e-6/(N*m)\"");
    assert!(json(&["bound", bearing.to_str().unwrap(), "--least", "--json"])["stiffness"].is_null());
    let nowhere = write(
        folder.path(),
        "nowhere.toml",
        &spec.replace("\"1.3e5 N*m^2\"", "\"1e5 N*m^2 * sqrt(-1 - out^2/(1 m^2))\""),
    );
    let text = full(&["bound", nowhere.to_str().unwrap(), "--least", "--boxes", "100"]);
    assert!(text.contains("0   not known   nowhere"), "{text}");
}

/// Errors identified on less than the box are certified with a warning, and unprovable bounds are
/// skipped.
#[test]
fn what_is_extrapolated_and_what_is_too_much_is_said() {
    let folder = tempdir().unwrap();
    let source = "[[source]]\nname = \"scale\"\nclass = \"repeatable\"\nframe = \"1\"\ne_x = \"0.1 mm * q1 / 1 rad\"\n";
    let chain = |frames: usize| abbe_tests::chains::revolute_chain(frames) + source;
    let ranges = |end: &str| format!("[fitted]\nq1 = [\"-150 deg\", \"{end} deg\"]\n");
    for (end, warns) in [("150", false), ("100", true)] {
        let fitted = write(folder.path(), "found.toml", &(chain(2) + &ranges(end)));
        let run = abbe(&["bound", fitted.to_str().unwrap()]);
        assert_eq!(
            (run.status, run.stderr.contains("they are extrapolated: q1 beyond -150° … 100°")),
            (0, warns),
            "{}",
            run.stderr
        );
    }
    let long = write(folder.path(), "long.toml", &chain(33));
    refused(
        &["bound", long.to_str().unwrap()],
        &["33 joints", "a bound can be computed for up to 30", "grid"],
    );
}

#[test]
fn mistakes_have_a_way_out() {
    let folder = tempdir().unwrap();
    let spec = write(
        folder.path(),
        "endless.toml",
        "[manipulator]\nname = \"endless\"\nlength = \"mm\"\n[[frame]]\nname = \"rail\"\nvariable = { name = \"d1\", kind = \"prismatic\" }\n\
         transform = \"Tx(d1)\"\n",
    );
    refused(&["bound", spec.to_str().unwrap()], &["`d1` has no limits", "add `limits` in the spec"]);
    refused(&["bound", "pps", "--gap", "0"], &["a gap must be positive"]);
    refused(&["bound", "pps", "--gap", "x%"], &["invalid float"]);
}
