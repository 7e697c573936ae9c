//! Data that `abbe identify` refuses, or uses in part.

use super::{Bench, POINT, changed, number, path, times};
use crate::running::{abbe, json};

#[test]
fn missing_columns_are_all_named() {
    let bench = Bench::new(POINT);
    let data = bench.simulated(&["--samples", "60"]).replace("j3", "joint3").replace(",y,", ",why,");
    let data = bench.file("data.csv", &data);
    bench.refused(
        &data,
        &[
            "there is no column `j3`",
            "there is no column `y`",
            "map.toml",
            "did you mean `joint3`?",
            "did you mean `why`?",
        ],
    );
}

#[test]
fn rows_that_cannot_be_used_are_listed() {
    let bench = Bench::new(POINT);
    let text = changed(&bench.simulated(&["--samples", "80"]), |row, fields| match row {
        3 => fields[7] = String::new(),
        5 => fields[2] = "n/a".to_owned(),
        6 => fields[8] = "1e999".to_owned(),
        9 => fields.truncate(5),
        _ => {}
    });
    let twice = text.lines().nth(20).unwrap().to_owned();
    let data = bench.file("data.csv", &format!("{text}{twice}\n"));
    let report = bench.identify(&data, &[]);
    let found: Vec<(i64, &str)> = report["unusable"]
        .as_array()
        .unwrap()
        .iter()
        .map(|row| (row["line"].as_i64().unwrap(), row["reason"].as_str().unwrap()))
        .collect();
    let expected = [
        (5, "`y` is missing"),
        (7, "`j3` is `n/a`, not a number"),
        (8, "`z` is `1e999`"),
        (11, "the row ends before `j6`"),
        (82, "identical to an earlier row"),
    ];
    assert_eq!(found, expected);
    assert_eq!(report["fit"]["rows"], 76);
}

#[test]
fn units_and_signs_that_would_fit_are_named() {
    let bench = Bench::new(POINT);
    let good = bench.simulated(&["--samples", "80"]);
    let file = |change: &dyn Fn(&mut Vec<String>)| {
        bench.file("bad.csv", &changed(&good, |_, fields| change(fields)))
    };
    let metres = file(&|fields| fields[6..9].iter_mut().for_each(|field| times(field, 1e-3)));
    bench.refused(&metres, &["are the measured lengths in m, not mm?"]);
    let radians = file(&|fields| fields[..6].iter_mut().for_each(|field| times(field, 1f64.to_radians())));
    bench.refused(&radians, &["are the joint angles in rad, not deg?"]);
    for joint in [0, 2, 4] {
        let turned = file(&|fields| times(&mut fields[joint], -1.0));
        bench.refused(
            &turned,
            &[&format!("does `q{}` count in the opposite direction? set `sign = -1`", joint + 1)],
        );
    }
    // The suggested remedy works: with the sign in the map, the data fit.
    let turned = file(&|fields| times(&mut fields[2], -1.0));
    let map =
        std::fs::read_to_string(&bench.map).unwrap().replace("column = \"j3\"", "column = \"j3\", sign = -1");
    let map = bench.file("turned.toml", &map);
    let report = json(&["identify", "ur5", path(&turned), "--map", path(&map), "--json"]);
    assert!(number(&report, &["fit", "after", "rms"]) < 0.04);
}

#[test]
fn quaternions_in_the_other_order_are_noticed() {
    let pose = |order: &str| {
        format!(
            "\n[pose]\nposition = [\"x\", \"y\", \"z\"]\nunit = \"mm\"\nquaternion = {{ columns = [\"a\", \"b\", \"c\", \"d\"], order = \"{order}\" }}\n"
        )
    };
    let bench = Bench::new(&pose("wxyz"));
    let data = bench.file("data.csv", &bench.simulated(&["--samples", "80"]));
    let report = bench.identify(&data, &[]);
    assert_eq!((&report["rank"], &report["unknowns"]), (&30.into(), &48.into()));
    assert!(number(&report, &["fit", "after", "rms"]) < 0.04);
    let other = std::fs::read_to_string(&bench.map).unwrap().replace("wxyz", "xyzw");
    let other = bench.file("other.toml", &other);
    let run = abbe(&["identify", "ur5", path(&data), "--map", path(&other)]);
    assert_eq!(run.status, 2);
    assert!(run.stderr.contains("is the quaternion in the order `wxyz`?"), "{}", run.stderr);
}

#[test]
fn gross_errors_are_named_and_left_out() {
    let bench = Bench::new(POINT);
    let data = bench.simulated(&["--samples", "300", "--outliers", "0.1", "--seed", "8"]);
    let data = bench.file("data.csv", &data);
    let run = abbe(&["identify", "ur5", path(&data), "--map", path(&bench.map), "--json"]);
    assert!(run.stderr.contains("of 300 rows lie more than ten standard deviations"), "{}", run.stderr);
    assert!(run.stderr.contains("--robust tukey"));
    let report = bench.identify(&data, &["--robust", "tukey"]);
    let rejected = report["rejected"].as_array().unwrap().len();
    assert!((20..=40).contains(&rejected), "{rejected}");
    assert!((0.8..1.2).contains(&number(&report, &["uncertainty_factor"])));
}

#[test]
fn too_few_rows() {
    let bench = Bench::new(POINT);
    // Eight rows are enough for the places, two for nothing.
    let data = bench.file("data.csv", &bench.simulated(&["--samples", "8"]));
    let run = abbe(&["identify", "ur5", path(&data), "--map", path(&bench.map), "--json"]);
    let note = "24 independent values were measured (8 configurations) for 24 or more unknowns: no error of \
                the machine was fitted, only the places";
    assert!(run.status == 0 && run.stderr.contains(note), "{}", run.stderr);
    let data = bench.file("data.csv", &bench.simulated(&["--samples", "2"]));
    bench.refused(
        &data,
        &[
            "6 independent values were measured (2 configurations) for 6 or more unknowns",
            "measure at more configurations",
        ],
    );
}

#[test]
fn targets_in_line() {
    let targets: String = (0..3)
        .map(|i| format!("\n[[target]]\ncolumns = [\"x{i}\", \"y{i}\", \"z{i}\"]\nunit = \"mm\"\nposition = [\"{i}0 mm\", \"{i}0 mm\", 0]\n"))
        .collect();
    let bench = Bench::new("");
    let text = std::fs::read_to_string(&bench.map).unwrap() + &targets;
    let map = bench.file("line.toml", &text);
    let run = abbe(&["simulate", "ur5", "--map", path(&map)]);
    assert_eq!(run.status, 2);
    assert!(run.stderr.contains("these targets are collinear"), "{}", run.stderr);
    assert!(run.stderr.contains("line.toml"));
}
