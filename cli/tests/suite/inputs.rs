//! Inputs vary over their ranges in workspaces, ledgers, files, plans and simulations, unless they
//! are set.

use std::fs;
use std::path::Path;

use serde_json::Value;
use tempfile::tempdir;

use crate::running::{abbe, full, json, prints, write};

/// Arm of the README: it sags by `3e-5/kg * payload` at its elbow, 450 mm from the tool point.
const ARM: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../tests/examples/own-robot/specs/arm.toml");

const SAG: &str = "arm sags under its load";

fn source<'r>(report: &'r Value, name: &str) -> &'r Value {
    report["sources"].as_array().unwrap().iter().find(|source| source["name"] == name).unwrap()
}

/// Computes the sag: 3e-5/kg · payload · 450 mm.
fn sag(payload: f64) -> f64 {
    3e-5 * payload * 450.0
}

fn is(value: &Value, expected: f64) {
    let value = value.as_f64().unwrap();
    assert!((value - expected).abs() <= 1e-12 * expected.abs().max(1.0), "{value} is not {expected}");
}

fn studied(lines: &str) -> Value {
    let folder = tempdir().unwrap();
    let study = write(folder.path(), "study.toml", &format!("[study]\ntitle = \"Inputs\"\n{lines}"));
    json(&["analyze", ARM, "--study", study.to_str().unwrap(), "--json"])
}

#[test]
fn without_a_study_both_ends_are_looked_at() {
    let report = json(&["analyze", ARM, "--json"]);
    assert_eq!(report["configurations"], 2000);
    is(&source(&report, SAG)["plain_max"]["norm"], sag(5.0));
    is(&source(&report, SAG)["worst"]["payload"], 5.0);
    is(&report["combined"]["worst"]["payload"], 5.0);
    assert_eq!(report["ledger"]["sources"][0]["name"], SAG);
    // The worst configuration in JSON has the largest error.
    let at = &source(&report, SAG)["worst"];
    let q = ["d1", "q2", "q3"].map(|name| at[name].to_string()).join(",");
    let there = json(&["jacobian", ARM, "--q", &q, "--set", "payload=5kg", "--json"]);
    let turn = there["generalized_errors"][12 + 3].as_f64().unwrap();
    let moved = there["error_jacobian"][2][12 + 3].as_f64().unwrap() * turn;
    assert!((moved.abs() - sag(5.0)).abs() < 1e-12, "{moved}");

    let text = full(&["analyze", ARM]);
    assert!(text.contains("payload = 5 kg"), "{text}");
    assert!(text.contains("each with payload = 0 kg and 5 kg: 2"), "{text}");
    assert!(text.contains("payload within 0 kg … 5 kg (0 kg at home)"), "{text}");
}

#[test]
fn what_is_set_does_not_move() {
    for report in [
        json(&["analyze", ARM, "--set", "payload=2kg", "--json"]),
        studied("set = { payload = \"2 kg\" }\n[workspace.joints]\nsamples = 1000"),
    ] {
        assert_eq!(report["configurations"], 1000);
        is(&source(&report, SAG)["plain_max"]["norm"], sag(2.0));
        assert!(source(&report, SAG)["worst"].get("payload").is_none());
    }
    // `--set` overrides the study.
    let folder = tempdir().unwrap();
    let study = "[study]\ntitle = \"Inputs\"\n[workspace.grid]\nq2 = [0, 1]\npayload = [\"1 kg\", \"4 kg\"]";
    let study = write(folder.path(), "study.toml", study);
    let study = study.to_str().unwrap();
    let report = json(&["analyze", ARM, "--study", study, "--set", "payload=2kg", "--json"]);
    assert_eq!(report["configurations"], 2);
    is(&source(&report, SAG)["plain_max"]["norm"], sag(2.0));
}

#[test]
fn every_form_of_a_workspace_moves_them() {
    let grid = studied("[workspace.grid]\nq2 = [0, 1]");
    assert_eq!(grid["configurations"], 4);
    is(&source(&grid, SAG)["plain_max"]["norm"], sag(5.0));

    let named = studied(
        "[workspace.grid]\nq2 = [0, 1, 2]\npayload = { from = \"1 kg\", to = \"4 kg\", step = \"1 kg\" }",
    );
    assert_eq!(named["configurations"], 12);
    is(&source(&named, SAG)["plain_max"]["norm"], sag(4.0));
    is(&source(&named, SAG)["half_peak_to_peak"]["z"], (sag(4.0) - sag(1.0)) / 2.0);

    for form in ["joints", "random"] {
        let sampled = studied(&format!("[workspace.{form}]\nsamples = 2000"));
        assert_eq!(sampled["configurations"], 2000);
        let largest = source(&sampled, SAG)["plain_max"]["norm"].as_f64().unwrap();
        assert!(largest > 0.99 * sag(5.0) && largest < sag(5.0), "{largest}");
        let both = studied(&format!(
            "[workspace.{form}]\nsamples = 100\n[workspace.inputs]\npayload = [\"0 kg\", \"3 kg\"]"
        ));
        assert_eq!(both["configurations"], 200);
        is(&source(&both, SAG)["plain_max"]["norm"], sag(3.0));
    }

    let boxed = "[workspace.box]\nx = [700, 750]\ny = [100]\nz = [300]";
    let boxed = studied(boxed);
    assert_eq!(boxed["configurations"], 4);
    is(&source(&boxed, SAG)["plain_max"]["norm"], sag(5.0));

    let presented = "[workspace.presented]\npoint = [700, 100, 300]\nsolve = [\"d1\", \"q2\", \"q3\"]\n\
                     tool_points = { reach = [450] }\n[workspace.inputs]\npayload = [\"2 kg\"]";
    let presented = studied(presented);
    assert_eq!(presented["configurations"], 1);
    is(&source(&presented, SAG)["plain_max"]["norm"], sag(2.0));
}

#[test]
fn a_path_may_have_a_column_for_them() {
    let folder = tempdir().unwrap();
    let study = "[study]\ntitle = \"Inputs\"\n[workspace.path]\nfile = \"path.csv\"";
    let study = write(folder.path(), "study.toml", study);
    let study = study.to_str().unwrap();
    write(folder.path(), "path.csv", "q2 (deg),payload (g)\n10,1000\n20,2500\n");
    let report = json(&["analyze", ARM, "--study", study, "--json"]);
    assert_eq!(report["configurations"], 2);
    is(&source(&report, SAG)["plain_max"]["norm"], sag(2.5));
    write(folder.path(), "path.csv", "q2 (deg)\n10\n20\n");
    assert_eq!(json(&["analyze", ARM, "--study", study, "--json"])["configurations"], 4);
    write(folder.path(), "path.csv", "q2 (deg),payload (kg)\n10,1\n20,6\n");
    let refused = abbe(&["analyze", ARM, "--study", study]);
    assert!(
        refused.stderr.contains("line 3: `payload` is 6 kg, outside its range 0 kg … 5 kg"),
        "{}",
        refused.stderr
    );
}

#[test]
fn files_and_figures_have_them() {
    let folder = tempdir().unwrap();
    let out = folder.path().join("out");
    full(&["analyze", ARM, "--out", out.to_str().unwrap()]);
    let mut reader = csv::Reader::from_path(out.join("configurations.csv")).unwrap();
    let place = reader.headers().unwrap().iter().position(|name| name == "payload (kg)").unwrap();
    let payloads: Vec<String> = reader.records().map(|record| record.unwrap()[place].to_owned()).collect();
    assert_eq!(payloads.len(), 2000);
    assert!(payloads[..1000].iter().all(|value| value == "0"));
    assert!(payloads[1000..].iter().all(|value| value == "5"));
    let page = fs::read_to_string(out.join("report.html")).unwrap();
    assert!(page.contains("payload within 0 kg … 5 kg (0 kg at home)"));
    assert!(page.contains("payload (kg)"), "there is a travel over the payload");
}

#[test]
fn the_same_bytes_for_any_number_of_threads() {
    let folder = tempdir().unwrap();
    for lines in [
        "[workspace.random]\nsamples = 5000",
        "[workspace.random]\nsamples = 1000\n[workspace.inputs]\npayload = [1, 2]",
    ] {
        let lines = lines.replace("[1, 2]", "[\"1 kg\", \"2 kg\"]");
        let study = write(folder.path(), "study.toml", &format!("[study]\ntitle = \"Inputs\"\n{lines}"));
        let run = |threads: &str| {
            prints(&["analyze", ARM, "--study", study.to_str().unwrap(), "--json", "--threads", threads])
        };
        assert_eq!(run("1"), run("2"));
    }
}

#[test]
fn mistakes_have_a_place_and_a_way_out() {
    let refused = |lines: &str, expected: &[&str]| {
        let folder = tempdir().unwrap();
        let study = write(folder.path(), "study.toml", &format!("[study]\ntitle = \"Bad\"\n{lines}"));
        let run = abbe(&["analyze", ARM, "--study", study.to_str().unwrap()]);
        assert_eq!((run.status, run.stdout.as_str()), (2, ""), "{lines}");
        for expected in expected {
            assert!(run.stderr.contains(expected), "{lines}: {expected}\n{}", run.stderr);
        }
    };
    refused(
        "[workspace.grid]\nq2 = [0]\npayload = [\"2 kg\", \"7 kg\"]",
        &["`payload` goes beyond its range", "7 kg is asked for here", "0 kg … 5 kg", "study.toml:5:11"],
    );
    refused(
        "[workspace.grid]\nq2 = { from = \"-160 deg\", to = \"160 deg\", count = 5 }",
        &["`q2` goes beyond its limits", "-160° is asked for here", "-150° … 150°", "study.toml:4:6"],
    );
    refused("[workspace.grid]\npayload = [\"2 mm\"]", &["a value of `payload` must be a mass"]);
    refused(
        "[workspace.grid]\npayloads = [1]",
        &["no variable or input `payloads`", "did you mean `payload`?"],
    );
    refused(
        "[workspace.grid]\npayload = [\"2 kg\"]\n[workspace.inputs]\npayload = [\"3 kg\"]",
        &["`payload` moves twice", "take it out of `inputs` or out of `grid`"],
    );
    refused(
        "set = { payload = \"2 kg\" }\n[workspace.grid]\npayload = [\"2 kg\"]",
        &["`payload` is set, and the workspace moves it", "study.toml:3:9"],
    );
    refused("[workspace.inputs]\npayload = [\"2 kg\"]", &["a workspace has one form"]);
}

/// Writes the arm of the README with a second error that measurements can separate from the sag,
/// and its map.
fn map(folder: &Path, inputs: &str) -> String {
    let map = format!(
        "[data]\nuncertainty = \"0.01 mm\"\nbase = \"exact\"\n[joints]\nd1 = {{ column = \"d1\", unit = \"mm\" }}\n\
         q2 = {{ column = \"q2\", unit = \"deg\" }}\nq3 = {{ column = \"q3\", unit = \"deg\" }}\n{inputs}\n\
         [point]\ncolumns = [\"x\", \"y\", \"z\"]\nunit = \"mm\"\n"
    );
    write(folder, "map.toml", &map).to_str().unwrap().to_owned()
}

#[test]
fn simulations_and_plans_have_a_column_for_them() {
    let folder = tempdir().unwrap();
    let path = |name: &str| folder.path().join(name).to_str().unwrap().to_owned();
    let with = map(folder.path(), "[inputs]\npayload = { column = \"load\", unit = \"g\" }");
    let simulated = prints(&["simulate", ARM, "--map", &with, "--samples", "200", "--noise", "0.001mm"]);
    let loads = |text: &str| -> Vec<f64> {
        let mut reader = csv::Reader::from_reader(text.as_bytes());
        let place = reader.headers().unwrap().iter().position(|name| name == "load").unwrap();
        reader.records().map(|record| record.unwrap()[place].parse().unwrap()).collect()
    };
    let drawn = loads(&simulated);
    assert!(drawn.iter().all(|load| (0.0..=5000.0).contains(load)));
    let spread = drawn.iter().fold([f64::INFINITY, 0.0_f64], |[a, b], load| [a.min(*load), b.max(*load)]);
    assert!(spread[0] < 500.0 && spread[1] > 4500.0, "{spread:?}");

    // Reading back: the sag of the spec explains the simulated data for each payload.
    fs::write(path("data.csv"), &simulated).unwrap();
    let measured = json(&["measure", ARM, &path("data.csv"), "--map", &with, "--json"]);
    let explained = measured["explained"]["left_rms"].as_f64().unwrap();
    assert!((explained / (3e-6_f64).sqrt() - 1.0).abs() < 0.1, "noise alone is left: {explained}");

    let fixed = prints(&["simulate", ARM, "--map", &with, "--samples", "20", "--set", "payload=2kg"]);
    assert!(loads(&fixed).iter().all(|load| *load == 2000.0));

    let plan = |more: &[&str]| {
        full(&[&["plan", ARM, "--map", &with, "--optimal", "12", "--candidates", "40"], more].concat())
    };
    assert!(plan(&[]).contains("Inputs: payload from "), "{}", plan(&[]));
    assert!(plan(&["--set", "payload=2kg"]).contains("Inputs: payload stays at 2 kg."));

    let without = map(folder.path(), "");
    let run = abbe(&["simulate", ARM, "--map", &without, "--samples", "5"]);
    assert_eq!(run.status, 0);
    assert!(run.stderr.contains("`payload` stays at 0 kg: the map has no column for it"), "{}", run.stderr);
    assert!(run.stderr.contains("`payload = { column = \"payload\", unit = \"kg\" }`"), "{}", run.stderr);
}

/// Returns the range of a name in the table `[fitted]` of a spec, without units.
fn fitted(spec: &str, name: &str) -> [f64; 2] {
    let table = spec.split("\n[fitted]\n").nth(1).unwrap();
    let line = table.lines().find(|line| line.starts_with(&format!("{name} = "))).unwrap();
    let ends = line.split('"').skip(1).step_by(2);
    let ends: Vec<f64> = ends.map(|end| end.split(' ').next().unwrap().parse().unwrap()).collect();
    [ends[0], ends[1]]
}

#[test]
fn an_identified_spec_remembers_where_it_was_fitted() {
    let folder = tempdir().unwrap();
    let path = |name: &str| folder.path().join(name).to_str().unwrap().to_owned();
    let map = map(folder.path(), "[inputs]\npayload = { column = \"load\", unit = \"kg\" }");
    for (file, seed) in [("fit.csv", "1"), ("other.csv", "2")] {
        let (file, noise) = (path(file), "0.001mm");
        let samples = ["simulate", ARM, "--map", &map, "--samples", "60", "--noise", noise, "--seed", seed];
        fs::write(&file, prints(&samples)).unwrap();
    }
    let (found, again) = (path("found.toml"), path("again.toml"));
    full(&["identify", ARM, &path("fit.csv"), "--map", &map, "--out", &found]);
    let spec = fs::read_to_string(&found).unwrap();
    let payload = fitted(&spec, "payload");
    assert!(payload[0] >= 0.0 && payload[1] <= 5.0 && payload[0] < payload[1], "{payload:?}");

    // No warning within the fitted range; outside it, the extrapolated rows are counted.
    let inside = abbe(&["measure", &found, &path("fit.csv"), "--map", &map]);
    assert!(inside.status == 0 && !inside.stderr.contains("extrapolat"), "{}", inside.stderr);
    let ranges = ["d1", "q2", "q3", "payload"].map(|name| fitted(&spec, name));
    let scales = [1.0, 1_f64.to_radians(), 1_f64.to_radians(), 1.0];
    let mut reader = csv::Reader::from_path(path("other.csv")).unwrap();
    let outside = |record: csv::StringRecord| {
        (0..4).any(|i| {
            let value = record[i].parse::<f64>().unwrap() * scales[i];
            value < ranges[i][0] || value > ranges[i][1]
        })
    };
    let count = reader.records().filter(|record| outside(record.as_ref().unwrap().clone())).count();
    assert!(count > 0);
    for command in ["measure", "compensate"] {
        let data = path("other.csv");
        let arguments: &[&str] = match command {
            "measure" => &["measure", &found, &data, "--map", &map],
            _ => &["compensate", &found, &data, "--map", &map],
        };
        let out = path(command);
        let page = if command == "measure" { format!("{out}/report.html") } else { out.clone() };
        let option = if command == "measure" { "--out" } else { "--report" };
        let run = abbe(&[arguments, &["--full", option, &out]].concat());
        let expected = format!("{count} of 60 rows are outside the ranges");
        assert!(run.stderr.contains(&expected), "{command}: {expected}\n{}", run.stderr);
        assert!(run.stdout.contains(&expected), "{command}: {expected}\n{}", run.stdout);
        assert!(fs::read_to_string(page).unwrap().contains(&expected), "{command}: {expected}");
        assert!(run.stderr.contains("there, predictions are extrapolations"), "{}", run.stderr);
    }
    let run = abbe(&["analyze", &found, "--out", &path("analysis")]);
    assert!(run.stderr.contains("of 2000 configurations are outside the ranges"), "{}", run.stderr);
    let page = fs::read_to_string(path("analysis/report.html")).unwrap();
    assert!(page.contains("of 2000 configurations are outside the ranges"));
    assert!(run.stderr.contains("payload beyond "), "{}", run.stderr);

    // Identified again, the spec records the range of the new rows.
    full(&["identify", &found, &path("other.csv"), "--map", &map, "--out", &again]);
    let spec = fs::read_to_string(&again).unwrap();
    assert_eq!(spec.matches("[fitted]").count(), 1);
    assert_ne!(fitted(&spec, "payload"), payload);
}
