//! `abbe jacobian`: the shape of its JSON, and values computed by hand.

use serde_json::Value;

use crate::running::{abbe, json, narrow, prints};

fn entry(report: &Value, row: &str, column: &str) -> f64 {
    let index = |key: &str, name: &str| {
        let names = report[key].as_array().expect("a list of names");
        names.iter().position(|candidate| candidate == name).expect("this name")
    };
    report["error_jacobian"][index("rows", row)][index("columns", column)].as_f64().expect("a number")
}

fn near(found: f64, expected: f64) {
    assert!((found - expected).abs() < 1e-9, "{found} instead of {expected}");
}

#[test]
fn json_is_as_promised() {
    let text = prints(&["jacobian", "pps", "--json"]);
    let mut at = 0;
    for key in [
        "name",
        "length",
        "orientation",
        "q",
        "pose",
        "rows",
        "columns",
        "error_jacobian",
        "generalized_errors",
        "displacement",
        "real_pose",
    ] {
        let found = text[at..].find(&format!("\"{key}\":")).unwrap_or_else(|| panic!("{key}"));
        at += found + 1;
    }
    let report = json(&["jacobian", "pps", "--json"]);
    assert_eq!(report["name"], "pps");
    assert_eq!(report["length"], "mm");
    assert_eq!(report["orientation"], "euler-yzx");
    assert_eq!(report["rows"], serde_json::json!(["x", "y", "z", "spin", "roll", "pitch"]));
    let size = |value: &Value| value.as_array().map(Vec::len);
    assert_eq!(size(&report["pose"]), Some(4));
    assert!(report["pose"].as_array().unwrap().iter().all(|row| size(row) == Some(4)));
    assert_eq!(size(&report["columns"]), Some(36));
    assert_eq!((&report["columns"][0], &report["columns"][35]), (&"e_x1".into(), &"e_p6".into()));
    assert_eq!(size(&report["error_jacobian"]), Some(6));
    assert!(report["error_jacobian"].as_array().unwrap().iter().all(|row| size(row) == Some(36)));
    assert_eq!(size(&report["generalized_errors"]), Some(36));
}

#[test]
fn the_real_pose_is_displaced_by_the_errors() {
    let at = |patient: &str| {
        let set = format!("patient={patient}");
        json(&["jacobian", "pps", "--q", "100,300,900,70deg,1deg,-2deg", "--set", &set, "--json"])
    };
    let report = at("100kg");
    let numbers = |value: &Value| -> Vec<f64> {
        value.as_array().unwrap().iter().map(|number| number.as_f64().unwrap()).collect()
    };
    let (errors, displacement) = (numbers(&report["generalized_errors"]), numbers(&report["displacement"]));
    for (i, found) in displacement.iter().enumerate() {
        let row = numbers(&report["error_jacobian"][i]);
        let expected: f64 = row.iter().zip(&errors).map(|(entry, error)| entry * error).sum();
        near(*found, expected);
    }
    // The first-order error neglects products of errors: 5 mm and 4 mrad make micrometres.
    for (i, first_order) in displacement[..3].iter().enumerate() {
        let [ideal, real] = ["pose", "real_pose"].map(|pose| report[pose][i][3].as_f64().unwrap());
        assert!((real - ideal - first_order).abs() < 0.02 && first_order.abs() > 0.1, "row {i}");
    }
    assert_ne!(at("100kg")["real_pose"], at("0kg")["real_pose"]);
    // Without repeatable sources the machine is ideal.
    let ur5 = json(&["jacobian", "ur5", "--json"]);
    assert_eq!(ur5["real_pose"], ur5["pose"]);
    let text = prints(&["jacobian", "pps"]);
    for title in ["Error of the tool by the repeatable sources", "Real pose of the tool, by the exact chain"]
    {
        assert!(text.contains(title), "{title}");
    }
}

#[test]
fn entries_are_those_computed_by_hand() {
    // With q4 = 90° the couch points along X: the tool point is at (d1 + 850, 1346, 718 + d3).
    let report = json(&["jacobian", "pps", "--q", "0,0,0,90deg,0,0", "--json"]);
    let pose = |row: usize, column: usize| report["pose"][row][column].as_f64().unwrap();
    for (row, expected) in [850.0, 1346.0, 718.0, 1.0].into_iter().enumerate() {
        near(pose(row, 3), expected);
    }
    near(pose(2, 0), -1.0);
    // F_4 is at (0, 600, 718). Its spin moves the point by Y × (850, 746, 0), its pitch by −Z ×
    // (850, 746, 0).
    for (column, expected) in [
        ("e_x4", [0.0, 0.0, -1.0]),
        ("e_s4", [0.0, 0.0, -850.0]),
        ("e_p4", [746.0, -850.0, 0.0]),
        ("e_s1", [718.0, 0.0, -850.0]),
    ] {
        for (row, expected) in ["x", "y", "z"].into_iter().zip(expected) {
            near(entry(&report, row, column), expected);
        }
    }
    near(entry(&report, "spin", "e_s4"), 1.0);
}

#[test]
fn generalized_errors_are_the_sum_of_the_repeatable_sources() {
    let only_rail = ["--disable", "assembly", "--disable", "arm deflection", "--json"];
    let report = json(&[&["jacobian", "pps", "--q", "400,0,0,0,0,0"][..], &only_rail].concat());
    let error = |i: usize| report["generalized_errors"][i].as_f64().unwrap();
    let quarter = std::f64::consts::FRAC_PI_4;
    near(error(2), -0.000062 * 400.0 - 0.060706 * quarter.sin());
    near(error(3), 0.000062 + 0.000119 * quarter.cos());
    assert!((0..36).filter(|i| ![2, 3].contains(i)).all(|i| error(i) == 0.0));
}

#[test]
fn values_have_units_signs_and_expressions() {
    let plain = json(&["jacobian", "pps", "--q", "-10,28,1128,1.5707963267948966,0,0.02", "--json"]);
    for same in
        ["-10mm,0.028 m,1.128m,pi/2,0deg,20mrad", " -1e1 , 28.0, 1128 mm, 2*45 deg, 0, atan2(0,1)+0.02"]
    {
        assert_eq!(json(&["jacobian", "pps", "--q", same, "--json"]), plain, "{same}");
        assert_eq!(json(&["jacobian", "pps", &format!("--q={same}"), "--json"]), plain, "{same}");
    }
    let run = abbe(&["jacobian", "pps", "--q", "-10,0,0,0,0,0"]);
    assert_eq!(run.status, 0);
    assert!(run.stderr.contains("note: d1 = -10 mm is outside its limits 0 mm … 2256 mm"), "{}", run.stderr);
}

#[test]
fn parameters_can_be_set() {
    let report = json(&["jacobian", "pps", "--set", "x=0.25m", "--set", "y=-100", "--json"]);
    assert_eq!(report["pose"][0][3], 1378.0);
    assert_eq!(report["pose"][1][3], 1426.0);
}

#[test]
fn people_see_units_rows_and_columns() {
    let text = prints(&["jacobian", "puma560", "--q", "0,-45deg,0,0,30deg,0"]);
    for word in ["q2 = -45°", "m and rad, in F_0", "rotation-vector", "Frame 6: ", "e_s6", "ε of the sources"]
    {
        assert!(text.contains(word), "{word}");
    }
    narrow(&text);
}
