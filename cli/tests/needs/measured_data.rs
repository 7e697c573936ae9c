//! `abbe identify` on published measurements of a UR5 and a WAM: fitted on the grid set, tested on
//! the random set.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use abbe_tests::needs::{Missing, Tests, measured_data};
use serde_json::Value;
use tempfile::tempdir;

pub(crate) const TESTS: Tests = &[
    ("ur5_is_as_good_as_measured", ur5_is_as_good_as_measured),
    ("wam_gains_by_terms_that_the_grid_alone_chooses", wam_gains_by_terms_that_the_grid_alone_chooses),
    ("elastic_terms_are_written_with_their_weight", elastic_terms_are_written_with_their_weight),
];

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..")
}

fn json(arguments: &[&str]) -> Value {
    let output =
        Command::new(env!("CARGO_BIN_EXE_abbe")).args(arguments).output().expect("the binary starts");
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    serde_json::from_slice(&output.stdout).expect("this is JSON")
}

fn number(report: &Value, keys: &[&str]) -> f64 {
    keys.iter().fold(report, |value, key| &value[key]).as_f64().unwrap_or_else(|| panic!("{keys:?}"))
}

/// Returns the path of a shipped map.
fn map(robot: &str) -> String {
    text(&root().join("manipulators/maps").join(format!("{robot}.toml")))
}

fn text(path: &Path) -> String {
    path.to_str().expect("a path is text").to_owned()
}

fn data(robot: &str, set: &str) -> Result<String, Missing> {
    Ok(text(&measured_data(&format!("3D_{}_uncalibrated_{set}_cleaned.csv", robot.to_uppercase()))?))
}

fn identify(robot: &str, more: &[&str]) -> Result<Value, Missing> {
    let (grid, random, map) = (data(robot, "grid")?, data(robot, "random")?, map(robot));
    let arguments = ["identify", robot, &grid, "--map", &map, "--test", &random, "--json"];
    Ok(json(&[&arguments[..], more].concat()))
}

/// Identifies with the additional terms chosen on the grid set. The written spec leaves the same
/// errors on the random set.
fn richer(robot: &str) -> Result<Value, Missing> {
    let folder = tempdir().unwrap();
    let [spec, map] = ["found.toml", "found.map.toml"].map(|name| text(&folder.path().join(name)));
    let report = identify(robot, &["--terms", "auto", "--out", &spec])?;
    let measured = json(&["measure", &spec, &data(robot, "random")?, "--map", &map, "--json"]);
    let left = number(&measured, &["explained", "left_mean"]);
    let stated = number(&report, &["test", "after", "mean"]);
    assert!((left - stated).abs() < 0.01 * stated, "{robot}: {left} by measure, {stated} by identify");
    Ok(report)
}

/// Checks the row of the README's table, rounded: as delivered, base and tool, identified, with
/// additional terms.
fn is_as_the_readme_has_it(title: &str, constants: &Value, richer: &Value) {
    let readme = fs::read_to_string(root().join("README.md")).unwrap();
    let row = readme.lines().find_map(|line| line.strip_prefix(&format!("| {title} | "))).expect("a row");
    let figures =
        [(constants, "before"), (constants, "base_and_tool"), (constants, "after"), (richer, "after")];
    for (cell, (report, key)) in row.split(" | ").zip(figures) {
        let digits = cell.split('.').nth(1).expect("a decimal").len();
        assert_eq!(cell, format!("{:.digits$}", number(report, &["test", key, "mean"])), "{title}, {key}");
    }
}

fn ur5_is_as_good_as_measured() -> Result<(), Missing> {
    let report = identify("ur5", &[])?;
    assert_eq!((&report["rank"], &report["unknowns"]), (&25.into(), &45.into()));
    for key in ["condition", "groups", "parameters", "fit", "test"] {
        assert!(!report[key].is_null(), "{key}");
    }
    let parameters = report["parameters"].as_array().unwrap();
    assert_eq!(parameters.len(), 27);
    assert!((number(&report, &["test", "before", "mean"]) - 2.565).abs() < 5e-4);
    assert!((number(&report, &["test", "base_and_tool", "mean"]) - 0.488).abs() < 1e-3);
    assert!(number(&report, &["test", "after", "mean"]) <= 0.102);
    assert!(number(&report, &["test", "after", "max"]) <= 0.160);
    let richer = richer("ur5")?;
    is_as_the_readme_has_it("UR5", &report, &richer);
    // Two directions are weakly determined: only the small offset of the target from the last axis
    // makes them observable.
    assert_eq!(report["weakly_determined"].as_array().map(Vec::len), Some(2));
    assert_eq!(parameters.iter().filter(|one| one["prior_dominated"] == true).count(), 2);
    Ok(())
}

fn wam_gains_by_terms_that_the_grid_alone_chooses() -> Result<(), Missing> {
    let report = identify("wam", &[])?;
    assert_eq!(report["rank"], 31);
    assert!(number(&report, &["test", "after", "mean"]) <= 3.10);
    let richer = richer("wam")?;
    let crossed = ["cross_validation", "after", "mean"];
    assert!(number(&richer, &crossed) < number(&report, &crossed));
    // The author of the data published 2.9178.
    assert!(number(&richer, &["test", "after", "mean"]) <= 2.80);
    // Backlash, by the direction of approach of the joints, explains most of it.
    let names = richer["terms"].as_array().unwrap().iter().map(|term| term["name"].as_str().unwrap());
    assert!(names.into_iter().any(|name| name == "q1: joint error with q1_direction"));
    is_as_the_readme_has_it("Barrett WAM", &report, &richer);
    Ok(())
}

fn elastic_terms_are_written_with_their_weight() -> Result<(), Missing> {
    let grid = data("wam", "grid")?;
    let folder = tempdir().unwrap();
    let out = text(&folder.path().join("identified.toml"));
    let map = map("wam");
    let identify = ["identify", "wam", &grid, "--map", &map, "--terms", "elastic", "--json"];
    let report = json(&[&identify[..], &["--out", &out]].concat());
    assert!(!report["terms"].as_array().unwrap().is_empty());
    let spec = fs::read_to_string(&out).unwrap();
    assert!(spec.contains("[[load]]") && spec.contains("compliance = ") && spec.starts_with("gravity = "));
    // The written spec is the fitted model, including base and tool.
    let map = text(&folder.path().join("identified.map.toml"));
    let measured = json(&["measure", &out, &grid, "--map", &map, "--json"]);
    let left = number(&measured, &["explained", "left_rms"]);
    assert!((left - number(&report, &["fit", "after", "rms"])).abs() < 1e-4, "{left}");
    Ok(())
}
