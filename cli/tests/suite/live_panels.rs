//! Live panels on the pages of `measure`, `identify` and `compensate`: their rows are those of the
//! reports, in `F_0`.

use std::fs;
use std::path::Path;

use serde_json::Value;
use tempfile::{TempDir, tempdir};

use crate::explore::{panel, without_scripts};
use crate::running::{abbe, json, prints, write};

/// Source of the chapter's arm that stands for its unknown errors.
const UNKNOWN: &str = "what nobody knows yet";
/// Place of the machine in the frame of the tracker: turned by 30° about z.
const STATION: &str = "\n[[station]]\nposition = [\"1200 mm\", \"-900 mm\", \"40 mm\"]\nquaternion = [0.2588190451, 0, 0, 0.9659258263]\n";

/// Writes the files of a chapter.
fn chapter(text: &str, folder: &Path) {
    for block in text.split("```toml\n# ").skip(1) {
        let (name, text) = block.split_once('\n').unwrap();
        write(folder, name, text.split("```").next().unwrap());
    }
}

/// Writes arm and map of the chapter, and rows that a tracker beside the machine measures.
fn measured(samples: &str) -> TempDir {
    let folder = tempdir().unwrap();
    chapter(include_str!("../../../docs/from-measurements-to-a-spec.md"), folder.path());
    let map = fs::read_to_string(folder.path().join("tracker.toml")).unwrap();
    write(folder.path(), "tracker.toml", &(map + STATION));
    let [arm, map, data] = names(folder.path());
    let out = ["--samples", samples, "--seed", "1", "--out", &data];
    prints(&[&["simulate", &arm, "--map", &map, "--enable", UNKNOWN], &out[..]].concat());
    folder
}

fn names(folder: &Path) -> [String; 3] {
    ["arm.toml", "tracker.toml", "measured.csv"].map(|name| folder.join(name).display().to_string())
}

fn vector(value: &Value) -> [f64; 3] {
    [0, 1, 2].map(|i| value[i].as_f64().unwrap())
}

fn norm(value: &Value) -> f64 {
    vector(value).iter().map(|v| v * v).sum::<f64>().sqrt()
}

/// Returns the distance of the point of a row, minus an error, from the ideal tool point there.
fn distance_from_ideal(arm: &str, panel: &Value, row: usize, error: &Value) -> f64 {
    let q = panel["configurations"]["q"][row].as_array().unwrap();
    let q = q.iter().map(|value| format!("{value}rad")).collect::<Vec<_>>().join(",");
    let pose = json(&["jacobian", arm, "--q", &q, "--json"])["pose"].clone();
    let (point, error) = (vector(&panel["residuals"]["rows"][row]["point"]), vector(error));
    let squares = (0..3).map(|i| (point[i] - error[i] - pose[i][3].as_f64().unwrap()).powi(2));
    squares.sum::<f64>().sqrt()
}

#[test]
fn rows_of_a_measurement_are_those_of_its_table() {
    let folder = measured("30");
    let [arm, map, data] = names(folder.path());
    let out = folder.path().join("out");
    let arguments = ["measure", &arm, &data, "--map", &map, "--out", out.to_str().unwrap(), "--force"];
    for (enabled, before, after) in [
        (&[][..], Value::Null, "measured − ideal"),
        (&["--enable", UNKNOWN], Value::from("measured − ideal"), "measured − predicted"),
    ] {
        prints(&[&arguments[..], enabled].concat());
        let text = fs::read_to_string(out.join("report.html")).unwrap();
        without_scripts(&text);
        let panel = panel(&text);
        let residuals = &panel["residuals"];
        assert_eq!((&residuals["before"], &residuals["after"]), (&before, &after.into()));
        let table = fs::read_to_string(out.join("errors.csv")).unwrap();
        let table: Vec<Vec<f64>> =
            table.lines().skip(1).map(|line| line.split(',').map(|v| v.parse().unwrap()).collect()).collect();
        let rows = residuals["rows"].as_array().unwrap();
        assert_eq!((rows.len(), table.len(), &residuals["count"]), (30, 30, &30.into()));
        for (i, (row, numbers)) in rows.iter().zip(&table).enumerate() {
            assert_eq!(row["line"].as_f64(), Some(numbers[0]));
            let length = |first: usize| numbers[first..first + 3].iter().map(|v| v * v).sum::<f64>().sqrt();
            // `line`, ΔX, the predicted point, and the residual.
            let ideal = if before.is_null() { &row["after"] } else { &row["before"] };
            assert!((norm(ideal) - length(1)).abs() < 1e-8, "{row}");
            if !before.is_null() {
                assert!((norm(&row["after"]) - length(7)).abs() < 1e-8, "{row}");
            }
            if i % 10 == 0 {
                assert!(distance_from_ideal(&arm, &panel, i, ideal) < 1e-6, "{row}");
            }
        }
    }
}

#[test]
fn rows_of_an_identification_have_the_errors_of_its_report() {
    for samples in ["60", "900"] {
        let folder = measured(samples);
        let [arm, map, data] = names(folder.path());
        let page = folder.path().join("page.html");
        let arguments =
            ["identify", &arm, &data, "--map", &map, "--report", page.to_str().unwrap(), "--json"];
        let report = json(&arguments);
        let text = fs::read_to_string(page).unwrap();
        without_scripts(&text);
        let panel = panel(&text);
        let residuals = &panel["residuals"];
        let rows = residuals["rows"].as_array().unwrap();
        let all: usize = samples.parse().unwrap();
        assert_eq!((rows.len(), &residuals["count"]), (if all > 400 { 300 } else { all }, &all.into()));
        let step = all / rows.len();
        for (i, row) in rows.iter().enumerate() {
            assert_eq!(row["line"], i * step + 2);
        }
        let mean = |key: &str| rows.iter().map(|row| norm(&row[key])).sum::<f64>() / rows.len() as f64;
        if step == 1 {
            for (key, of) in [("before", "base_and_tool"), ("after", "after")] {
                let expected = report["fit"][of]["mean"].as_f64().unwrap();
                assert!((mean(key) - expected).abs() < 1e-9, "{key}: {} for {expected}", mean(key));
            }
        }
        // The panel has the machine that was found, and the table below it every row.
        let names = panel["sources"].as_array().unwrap().iter().map(|source| source["name"].to_string());
        assert!(names.clone().any(|name| name.contains("identified")), "{:?}", names.collect::<Vec<_>>());
        let table = &text[text.find("Row by row").unwrap()..];
        assert!(table[..table.find("</table>").unwrap()].matches("<tr").count() == rows.len() + 1);
        // The identified errors are all that is between the point and the ideal one.
        let between = distance_from_ideal(&arm, &panel, 0, &serde_json::json!([0, 0, 0]));
        assert!(between < 2.0 && between > 0.0, "{between}");
    }
}

#[test]
fn rows_of_a_compensation_have_the_errors_of_its_report() {
    let folder = measured("20");
    let [arm, map, data] = names(folder.path());
    let page = folder.path().join("page.html");
    let enabled = ["--enable", UNKNOWN, "--report", page.to_str().unwrap(), "--json"];
    let report = abbe(&[&["compensate", &arm, &data, "--map", &map], &enabled[..]].concat());
    let report: Value = serde_json::from_str(&report.stdout).unwrap();
    let text = fs::read_to_string(page).unwrap();
    without_scripts(&text);
    let panel = panel(&text);
    assert_eq!(panel["command"], serde_json::json!(["--enable", UNKNOWN]));
    let rows = panel["residuals"]["rows"].as_array().unwrap();
    assert_eq!(rows.len(), 20);
    for (i, (row, expected)) in rows.iter().zip(report["rows"].as_array().unwrap()).enumerate() {
        assert_eq!(row["line"], expected["line"]);
        for key in ["before", "after"] {
            let expected = expected[key]["length"].as_f64().unwrap();
            assert!((norm(&row[key]) - expected).abs() < 1e-9, "{row}");
        }
        if i % 10 == 0 {
            assert!(distance_from_ideal(&arm, &panel, i, &serde_json::json!([0, 0, 0])) < 1e-9, "{row}");
        }
    }
}

/// A dial indicator reads no points: its panel has the machine without rows.
#[test]
fn instruments_that_read_no_points_have_no_vectors() {
    let folder = tempdir().unwrap();
    chapter(include_str!("../../../docs/dial-indicator.md"), folder.path());
    let [spec, map, data, out] = ["small.toml", "dial.toml", "dial.csv", "out"]
        .map(|name| folder.path().join(name).display().to_string());
    prints(&["simulate", &spec, "--map", &map, "--samples", "40", "--seed", "1", "--out", &data]);
    prints(&["measure", &spec, &data, "--map", &map, "--out", &out]);
    let text = fs::read_to_string(folder.path().join("out/report.html")).unwrap();
    without_scripts(&text);
    let panel = panel(&text);
    assert!(panel.get("residuals").is_none());
    assert!(!panel["configurations"]["q"].as_array().unwrap().is_empty());
}
