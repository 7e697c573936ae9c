//! Studies: workspaces of every form, compensation, draws, threads, interruption.

#[cfg(target_os = "linux")]
use std::fs;

use serde_json::Value;
use tempfile::tempdir;

#[cfg(target_os = "linux")]
use crate::running::command;
use crate::running::{abbe, full, json, narrow, prints, write};

/// Runs a study of a manipulator with further arguments.
fn study(manipulator: &str, text: &str, more: &[&str]) -> Value {
    let folder = tempdir().unwrap();
    let path = write(folder.path(), "study.toml", &format!("[study]\ntitle = \"A study\"\n{text}"));
    let arguments = &["analyze", manipulator, "--study", path.to_str().unwrap()][..];
    narrow(&prints(&[arguments, more].concat()));
    json(&[arguments, &["--json"], more].concat())
}

fn refused(text: &str, files: &[(&str, &str)], expected: &[&str]) {
    let folder = tempdir().unwrap();
    files.iter().for_each(|(name, text)| _ = write(folder.path(), name, text));
    let path = write(folder.path(), "study.toml", &format!("[study]\ntitle = \"A study\"\n{text}"));
    let run = abbe(&["analyze", "pps", "--study", path.to_str().unwrap()]);
    assert_eq!((run.status, run.stdout.as_str()), (2, ""));
    expected.iter().for_each(|expected| assert!(run.stderr.contains(expected), "{expected}\n{}", run.stderr));
}

fn number(value: &Value) -> f64 {
    value.as_f64().unwrap_or_else(|| panic!("{value} is no number"))
}

#[test]
fn random_samples_follow_from_their_seed_alone() {
    let text = "[workspace.random]\nsamples = 3000\nseed = 4\nmoved = [\"d1\", \"q4\"]";
    let own = study("pps", text, &[]);
    assert_eq!(own["configurations"], 3000);
    assert_eq!(own, study("pps", text, &["--seed", "4", "--threads", "1"]));
    assert_eq!(own, study("pps", text, &["--threads", "2"]));
    assert_ne!(own["ledger"], study("pps", text, &["--seed", "5"])["ledger"]);
    refused("[workspace.random]\nsamples = 3\nseed = -1", &[], &["`seed` must be an integer from 0"]);
    refused("[workspace.joints]\nsamples = 3\nseed = 1", &[], &["no key `seed`"]);
}

#[test]
fn a_box_is_reached_by_inverse_kinematics() {
    let puma = "[workspace.box]\nx = [0.3, 0.6]\ny = { from = -0.2, to = 0.2, count = 3 }\nz = [0.2]";
    assert_eq!(study("puma560", puma, &[])["configurations"], 6);
    let home = study("puma560", &format!("{puma}\norientation = \"home\""), &[]);
    assert!(home["configurations"].as_u64().unwrap() >= 3);
    let slides = "set = { patient = \"300 lb\", patient_x = 0, patient_z = 700 }\n[workspace.box]\nx = [1000, 1128]\ny = [1626]\nz = [1846, \"9 m\"]\nsolve = [\"d1\", \"d2\", \"d3\"]";
    let report = study("pps", slides, &[]);
    assert_eq!((&report["configurations"], &report["unreachable"]), (&2.into(), &2.into()));
    assert_eq!(report["unreachable_reasons"][0]["reason"], "d3 outside its limits");
    refused(
        "[workspace.box]\nx = [1]\ny = [1]\norientation = \"sideways\"",
        &[],
        &["`z` is missing", "\"free\" or \"home\" or \"down\" or \"up\""],
    );
    refused("[workspace.box]\nx = [1]\ny = [1]\nz = [1]\nsolve = [\"q9\"]", &[], &["no variable `q9`"]);
    // A single unreachable point.
    refused(
        "set = { patient = \"300 lb\", patient_x = 0, patient_z = 700 }\n[workspace.box]\nx = [\"90 m\"]\ny = [1626]\nz = [1568]\nsolve = [\"d1\"]",
        &[],
        &["no configuration of the workspace is reachable", "d1 outside its limits (1)"],
    );
}

#[test]
fn a_path_is_read_from_a_file_beside_the_study() {
    let folder = tempdir().unwrap();
    let text = "[study]\ntitle = \"Path\"\nset = { patient = \"300 lb\", patient_x = 0, patient_z = 700 }\n[workspace.path]\nfile = \"path.csv\"\n";
    let path = write(folder.path(), "study.toml", text);
    write(folder.path(), "path.csv", "d1 (m), q4 (deg),x\n0.038,-90,250\n# a remark\n1.128,0,0\n2.3,0,0\n");
    let arguments = ["analyze", "pps", "--study", path.to_str().unwrap()];
    let text = full(&arguments);
    narrow(&text);
    assert!(text.contains("3 configurations from path.csv") && text.contains("d1 = 2300 mm: needs d1 = "));
    let report = json(&[&arguments[..], &["--json"]].concat());
    assert_eq!((&report["configurations"], &report["unreachable"]), (&2.into(), &1.into()));
    assert_eq!(report["combined"]["worst_parameters"].as_object().unwrap().keys().collect::<Vec<_>>(), ["x"]);

    let path = "[workspace.path]\nfile = \"path.csv\"";
    refused(path, &[], &["path.csv", "study.toml:4:8"]);
    for (csv, expected) in [
        ("d9\n1", "no variable, parameter or input `d9`"),
        ("d1 (deg)\n1", "the unit of the column `d1` must be a length"),
        ("d1\n1\nfar", "line 3: `far` is not a number"),
        ("d1\nnan", "line 2: `nan` is not a number"),
        ("d1,d1\n1,2", "duplicate column `d1`"),
        ("d1,q4\n1", "found record with 1 fields"),
        ("d1\n", "it contains no configuration"),
    ] {
        refused(path, &[("path.csv", csv)], &[expected]);
    }
}

#[test]
fn compensation_leaves_shares_and_bounds() {
    let workspace = "[workspace.grid]\nq4 = { from = \"-90 deg\", to = \"90 deg\", count = 7 }\n";
    let text = format!(
        "tolerance = \"0.5 mm\"\n{workspace}[compensation]\ndefault = 0\n\"arm deflection\" = \"0.02 mm\""
    );
    let report = study("pps", &text, &[]);
    assert!((number(&report["compensation"]["residual"]) - 0.02).abs() < 1e-12);
    let random = number(&report["combined"]["random_radius"]);
    assert!((number(&report["compensation"]["total"]) - 0.02 - random).abs() < 1e-12);
    let verdict = &report["verdict"]["compensated"]["position"];
    assert_eq!(report["compensation"]["total"], verdict["radius"]);
    let compensation =
        |line: &str, expected: &[&str]| refused(&format!("{workspace}[compensation]\n{line}"), &[], expected);
    compensation("default = 2", &["a residual must be a share from 0 to 1, or a length"]);
    compensation("default = \"3 kg\"", &["a residual must be a share"]);
    compensation("\"spin encoder\" = 0.5", &["the source \"spin encoder\" is random"]);
    compensation("rail = 0.5", &["no source `rail`"]);
}

#[test]
fn the_ledger_ranks_and_the_budget_is_read_backwards() {
    let report = json(&["analyze", "pps", "--json"]);
    let sources = report["ledger"]["sources"].as_array().unwrap();
    let ranked = sources.iter().find(|source| source["rank"] == 1).unwrap();
    assert_eq!((&ranked["name"], &ranked["class"]), (&"assembly".into(), &"repeatable".into()));
    assert!((number(&ranked["share_of_tolerance"]) - number(&ranked["max"]) / 0.5).abs() < 1e-12);
    assert!(sources.iter().all(|source| number(&source["rms"]) <= number(&source["max"]) * (1.0 + 1e-12)));
    let sums = report["ledger"]["sums"].as_array().unwrap();
    assert_eq!(sums[2]["max"], report["combined"]["radius"]);

    let radius = number(&report["combined"]["radius"]);
    assert!((number(&report["factor_for_all"]) * radius - 0.5).abs() < 1e-12);
    // Shares add up to 1; a source that counteracts the others has a negative one.
    let shares = sources.iter().map(|source| number(&source["share"]));
    assert!((shares.clone().sum::<f64>() - 1.0).abs() < 1e-9 && shares.clone().any(|share| share < 0.0));
    let combined = &report["combined"];
    assert!(number(&combined["worst_case_radius"]) > radius);
    let text = full(&["analyze", "pps"]);
    assert!(text.contains("random: standard deviation"), "{text}");
}

#[test]
fn draws_are_the_same_for_a_seed_and_any_number_of_threads() {
    let run = |more: &[&str]| json(&[&["analyze", "pps", "--json", "--monte-carlo", "20000"], more].concat());
    let report = run(&["--threads", "1"]);
    assert_eq!(report, run(&["--threads", "2", "--seed", "0"]));
    assert_ne!(report["monte_carlo"], run(&["--seed", "1"])["monte_carlo"]);
    let worst = &report["monte_carlo"]["worst"];
    let radius = number(&report["combined"]["radius"]);
    assert!(
        number(&worst["largest"]) < radius + 0.02 && number(&worst["quantiles"][0]["value"]) > 0.9 * radius
    );
    for manipulator in ["pps", "puma560", "machine3"] {
        narrow(&full(&["analyze", manipulator, "--monte-carlo", "100"]));
    }
    for bad in [["--monte-carlo", "0"], ["--monte-carlo", "1e3"], ["--threads", "0"], ["--seed", "-1"]] {
        let run = abbe(&[&["analyze", "pps"], &bad[..]].concat());
        assert_eq!((run.status, run.stdout.as_str()), (2, ""), "{bad:?}");
    }
}

#[test]
fn first_order_that_is_too_coarse_is_a_warning() {
    let folder = tempdir().unwrap();
    let text = include_str!("../../../manipulators/studies/pps.toml");
    let path =
        write(folder.path(), "study.toml", &text.replace("tolerance = \"0.5 mm\"", "tolerance = \"0.1 mm\""));
    let run = abbe(&["analyze", "pps", "--study", path.to_str().unwrap(), "--json"]);
    assert_eq!(run.status, 0);
    assert!(
        run.stderr.starts_with("warning: first order differs from the exact chain by up to 0.01"),
        "{}",
        run.stderr
    );
    assert_eq!(abbe(&["analyze", "pps"]).stderr, "");
    // Random sources alone are compared at their bounds.
    assert!(full(&["analyze", "puma560"]).contains("J_e ε of the random sources at their bounds"));
}

#[test]
fn a_large_study_streams() {
    let report = study("pps", "[workspace.random]\nsamples = 20000", &[]);
    assert_eq!(report["configurations"], 20_000);
    let checked = report["first_order"]["configurations"].as_u64().unwrap();
    assert!((1900..=2100).contains(&checked), "{checked}");
}

#[cfg(target_os = "linux")]
#[test]
fn an_interruption_leaves_no_half_written_file() {
    use std::process::Command;

    use abbe_tests::processes::{has_ended, wait_for};

    let folder = tempdir().unwrap();
    let text = "[study]\ntitle = \"Endless\"\n[workspace.random]\nsamples = 1e9";
    let path = write(folder.path(), "study.toml", text);
    let out = folder.path().join("out");
    let arguments = ["analyze", "pps", "--study", path.to_str().unwrap(), "--out", out.to_str().unwrap()];
    let mut child = command(&arguments).spawn().unwrap();
    // The file under construction has no name, but the process has it open.
    let open = format!("/proc/{}/fd", child.id());
    let is_written = || {
        let files = fs::read_dir(&open).into_iter().flatten().flatten();
        let ours = files.filter(|file| fs::read_link(file.path()).is_ok_and(|path| path.starts_with(&out)));
        ours.filter_map(|file| fs::metadata(file.path()).ok()).any(|file| file.len() > 0)
    };
    wait_for("an open file with rows", || is_written() || has_ended(child.id()));
    Command::new("kill").args(["-INT", &child.id().to_string()]).status().unwrap();
    assert_eq!(child.wait().unwrap().code(), Some(130));
    assert!(!out.exists());
}

/// Position figures and verdicts do not depend on the representation of orientations:
/// configurations at singular Euler angles count. The orientation figures leave them out, and the
/// report says so.
#[test]
fn euler_singularities_count_for_the_position() {
    let folder = tempdir().unwrap();
    let file = |name: &str, text: &str| write(folder.path(), name, text).to_str().unwrap().to_owned();
    // The slide turns the tool a little, so that the general search solves for it, and only its
    // home is singular.
    let spec = |orientation: &str| {
        let text = format!(
            "[manipulator]\nname = \"gantry\"\nlength = \"mm\"\norientation = \"{orientation}\"\n\
             [[frame]]\nname = \"ring\"\nvariable = {{ name = \"q1\", kind = \"revolute\", limits = [\"-180 deg\", \"180 deg\"] }}\ntransform = \"Rz(q1) Tx(1000)\"\n\
             [[frame]]\nname = \"snout\"\nvariable = {{ name = \"d2\", kind = \"prismatic\", limits = [\"-300 mm\", \"300 mm\"] }}\ntransform = \"Tx(d2) Ry(d2/(1e5 mm))\"\n\
             [[source]]\nname = \"sag\"\nclass = \"repeatable\"\nframe = \"ring\"\ne_y = \"0.4 mm*cos(q1)\"\ne_r = \"2e-4*sin(q1)\"\n\
             [[source]]\nname = \"play\"\nclass = \"random\"\ndistribution = \"uniform\"\nframe = \"snout\"\ne_x = 0.05\ne_p = 1e-4\n"
        );
        file(&format!("{orientation}.toml"), &text)
    };
    let (euler, vector) = (spec("euler-yzx"), spec("rotation-vector"));
    let study = |tolerance: &str, workspace: &str| {
        file(
            "study.toml",
            &format!("[study]\ntitle = \"All around\"\ntolerance = {tolerance}\n[workspace.{workspace}\n"),
        )
    };
    let ring = "grid]\nq1 = { from = \"-180 deg\", to = \"180 deg\", step = \"2 deg\" }\nd2 = [\"-300 mm\", \"0 mm\", \"300 mm\"]";
    let reach = "box]\nx = [\"0 mm\"]\ny = [\"1000 mm\"]\nz = [\"0 mm\"]";
    for (workspace, count, oriented) in [(ring, 543, 541), (reach, 1, 0)] {
        let study = study("\"0.5 mm\"", workspace);
        let [a, b] = [&euler, &vector].map(|spec| json(&["analyze", spec, "--study", &study, "--json"]));
        let figures = |report: &Value| -> Vec<f64> {
            let mut figures = Vec::new();
            for source in report["sources"].as_array().unwrap() {
                for metric in ["plain_max", "half_peak_to_peak", "relative_to_home"] {
                    figures
                        .extend(["x", "y", "z", "norm"].map(|axis| source[metric][axis].as_f64().unwrap()));
                }
            }
            let radii = ["repeatable_radius", "random_radius", "radius"];
            figures.extend(radii.map(|radius| report["combined"][radius].as_f64().unwrap()));
            figures.push(report["verdict"]["position"]["worst_case"].as_f64().unwrap());
            figures
        };
        assert!(figures(&a).iter().zip(figures(&b)).all(|(a, b)| (a - b).abs() < 1e-12), "{a}\n{b}");
        assert_eq!(a["verdict"]["verdict"], b["verdict"]["verdict"]);
        assert_eq!((&a["configurations"], &a["unreachable"]), (&Value::from(count), &Value::from(0)));
        assert_eq!(a["orientation"]["configurations"], oriented);
        assert_eq!(b["orientation"]["configurations"], count);
        let text = prints(&["analyze", &euler, "--study", &study]);
        let sentence = format!("Euler angles are singular at {} of {count}", count - oriented);
        assert!(text.contains(&sentence), "{text}");
    }
    // Rows 4–6 of the other configurations decide on a tolerance of the orientation; without any
    // there is no verdict.
    let study_of = |workspace| study("{ orientation = \"2 mrad\" }", workspace);
    let text = full(&["analyze", &euler, "--study", &study_of(ring)]);
    assert!(text.contains("of 541 configurations") && text.contains("Over the 541 configurations"), "{text}");
    let run = abbe(&["analyze", &euler, "--study", &study_of(reach)]);
    assert_eq!((run.status, run.stdout.as_str()), (2, ""));
    assert!(run.stderr.contains("no orientation error to compare"), "{}", run.stderr);
}

/// The verdict is the first line, and `--check` makes it the exit status.
#[test]
fn a_verdict_is_an_exit_status() {
    let folder = tempdir().unwrap();
    let run = |tolerance: &str, more: &[&str]| {
        let text = format!("[study]\ntitle = \"A study\"\n{tolerance}[workspace.joints]\nsamples = 20\n");
        let path = write(folder.path(), "study.toml", &text);
        abbe(&[&["analyze", "pps", "--study", path.to_str().unwrap()], more].concat())
    };
    let missed = run("tolerance = \"0.5 mm\"\n", &["--check"]);
    assert_eq!(missed.status, 1, "{}", missed.stderr);
    assert!(
        missed.stdout.contains(": NOT MET in the worst case, tolerance 0.5 mm at 20 configurations\n"),
        "{}",
        missed.stdout
    );
    assert_eq!(run("tolerance = \"0.5 mm\"\n", &[]).status, 0);
    let met = run("tolerance = { position = \"20 mm\", orientation = \"20 mrad\" }\n", &["--check"]);
    assert_eq!(met.status, 0, "{}", met.stderr);
    assert!(
        met.stdout.contains(": MET in the worst case, tolerance 20 mm and 20 mrad at 20"),
        "{}",
        met.stdout
    );
    // One of two tolerances suffices to miss.
    let turned = run("tolerance = { position = \"20 mm\", orientation = \"0.02 mrad\" }\n", &["--check"]);
    assert_eq!(turned.status, 1);
    let none = run("", &["--check"]);
    assert_eq!((none.status, none.stdout.as_str()), (2, ""));
    assert!(none.stderr.contains("the study has no tolerance"), "{}", none.stderr);
    assert!(!run("", &[]).stdout.contains("Verdict"));
}

/// Rows 4 to 6 have figures; the budget and the draws are on the page and in a file.
#[test]
fn a_report_says_what_it_covers() {
    let folder = tempdir().unwrap();
    let text = "[study]\ntitle = \"A study\"\ntolerance = \"0.5 mm\"\n[workspace.joints]\nsamples = 20\n\
                [[figure]]\nkind = \"cloud\"\nrows = \"orientation\"\n[[figure]]\nkind = \"pareto\"\nrows = \"orientation\"\n";
    let path = write(folder.path(), "study.toml", text);
    let out = folder.path().join("out");
    let study = path.to_str().unwrap();
    full(&["analyze", "pps", "--study", study, "--monte-carlo", "500", "--out", out.to_str().unwrap()]);
    let page = std::fs::read_to_string(out.join("report.html")).unwrap();
    let places = ["Verdict: not met", "Each source alone", "Rows 4 to 6 of ΔX in mrad", "Uncertainty budget"]
        .map(|title| page.find(title).unwrap_or_else(|| panic!("{title}")));
    assert!(places.is_sorted(), "{places:?}");
    for figure in ["cloud-orientation.svg", "pareto-orientation.svg"] {
        let svg = std::fs::read_to_string(out.join(figure)).unwrap();
        assert!(svg.contains("mrad") && !svg.contains(" mm<"), "{figure}");
    }
    // A header, then three quantiles, the largest norm, mean and standard deviation at both
    // configurations.
    let drawn = std::fs::read_to_string(out.join("monte_carlo.csv")).unwrap();
    assert_eq!(drawn.lines().count(), 1 + 2 * 6);
    let sources = std::fs::read_to_string(out.join("sources.csv")).unwrap();
    assert!(sources.contains("random standard deviation") && sources.contains("worst case"));
}

/// A study beside the spec is named in a note, and ignored if a study is given.
#[test]
fn a_study_beside_the_spec() {
    let folder = tempdir().unwrap();
    let spec = write(folder.path(), "arm.toml", &crate::readme::spec());
    let study = |title: &str| format!("[study]\ntitle = \"{title}\"\n[workspace.joints]\nsamples = 5\n");
    let other = write(folder.path(), "other.toml", &study("Another"));
    let spec = spec.to_str().unwrap();
    let without = abbe(&["analyze", spec]);
    assert!(without.stdout.contains("No study") && without.stderr.is_empty(), "{}", without.stderr);
    write(folder.path(), "arm.study.toml", &study("Beside"));
    let beside = abbe(&["analyze", spec]);
    assert!(beside.stdout.contains("Study     Beside\n"), "{}", beside.stdout);
    let note =
        format!("note: using the study {} beside the spec\n", folder.path().join("arm.study.toml").display());
    assert_eq!(beside.stderr, note);
    let given = abbe(&["analyze", spec, "--study", other.to_str().unwrap()]);
    assert!(given.stdout.contains("Study     Another\n") && given.stderr.is_empty(), "{}", given.stderr);
}
