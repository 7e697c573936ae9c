//! `abbe measure`, `abbe plan` and `abbe simulate`.

use std::fs;
use std::path::Path;

use tempfile::tempdir;

use crate::running::{abbe, full, json, narrow, prints, write};
use crate::workshop::Workshop;

fn path(path: &Path) -> &str {
    path.to_str().expect("a path is text")
}

#[test]
fn the_papers_plan_has_450_rows() {
    let folder = tempdir().unwrap();
    let plan = folder.path().join("plan.csv");
    let report = json(&["plan", "pps", "--map", "pps", "--sets", "pps", "--out", path(&plan), "--json"]);
    assert_eq!(report["rows"], 450);
    assert_eq!((&report["sets"][0]["rows"], &report["sets"][1]["rows"]), (&112.into(), &338.into()));
    let text = fs::read_to_string(&plan).unwrap();
    let heading = "d1,d2,d3,q4,weight,centre_x,centre_z";
    assert_eq!((text.lines().next(), text.lines().count()), (Some(heading), 451));
    // Half of the rows without weight, half with 154 lb at the centre of the treatment area.
    let loaded = text.lines().filter(|line| line.ends_with(",69.85322498,0,850")).count();
    let empty = text.lines().filter(|line| line.ends_with(",0,0,850")).count();
    assert_eq!((empty, loaded), (225, 225), "{text}");
    narrow(&full(&["plan", "pps", "--map", "pps", "--sets", "pps"]));
}

#[test]
fn chosen_poses_tell_more_than_as_many_others() {
    let folder = tempdir().unwrap();
    let best = json(&["plan", "ur5", "--map", "ur5", "--optimal", "30", "--json"]);
    let sets =
        "[plan]\ntitle = \"any\"\n\n[[set]]\nname = \"samples\"\nworkspace.joints = { samples = 30 }\n";
    let sets = write(folder.path(), "sets.toml", sets);
    let any = json(&["plan", "ur5", "--map", "ur5", "--sets", path(&sets), "--json"]);
    let mean = |report: &serde_json::Value| report["predicted"]["mean"].as_f64().unwrap();
    assert_eq!(best["rows"], 30);
    assert!(mean(&best) < mean(&any));
    let run = abbe(&["plan", "ur5", "--map", "ur5", "--optimal", "5"]);
    assert_eq!(run.status, 2);
    assert!(run.stderr.contains("too few configurations"), "{}", run.stderr);
    let run = abbe(&["plan", "ur5", "--map", "ur5", "--optimal", "50", "--candidates", "1"]);
    assert_eq!(run.status, 2);
    assert!(run.stderr.contains("cannot choose 50 configurations from 1 samples"), "{}", run.stderr);
}

/// The best set by one criterion is worse by the other; predictions include the model error.
#[test]
fn criteria_and_the_models_own_error() {
    let plan = |more: &[&str]| {
        json(
            &[&["plan", "puma560", "--map", "ur5", "--optimal", "30", "--candidates", "200", "--json"], more]
                .concat(),
        )
    };
    let (v, d) = (plan(&[]), plan(&["--criterion", "d"]));
    let number = |report: &serde_json::Value, name: &str| report[name].as_f64().unwrap();
    let rms = |report: &serde_json::Value| number(&report["predicted"], "rms");
    assert!(rms(&v) < rms(&d) && number(&v, "log_det") < number(&d, "log_det"));
    assert!(v["title"].as_str().unwrap().starts_with("V-optimal: 30 of 200"), "{}", v["title"]);
    let with = plan(&["--model-error", "0.2mm"]);
    assert!(rms(&with) > 0.2 * 1e-3 && number(&with, "model_error") == 2e-4, "{}", with["predicted"]);
}

#[test]
fn simulated_rows_are_the_same_every_time() {
    let run = |seed: &str| prints(&["simulate", "pps", "--map", "pps", "--samples", "20", "--seed", seed]);
    assert_eq!(run("3"), run("3"));
    assert_ne!(run("3"), run("4"));
    assert_eq!(run("3").lines().count(), 21);
}

#[test]
fn accuracy_and_repeatability_are_those_put_in() {
    let folder = tempdir().unwrap();
    let plan = folder.path().join("plan.csv");
    // Ten configurations with thirty visits each.
    let configurations = prints(&["simulate", "pps", "--map", "pps", "--samples", "10"]);
    let commanded = |line: &str| line.split(',').take(7).collect::<Vec<_>>().join(",") + "\n";
    let mut lines = configurations.lines().map(commanded);
    let heading = lines.next().unwrap();
    fs::write(&plan, heading + &lines.collect::<String>().repeat(30)).unwrap();
    let data = folder.path().join("data.csv");
    let simulate =
        ["simulate", "pps", "--map", "pps", path(&plan), "--out", path(&data), "--random", "--seed", "2"];
    prints(&simulate);
    let report = json(&["measure", "pps", path(&data), "--map", "pps", "--json"]);
    let repeated = &report["repeated"];
    assert_eq!(
        (&repeated["configurations"], &repeated["visits"], &repeated["fewest"]),
        (&10.into(), &300.into(), &30.into())
    );
    // Apart from random errors within their bounds, the repeatable sources explain everything.
    assert!(report["explained"]["share"].as_f64().unwrap() > 0.99);
    let number = |value: &serde_json::Value| value.as_f64().unwrap();
    let explained = &report["explained"];
    let inside = number(&explained["inside"]);
    assert!(
        (number(&explained["likely"][0])..=number(&explained["likely"][1])).contains(&inside),
        "{explained}"
    );
    // Random sources alone give at most 0.0992 mm; the noise of the targets adds to it.
    let rp = repeated["rp"]["max"].as_f64().unwrap();
    assert!((0.05..0.35).contains(&rp), "{rp}");
    // ΔX of the first row of errors.csv, computed by hand.
    let out = folder.path().join("out");
    let text = full(&["measure", "pps", path(&data), "--map", "pps", "--out", path(&out)]);
    narrow(&text);
    assert!(text.contains("ISO 9283"));
    assert!(text.split_whitespace().collect::<Vec<_>>().join(" ").contains("as expected"), "{text}");
    assert_eq!(fs::read_to_string(out.join("errors.csv")).unwrap().lines().count(), 301);
    let page = fs::read_to_string(out.join("report.html")).unwrap();
    for expected in ["cf. Figure 13", "cf. Figure 14", "Repeatability: distribution of errors"] {
        assert!(page.contains(expected), "{expected}");
    }
    // Without noise and random errors, the sources explain everything.
    let exact = ["simulate", "pps", "--map", "pps", path(&plan), "--out", path(&data), "--noise", "0"];
    prints(&exact);
    let report = json(&["measure", "pps", path(&data), "--map", "pps", "--json"]);
    assert!(report["explained"]["left_max"].as_f64().unwrap() < 1e-5);
    // Then no residual is left in any row of the table either, and every row has a prediction.
    prints(&["measure", "pps", path(&data), "--map", "pps", "--out", path(&out), "--force"]);
    let errors = fs::read_to_string(out.join("errors.csv")).unwrap();
    let heading: Vec<&str> = errors.lines().next().unwrap().split(',').collect();
    let row = |line: &str| line.split(',').map(|value| value.parse().unwrap()).collect::<Vec<f64>>();
    let rows: Vec<Vec<f64>> = errors.lines().skip(1).map(row).collect();
    let largest = |name: &str| {
        let column = heading.iter().position(|column| column.starts_with(name)).expect(name);
        rows.iter().fold(0.0_f64, |largest, row| largest.max(row[column].abs()))
    };
    assert!(largest("residual_x") < 1e-4, "{errors}");
    assert!(largest("x") > 1.0 && largest("predicted_x") > 100.0, "{errors}");
    assert!(report["repeated"]["rp"].is_null(), "rows that are the same digit by digit are no visits");
}

#[test]
fn maps_and_plans_with_mistakes() {
    let folder = tempdir().unwrap();
    let refused = |command: &[&str], expected: &[&str]| {
        let run = abbe(command);
        assert_eq!((run.status, run.stdout.as_str()), (2, ""), "{}", run.stderr);
        expected
            .iter()
            .for_each(|expected| assert!(run.stderr.contains(expected), "{expected}\n{}", run.stderr));
    };
    let map = |text: &str, expected: &[&str]| {
        let file = write(folder.path(), "map.toml", text);
        refused(&["simulate", "scara", "--map", path(&file)], expected);
    };
    map("", &["`data` is missing"]);
    map(
        "[data]\nuncertanty = 1\n[joints]",
        &["no key `uncertanty`", "did you mean `uncertainty`?", "map.toml:2:1"],
    );
    map(
        "[data]\nuncertainty = \"0 mm\"\n[joints]\n[point]",
        &["`uncertainty` must be positive", "has no column", "`unit` is missing"],
    );
    map(
        "[data]\nuncertainty = \"1 deg\"\n[joints]\nq9 = { column = \"a\", unit = \"deg\" }",
        &["must be a length", "no variable `q9`", "exactly one description of the measurements"],
    );
    map(
        "[data]\n[joints]\nq1 = { column = \"a\", unit = \"mm\", sign = 2 }\n[point]\ncolumns = [\"x\"]\nunit = \"degg\"",
        &["must be a pure number", "a sign must be 1 or -1", "expected 3 entries, found 1", "`degg`"],
    );
    let plan = write(folder.path(), "plan.toml", "[plan]\nrepeat = 0\n[[set]]\naxes = { d9 = [1] }");
    refused(&["plan", "pps", "--map", "pps", "--sets", path(&plan)], &["integer from 1", "no variable `d9`"]);
    refused(&["measure", "pps", "nowhere.csv", "--map", "pps"], &["nowhere.csv"]);
    let empty = write(
        folder.path(),
        "empty.csv",
        "d1,d2,d3,q4,weight,centre_x,centre_z,p1_x,p1_y,p1_z,p2_x,p2_y,p2_z,p3_x,p3_y,p3_z\n",
    );
    refused(&["measure", "pps", path(&empty), "--map", "pps"], &["no row can be used"]);
    refused(&["simulate", "pps", "--map", "pps", "--noise", "-1mm"], &["must not be negative"]);
    refused(&["simulate", "pps", "--map", "pps", "--outliers", "2"], &["a share must be between 0 and 1"]);
}

/// The comparison with the paper appears only for the machine that the paper measured.
#[test]
fn figures_of_the_paper_are_of_its_machine() {
    let folder = tempdir().unwrap();
    let (data, out) = (folder.path().join("data.csv"), folder.path().join("out"));
    prints(&["simulate", "ur5", "--map", "ur5", "--samples", "20", "--out", path(&data)]);
    full(&["measure", "ur5", path(&data), "--map", "ur5", "--out", path(&out)]);
    let page = fs::read_to_string(out.join("report.html")).unwrap();
    assert!(page.contains("Accuracy: errors in space") && !page.contains("of the paper"));
}

/// Each instrument reports in its own unit in text, JSON and page, and errors.csv has the residual
/// of every reading.
#[test]
fn instruments_are_measured_each_in_its_unit() {
    let folder = tempdir().unwrap();
    let joints: String =
        (1..=6).map(|i| format!("q{i} = {{ column = \"q{i}\", unit = \"deg\" }}\n")).collect();
    let instruments = "[[target]]\nname = \"ball\"\nposition = [\"60 mm\", \"20 mm\", \"50 mm\"]\n\n\
        [[instrument]]\nname = \"wire\"\nkind = \"distance\"\ncolumn = \"length\"\nunit = \"um\"\nat = [\"400 mm\", \"200 mm\", \"300 mm\"]\nzero = \"unknown\"\nuncertainty = \"10 um\"\n\n\
        [[instrument]]\nname = \"tracker\"\nkind = \"point\"\ncolumns = [\"x\", \"y\", \"z\"]\nunit = \"mm\"\nuncertainty = \"0.02 mm\"\n";
    let map = write(folder.path(), "map.toml", &format!("[data]\n\n[joints]\n{joints}\n{instruments}"));
    let [data, out] = ["data.csv", "out"].map(|name| folder.path().join(name));
    prints(&["simulate", "ur5", "--map", path(&map), "--samples", "40", "--out", path(&data)]);
    let measure = ["measure", "ur5", path(&data), "--map", path(&map)];
    let report = json(&[&measure[..], &["--json"]].concat());
    let wire = &report["instruments"][0];
    assert_eq!((&wire["name"], &wire["unit"], &wire["count"]), (&"wire".into(), &"um".into(), &40.into()));
    // 10 µm of noise, reduced by the fitted zero and fixture: 12 % at one standard deviation.
    let rms = wire["left"]["rms"].as_f64().unwrap();
    assert!((6.0..14.0).contains(&rms), "{wire}");
    let tracker = report["instruments"][1]["left"]["rms"].as_f64().unwrap();
    assert!((tracker / (0.02 * 3f64.sqrt()) - 1.0).abs() < 0.3, "{report}");
    let text = full(&[&measure[..], &["--out", path(&out)]].concat());
    for said in ["wire", "um", "tracker", "std. error", "The stations of the instruments were fitted"] {
        assert!(text.contains(said), "{said}: {text}");
    }
    narrow(&text);
    let csv = fs::read_to_string(out.join("errors.csv")).unwrap();
    let residuals = "line,wire (um),tracker_x (mm),tracker_y (mm),tracker_z (mm),";
    let predictions =
        "predicted_wire (um),predicted_tracker_x (mm),predicted_tracker_y (mm),predicted_tracker_z (mm)\n";
    assert!(csv.starts_with(&format!("{residuals}{predictions}")), "{csv}");
    // Reading = residual + prediction, in micrometres.
    let first = |file: &str, column: &str| -> f64 {
        let mut lines = file.lines();
        let place = lines.next().unwrap().split(',').position(|name| name == column).unwrap();
        lines.next().unwrap().split(',').nth(place).unwrap().parse().unwrap()
    };
    let read = first(&fs::read_to_string(&data).unwrap(), "length");
    let sum = first(&csv, "wire (um)") + first(&csv, "predicted_wire (um)");
    assert!((sum - read).abs() < 1e-3, "{sum}, not {read}");
    assert_eq!(csv.lines().count(), 41);
    assert!(fs::read_to_string(out.join("report.html")).unwrap().contains("tracker_z (mm)"));
}

/// The joint zero of a map is added after unit and sign when rows are read, and subtracted when
/// they are written.
#[test]
fn a_zero_and_a_rotation_vector_are_read_as_they_are_written() {
    let folder = tempdir().unwrap();
    let joints = |second: &str| {
        let others = ["q1", "q3", "q4", "q5", "q6"]
            .map(|name| format!("{name} = {{ column = \"{name}\", unit = \"deg\" }}\n"));
        format!(
            "[data]\nuncertainty = \"0.02 mm\"\nangle_uncertainty = \"0.1 mrad\"\n[joints]\n{}q2 = {second}\n[pose]\nposition = [\"x\", \"y\", \"z\"]\nunit = \"mm\"\n\
             rotation_vector = {{ columns = [\"rx\", \"ry\", \"rz\"], unit = \"rad\" }}\n",
            others.concat()
        )
    };
    let plain = write(folder.path(), "plain.toml", &joints("{ column = \"q2\", unit = \"deg\" }"));
    let zero = "{ column = \"q2\", unit = \"deg\", sign = -1, zero = \"-90 deg\" }";
    let other = write(folder.path(), "other.toml", &joints(zero));
    let rows =
        |map: &Path| prints(&["simulate", "ur5", "--map", path(map), "--samples", "20", "--noise", "0"]);
    let second = |text: &str| -> Vec<f64> {
        let place = text.lines().next().unwrap().split(',').position(|name| name == "q2").unwrap();
        text.lines().skip(1).map(|line| line.split(',').nth(place).unwrap().parse().unwrap()).collect()
    };
    let (as_spec, as_map) = (rows(&plain), rows(&other));
    for (q, column) in second(&as_spec).into_iter().zip(second(&as_map)) {
        assert!((-column - 90.0 - q).abs() < 1e-6, "{column} is {q}");
    }
    let data = write(folder.path(), "data.csv", &as_map);
    let report = json(&["measure", "ur5", path(&data), "--map", path(&other), "--json"]);
    let errors = report["errors"].as_array().unwrap();
    let norm = errors.iter().find(|error| error["name"] == "norm").unwrap();
    // The random sources of the spec remain: tenths of a millimetre. A missing zero would be
    // decimetres.
    assert!(norm["rms"].as_f64().unwrap() < 1.0, "{norm}");
}

/// Counts of an encoder are angles, whichever way their size is written.
#[test]
fn counts_have_a_size() {
    let folder = tempdir().unwrap();
    let spec = "[manipulator]\nname = \"arm\"\nlength = \"mm\"\n\n[[frame]]\nname = \"a\"\n\
        variable = { name = \"q1\", kind = \"revolute\", limits = [-4, 4] }\ntransform = \"Rz(q1) Tx(400)\"\n";
    let spec = write(folder.path(), "arm.toml", spec);
    let row = |count: i32| {
        let angle = std::f64::consts::TAU * f64::from(count) / 4096.0;
        format!("{count},{:.9},{:.9},0\n", 400.0 * angle.cos(), 400.0 * angle.sin())
    };
    let rows: String = (0..20).map(|k| row(-1900 + 190 * k)).collect();
    let data = write(folder.path(), "rows.csv", &format!("a,X,Y,Z\n{rows}"));
    let largest = |unit: &str| {
        let map = format!(
            "[data]\nuncertainty = \"0.01 mm\"\nbase = \"exact\"\nplacement = \"exact\"\n\n[joints]\n\
             q1 = {{ column = \"a\", unit = \"{unit}\" }}\n\n[point]\ncolumns = [\"X\", \"Y\", \"Z\"]\nunit = \"mm\"\n"
        );
        let map = write(folder.path(), "map.toml", &map);
        let report = json(&["measure", path(&spec), path(&data), "--map", path(&map), "--json"]);
        report["errors"][3]["max"].as_f64().unwrap_or_else(|| panic!("{report}"))
    };
    for unit in ["360 deg/4096", "0.087890625 deg", "deg/11.37777777777778", "360deg/4096"] {
        assert!(largest(unit) < 1e-6, "{unit}: {}", largest(unit));
    }
    assert!(largest("0.08789 deg") > 1e-3);
}

/// Instruments that read from the row before read nothing in the first row of a plan, and of each
/// setup; no row is lost, and the rows are read as they were written.
#[test]
fn displacements_begin_anew_in_each_setup() {
    let folder = tempdir().unwrap();
    let joints: String = (1..=6)
        .map(|i| {
            let (name, unit) = if i < 4 { (format!("d{i}"), "mm") } else { (format!("q{i}"), "deg") };
            format!("{name} = {{ column = \"{name}\", unit = \"{unit}\" }}\n")
        })
        .collect();
    let laser = |name: &str, setup: u32| {
        format!(
            "[[instrument]]\nname = \"{name}\"\nkind = \"displacement\"\nsetup = {setup}\ncolumn = \"travelled\"\n\
             unit = \"um\"\nuncertainty = \"1 um\"\n\n"
        )
    };
    let map = format!("[data]\nsetup = \"setup\"\n\n[joints]\n{joints}\n{}{}", laser("x", 1), laser("z", 2));
    let map = write(folder.path(), "laser.toml", &map);
    let mut plan = "d1,d2,d3,q4,q5,q6,setup\n".to_owned();
    for i in 0..4 {
        plan += &format!("{},300,200,0,0,0,1\n", 100 + 50 * i);
    }
    for i in 0..3 {
        plan += &format!("250,300,{},0,0,0,2\n", 300 + 40 * i);
    }
    let plan = write(folder.path(), "plan.csv", &plan);
    let rows = folder.path().join("rows.csv");
    let simulate =
        ["simulate", "pps", path(&plan), "--map", path(&map), "--noise", "0", "--out", path(&rows)];
    assert!(prints(&simulate).contains("7 rows"));
    let text = fs::read_to_string(&rows).unwrap();
    let heading: Vec<&str> = text.lines().next().unwrap().split(',').collect();
    let place = heading.iter().position(|name| *name == "travelled").unwrap();
    let read: Vec<Option<f64>> =
        text.lines().skip(1).map(|line| line.split(',').nth(place).unwrap().parse().ok()).collect();
    let near = |i: usize, steps: f64| read[i].is_some_and(|read| (read / 1e3 - steps).abs() < 1.0);
    assert!(read.len() == 7 && read[0].is_none() && read[4].is_none(), "{text}");
    assert!((1..4).all(|i| near(i, 50.0)) && (5..7).all(|i| near(i, 40.0)), "{text}");
    let report = json(&["measure", "pps", path(&rows), "--map", path(&map), "--json"]);
    assert_eq!(report["rows"], 5, "{report}");
    // An instrument of every setup goes on.
    let always = laser("always", 3).replace("setup = 3\n", "").replace("\"travelled\"", "\"whole\"");
    let text = fs::read_to_string(&map).unwrap() + &always;
    let map = write(folder.path(), "always.toml", &text);
    let simulate = [
        "simulate",
        "pps",
        path(&plan),
        "--map",
        path(&map),
        "--noise",
        "0",
        "--out",
        path(&rows),
        "--force",
    ];
    prints(&simulate);
    let text = fs::read_to_string(&rows).unwrap();
    let heading: Vec<&str> = text.lines().next().unwrap().split(',').collect();
    let place = heading.iter().position(|name| *name == "whole").unwrap();
    let empty = text.lines().skip(1).filter(|line| line.split(',').nth(place).unwrap().is_empty()).count();
    assert_eq!(empty, 1, "{text}");
}

/// The columns of a file without a heading are named in its map, in any dialect; a file with one is
/// read by it.
#[test]
fn a_map_names_the_columns_of_a_file_without_a_heading() {
    let workshop = Workshop::new();
    let (spec, data, map) = (workshop.path("s.toml"), workshop.path("d.csv"), workshop.path("m.toml"));
    let rows = fs::read_to_string(&data).unwrap();
    let (heading, below) = rows.split_once('\n').unwrap();
    let names: Vec<String> = heading.split(',').map(|name| format!("{name:?}")).collect();
    let text = fs::read_to_string(&map).unwrap();
    let named = text.replace("[data]", &format!("[data]\ncolumns = [{}]", names.join(", ")));
    let put = |name: &str, text: &str| {
        fs::write(workshop.at(name), text).unwrap();
        workshop.path(name)
    };
    let named = put("named.toml", &named);
    let bare = put("bare.csv", below);
    let semicolons = put("semicolons.csv", &below.replace(',', ";").replace('.', ","));
    let report = |data: &str, map: &str| {
        let mut report = json(&["measure", &spec, data, "--map", map, "--json"]);
        report.as_object_mut().unwrap().remove("files");
        report
    };
    let expected = report(&data, &map);
    for data in [&data, &bare, &semicolons] {
        assert_eq!(report(data, &named), expected, "{data}");
    }
    let run = abbe(&["measure", &spec, &bare, "--map", &map]);
    let said = run.stderr.split_whitespace().collect::<Vec<_>>().join(" ");
    assert!(run.status == 2 && said.contains("or give them in the map, as `columns` in `[data]`"), "{said}");
    let short = put("short.csv", &below.replace('\n', ",1\n"));
    let run = abbe(&["measure", &spec, &short, "--map", &named]);
    assert!(run.status == 2 && run.stderr.contains("and the first row has"), "{}", run.stderr);
}
