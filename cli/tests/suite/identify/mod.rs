//! `abbe identify` on simulated measurements.

mod data;
mod small_data;

use std::path::{Path, PathBuf};

use serde_json::Value;
use tempfile::{TempDir, tempdir};

use crate::erroneous::ERRORS;
use crate::running::{abbe, full, json, narrow, prints, shipped, write};
use crate::workshop::Workshop;

fn path(path: &Path) -> &str {
    path.to_str().expect("a path is text")
}

/// Returns the path of a shipped map.
fn map(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../manipulators/maps").join(format!("{name}.toml"))
}

fn number(report: &Value, keys: &[&str]) -> f64 {
    keys.iter().fold(report, |value, key| &value[key]).as_f64().unwrap_or_else(|| panic!("{keys:?}"))
}

/// Further errors of the simulated machine.
const WRIST: &str = "[[source.effect]]\nframe = \"wrist 3\"\ne_x = \"1.5 mm\"\ne_z = \"0.7 mm\"\n";

const POINT: &str = r#"
[point]
columns = ["x", "y", "z"]
unit = "mm"
"#;

/// A UR5 with errors, a map, and simulated measurements.
struct Bench {
    folder: TempDir,
    spec: PathBuf,
    map: PathBuf,
}

impl Bench {
    fn new(layout: &str) -> Self {
        let folder = tempdir().unwrap();
        let joints: String =
            (1..=6).map(|i| format!("q{i} = {{ column = \"j{i}\", unit = \"deg\" }}\n")).collect();
        let map = format!(
            "[data]\nuncertainty = \"0.02 mm\"\nangle_uncertainty = \"0.05 mrad\"\n\n[joints]\n{joints}{layout}"
        );
        let spec = write(folder.path(), "real.toml", &format!("{}{ERRORS}{WRIST}", shipped("ur5")));
        let map = write(folder.path(), "map.toml", &map);
        Self { folder, spec, map }
    }

    fn simulated(&self, more: &[&str]) -> String {
        prints(&[&["simulate", path(&self.spec), "--map", path(&self.map)][..], more].concat())
    }

    fn file(&self, name: &str, text: &str) -> PathBuf {
        write(self.folder.path(), name, text)
    }

    fn identify(&self, data: &Path, more: &[&str]) -> Value {
        json(&[&["identify", "ur5", path(data), "--map", path(&self.map), "--json"][..], more].concat())
    }

    /// Asserts that the data are refused with these texts.
    fn refused(&self, data: &Path, expected: &[&str]) {
        let run = abbe(&["identify", "ur5", path(data), "--map", path(&self.map), "--json"]);
        assert_eq!((run.status, run.stdout.as_str()), (2, ""), "{}", run.stderr);
        let stderr = run.stderr.split_whitespace().collect::<Vec<_>>().join(" ");
        expected.iter().for_each(|expected| assert!(stderr.contains(expected), "{expected}\n{stderr}"));
    }
}

/// Applies a change to each line of a CSV text.
fn changed(text: &str, mut change: impl FnMut(usize, &mut Vec<String>)) -> String {
    let lines = text.lines().enumerate().map(|(i, line)| {
        let mut fields: Vec<String> = line.split(',').map(str::to_owned).collect();
        if i > 0 {
            change(i - 1, &mut fields);
        }
        fields.join(",") + "\n"
    });
    lines.collect()
}

fn times(field: &mut String, factor: f64) {
    *field = format!("{}", field.parse::<f64>().unwrap() * factor);
}

#[test]
fn what_is_found_is_the_machine() {
    let bench = Bench::new(POINT);
    let data = bench.file("data.csv", &bench.simulated(&["--samples", "300", "--seed", "1"]));
    let unseen = bench.file("unseen.csv", &bench.simulated(&["--samples", "50", "--seed", "2"]));
    let report = bench.identify(&data, &["--test", path(&unseen)]);
    assert_eq!(report["rank"], 27);
    // Only the noise of the instrument remains: √3 σ of a point.
    assert!((number(&report, &["test", "after", "rms"]) - 0.02 * 3f64.sqrt()).abs() < 0.004);
    assert!((number(&report, &["uncertainty_factor"]) - 1.0).abs() < 0.06);
    assert!(number(&report, &["test", "base_and_tool", "mean"]) > 0.3);
}

#[test]
fn the_test_file_decides_nothing() {
    let bench = Bench::new(POINT);
    let data = bench.file("data.csv", &bench.simulated(&["--samples", "120", "--seed", "1"]));
    let one = bench.file("one.csv", &bench.simulated(&["--samples", "30", "--seed", "2"]));
    let other =
        bench.file("other.csv", &bench.simulated(&["--samples", "9", "--seed", "3", "--noise", "5mm"]));
    let run = |test: Option<&Path>| {
        let out = bench.folder.path().join("found.toml");
        let more = test.map_or(Vec::new(), |test| vec!["--test", path(test)]);
        let mut report =
            bench.identify(&data, &[&["--terms", "joint", "--out", path(&out)][..], &more].concat());
        for of_the_test in ["test", "extrapolated", "files", "statements"] {
            report.as_object_mut().unwrap().remove(of_the_test);
        }
        (report, std::fs::read_to_string(out).unwrap())
    };
    let alone = run(None);
    assert_eq!(run(Some(&one)), alone);
    assert_eq!(run(Some(&other)), alone);
    // The test file is opened after the fit: if it is missing, the run ends without writing
    // anything.
    let run = abbe(&["identify", "ur5", path(&data), "--map", path(&bench.map), "--test", "nowhere.csv"]);
    assert_eq!(run.status, 2);
    assert!(run.stderr.contains("nowhere.csv"));
}

#[test]
fn the_result_is_a_spec() {
    let bench = Bench::new(POINT);
    let data = bench.file("data.csv", &bench.simulated(&["--samples", "200", "--seed", "4"]));
    let out = bench.folder.path().join("found.toml");
    let identify = ["identify", "ur5", path(&data), "--map", path(&bench.map), "--out", path(&out)];
    let text = prints(&[&identify[..], &["--full"]].concat());
    let found = std::fs::read_to_string(&out).unwrap();
    // All lines of the nominal spec are kept in order; all others, except the covariance, are
    // listed as added.
    let (found, covariance) = found.split_once("# The covariance of what remains of the errors").unwrap();
    let (_, covariance) = covariance.split_once('\n').unwrap();
    assert!(
        covariance.starts_with("[covariance]\n") && text.contains("the covariance of the identified errors"),
        "{text}"
    );
    assert!(text.contains("Fitted ranges: q1 ") && text.contains(" of its limits), q2 "), "{text}");
    let mut rest = found.lines();
    for line in shipped("ur5").lines() {
        assert!(rest.any(|found| found == line), "{line}");
    }
    for line in found.lines().filter(|line| !shipped("ur5").lines().any(|nominal| nominal == *line)) {
        assert!(text.contains(&format!("+ {line}\n")), "{line}");
    }
    assert!(
        found.contains("name = \"identified: alpha of elbow\"") && found.contains("200 rows of data.csv")
    );
    let check = json(&["check", path(&out), "--json"]);
    assert!(check["laws"].as_array().unwrap().iter().all(|law| law["holds"] == true));
    assert!(prints(&["generate", path(&out)]).contains("pub mod raw"));
    json(&["analyze", path(&out), "--json"]);

    // The written spec predicts the measurements: the same chain and errors, to the written digits.
    let map = out.with_extension("map.toml");
    assert!(text.contains("found.map.toml: the map with the identified station"), "{text}");
    let measured = json(&["measure", path(&out), path(&data), "--map", path(&map), "--json"]);
    let fitted = bench.identify(&data, &[]);
    let left = number(&measured, &["explained", "left_rms"]);
    assert!((left - number(&fitted, &["fit", "after", "rms"])).abs() < 1e-5);
    assert!(number(&measured, &["explained", "share"]) > 0.99);
}

/// The most significant errors are shown, in descending order, as many as fit on the screen.
#[test]
fn the_page_has_the_surest_numbers_of_the_chain() {
    let folder = tempdir().unwrap();
    let frames = ["base", "shoulder", "elbow", "wrist 1", "wrist 2", "wrist 3"];
    let numbers = frames.iter().enumerate().map(|(i, frame)| {
        let size = 0.2 * (i as f64 + 1.0);
        format!(
            "[[source]]\nname = \"{frame} as built\"\nclass = \"repeatable\"\nframe = \"{frame}\"\n\
                 dh = {{ theta = \"{size} mrad\", d = \"{size} mm\", a = \"{size} mm\", alpha = \"{size} mrad\" }}\n"
        )
    });
    let errors: String = numbers.collect();
    let spec = write(folder.path(), "real.toml", &format!("{}{errors}", shipped("ur5")));
    let bench = Bench { spec, ..Bench::new(POINT) };
    let data = bench.file("data.csv", &bench.simulated(&["--samples", "200", "--seed", "1"]));
    let report = bench.identify(&data, &[]);
    let meanings = report["joint_errors"].as_array().unwrap();
    assert!(meanings.len() > 6, "{meanings:#?}");
    let identify = ["identify", "ur5", path(&data), "--map", path(&bench.map)];
    let (answer, all) = (prints(&identify), full(&identify));
    // Long sentences are wrapped.
    let all = all.split_whitespace().collect::<Vec<_>>().join(" ");
    let mut shown = 0;
    for meaning in meanings {
        let [error, number] = ["in_place_of", "number"].map(|field| meaning[field].as_str().unwrap());
        assert!(all.contains(number) && all.contains(&format!(" ({error})")), "{meaning}");
        let is_own = |line: &&str| [error, number].iter().any(|name| line.starts_with(&format!("  {name} ")));
        shown += answer.lines().find(is_own).map_or(0, |line| usize::from(line.contains(number)));
    }
    assert!(shown >= 3, "{answer}");
}

#[test]
fn what_is_grouped_with_what_is_said() {
    let bench = Bench::new(POINT);
    let data = bench.file("data.csv", &bench.simulated(&["--samples", "200", "--seed", "4"]));
    let text = prints(&["identify", "ur5", path(&data), "--map", path(&bench.map), "--full"]);
    // `plan` predicts this before any measurement.
    assert!(full(&["plan", "ur5", "--map", path(&bench.map)]).contains("e_r1 acts as −425 e_y2 + e_r2"));
    for expected in [
        "Identifiable: 27 combinations of 45 unknowns, 27 of the 42 errors of frames and base",
        "q2 is revolute: errors about and along its axis are   e_z1 acts as e_z2",
        "e_r1 acts as −425 e_y2 + e_r2",
        "e_p6 cannot be observed",
        "used for validation only",
    ] {
        assert_eq!(text.contains(expected), expected != "used for validation only", "{expected}\n{text}");
    }
    narrow(&text);
    // Two joints do not move: the fit succeeds and the report says so.
    let still = format!(
        "[data]\nuncertainty = \"0.02 mm\"\n\n[joints]\nq1 = {{ column = \"j1\", unit = \"deg\" }}\nq2 = {{ column = \"j2\", unit = \"deg\" }}\nq3 = {{ column = \"j3\", unit = \"deg\" }}\nq4 = {{ value = 0.3 }}\nq5 = {{ value = 0.2 }}\nq6 = {{ value = 0 }}\n{POINT}"
    );
    let map = bench.file("still.toml", &still);
    let simulated = prints(&["simulate", path(&bench.spec), "--map", path(&map), "--samples", "100"]);
    let data = bench.file("still.csv", &simulated);
    let text = prints(&["identify", "ur5", path(&data), "--map", path(&map), "--full"]);
    assert!(text.contains("q5 does not move in these data"), "{text}");
    let text = text.replace(path(&data), "");
    assert!(!text.contains("e9") && !text.contains("NaN") && !text.contains("inf"), "{text}");
}

/// The default text is at most one screen and states the result first; `--full` lists what it
/// counts.
#[test]
fn a_page_begins_with_the_answer() {
    let bench = Bench::new(POINT);
    let data = bench.file("data.csv", &bench.simulated(&["--samples", "200", "--seed", "4"]));
    let unseen = bench.file("unseen.csv", &bench.simulated(&["--samples", "50", "--seed", "2"]));
    let out = bench.folder.path().join("found.toml");
    let identify = ["identify", "ur5", path(&data), "--map", path(&bench.map), "--test", path(&unseen)];
    let more = ["--terms", "joint,product", "--out", path(&out)];
    let text = prints(&[&identify[..], &more].concat());
    narrow(&text);
    assert!(text.lines().count() <= 30, "{text}");
    let all = full(&[&identify[..], &more].concat());
    assert!(all.lines().count() > 2 * text.lines().count());
    let report = bench.identify(&data, &[&["--test", path(&unseen)][..], &more[..2]].concat());
    let mean = number(&report, &["test", "after", "mean"]);
    let answer = text.lines().next().unwrap();
    let expected = format!(": mean error {mean:.4} mm on 50 test rows, ");
    assert!(answer.contains(&expected), "{answer}, not {expected}");
    let groups = report["groups"].as_array().unwrap().len();
    let listed = all.matches(" acts as ").count() + all.matches("cannot be observed").count();
    assert_eq!(listed, groups, "{all}");
    // The errors shown are the most significant ones as they are written, and none by chance.
    let parameters = report["parameters"].as_array().unwrap().iter();
    let machine = parameters.filter(|one| one["kind"] == "machine");
    let mut sure: Vec<(f64, &str)> = machine
        .map(|one| {
            let written = &one["written"];
            let sure = number(written, &["value"]).abs() / number(written, &["standard_deviation"]);
            (sure, written["name"].as_str().unwrap())
        })
        .collect();
    sure.sort_by(|a, b| b.0.total_cmp(&a.0));
    let shown = |name: &str| text.lines().any(|line| line.starts_with(&format!("  {name} ")));
    let count = sure.iter().filter(|(sure, _)| *sure > 4.0).count();
    assert!((4..=5).contains(&count) && sure.len() > 6, "{sure:?}");
    let is_right = |(i, (_, name)): (usize, &(f64, &str))| shown(name) == (i < count);
    assert!(sure.iter().enumerate().all(is_right), "{sure:?}\n{text}");
}

#[test]
fn counts_of_the_paper() {
    let folder = tempdir().unwrap();
    let nominal = manipulators_map("pps");
    let free = nominal
        .replace("q5 = { value = 0 }", "q5 = { column = \"q5\", unit = \"deg\" }")
        .replace("q6 = { value = 0 }", "q6 = { column = \"q6\", unit = \"deg\" }");
    let point = |text: &str| {
        let at = text.find("[[target]]").unwrap();
        format!("{}{POINT}", &text[..at])
    };
    let exact = |text: &str| text.replace("[data]", "[data]\nbase = \"exact\"");
    for (map, expected) in [
        (exact(&nominal), "14 of the 36 errors of frames "),
        (nominal.clone(), "16 of the 42 errors of frames and base "),
        (exact(&point(&nominal)), "11 of the 36 errors of frames "),
        (point(&nominal), "13 of the 42 errors of frames and base "),
        (exact(&free), "22 of the 36 errors of frames "),
        (free, "24 of the 42 errors of frames and base "),
    ] {
        let map = write(folder.path(), "map.toml", &map);
        let text = full(&["plan", "pps", "--map", path(&map), "--optimal", "60", "--candidates", "80"]);
        let text = text.split_whitespace().collect::<Vec<_>>().join(" ");
        assert!(text.contains(expected), "{expected}\n{text}");
    }
}

fn manipulators_map(name: &str) -> String {
    std::fs::read_to_string(map(name)).unwrap()
}

/// Sources of the spec are kept: nothing is identified twice, and nothing that is not identifiable.
#[test]
fn known_sources_are_taken_as_known() {
    let folder = tempdir().unwrap();
    let nominal = manipulators_map("pps");
    let text = nominal.replace("q5 = { value = 0 }", "q5 = { column = \"q5\", unit = \"deg\" }");
    let text = text.replace("q6 = { value = 0 }", "q6 = { column = \"q6\", unit = \"deg\" }");
    let text = format!("{}{POINT}", &text[..text.find("[[target]]").unwrap()]);
    let map = write(folder.path(), "map.toml", &text);
    let data = folder.path().join("data.csv");
    prints(&["simulate", "pps", "--map", path(&map), "--samples", "400", "--out", path(&data)]);
    let report = json(&["identify", "pps", path(&data), "--map", path(&map), "--json"]);
    assert_eq!(report["machine"]["rank"], 21);
    assert!((number(&report, &["fit", "after", "rms"]) - 0.04 * 3f64.sqrt()).abs() < 0.004);
    for parameter in report["parameters"].as_array().unwrap() {
        let off = number(parameter, &["value"]).abs() / number(parameter, &["standard_deviation"]);
        assert!(off < 4.0, "{parameter}");
    }
}

#[test]
fn an_instrument_that_stands_anywhere() {
    let bench = Bench::new(POINT);
    // Measurements from a station moved by half a metre and turned by 90° about z.
    let moved = changed(&bench.simulated(&["--samples", "150"]), |_, fields| {
        let [x, y] = [6, 7].map(|i| fields[i].parse::<f64>().unwrap());
        (fields[6], fields[7]) = (format!("{}", 500.0 - y), format!("{}", x + 20.0));
    });
    let data = bench.file("data.csv", &moved);
    let map = std::fs::read_to_string(&bench.map).unwrap().replace("[data]", "[data]\nbase = \"unknown\"");
    let map = bench.file("anywhere.toml", &map);
    let report = json(&["identify", "ur5", path(&data), "--map", path(&map), "--json"]);
    assert!(number(&report, &["fit", "after", "rms"]) < 0.04);
    assert!((report["base"][0][1].as_f64().unwrap() + 1.0).abs() < 0.01);
}

/// Limits give a verdict and the exit status; without limits there is none. The output does not
/// overwrite an input.
#[test]
fn limits_make_a_verdict() {
    let bench = Bench::new(POINT);
    let data = bench.file("data.csv", &bench.simulated(&["--samples", "120", "--seed", "1"]));
    let unseen = bench.file("unseen.csv", &bench.simulated(&["--samples", "40", "--seed", "2"]));
    let out = bench.folder.path().join("found.toml");
    let identify = ["identify", "ur5", path(&data), "--map", path(&bench.map), "--test", path(&unseen)];
    let run = abbe(&[&identify[..], &["--accept", "mean 0.1 mm, max 0.2 mm", "--out", path(&out)]].concat());
    assert_eq!(run.status, 0, "{}", run.stderr);
    assert!(run.stdout.contains(": WITHIN LIMITS, mean error 0.0"), "{}", run.stdout);
    let run = abbe(&[&identify[..], &["--accept", "mean 0.1 mm, rms 1 um"]].concat());
    assert_eq!(run.status, 1, "{}", run.stderr);
    assert!(run.stdout.contains(": BEYOND LIMITS, "), "{}", run.stdout);
    assert!(!prints(&identify).contains("LIMITS"));

    let map = out.with_extension("map.toml");
    let limits = std::fs::read_to_string(&map).unwrap() + "\n[accept]\np95 = \"2 um\"\n";
    let limits = bench.file("limits.map.toml", &limits);
    let run = abbe(&["measure", path(&out), path(&unseen), "--map", path(&limits)]);
    assert_eq!(run.status, 1, "{}", run.stderr);
    let measure = ["measure", path(&out), path(&unseen), "--map", path(&map)];
    assert!(
        prints(&[&measure[..], &["--station", "new"]].concat()).contains("Station   fitted to these rows")
    );
    narrow(&prints(&measure));
    let again = ["identify", "ur5", path(&data), "--map", path(&map), "--out", path(&out)];
    let run = abbe(&again);
    assert_eq!(run.status, 2);
    assert!(
        run.stderr.contains("this file is an input of the command and cannot be overwritten"),
        "{}",
        run.stderr
    );
}

/// A table at a relative path is found from the folder of the identified spec, and measurements are
/// predicted with it.
#[test]
fn an_identified_spec_in_another_folder_keeps_its_tables() {
    let workshop = Workshop::new();
    let [spec, data, map] = ["s.toml", "d.csv", "m.toml"].map(|name| workshop.path(name));
    std::fs::create_dir(workshop.at("results")).unwrap();
    let out = workshop.path("results/found.toml");
    prints(&["identify", &spec, &data, "--map", &map, "--out", &out]);
    let text = std::fs::read_to_string(&out).unwrap();
    assert!(text.contains("file = \"../rail.csv\""), "{text}");
    prints(&["measure", &out, &data, "--map", &workshop.path("results/found.map.toml")]);
}

/// Residuals that the random sources of the spec explain are not called errors that the model
/// lacks; larger ones are.
#[test]
fn random_sources_explain_residuals() {
    let bench = Bench::new(POINT);
    // Noise of 0.06 mm: of it the map states 0.02 mm, and random sources as much as is missing.
    let noisy = std::fs::read_to_string(&bench.map).unwrap().replace("\"0.02 mm\"", "\"0.06 mm\"");
    let noisy = bench.file("noisy.toml", &noisy);
    let data =
        prints(&["simulate", path(&bench.spec), "--map", path(&noisy), "--samples", "120", "--seed", "1"]);
    let data = bench.file("data.csv", &data);
    let said = |deviation: Option<f64>| {
        let source = |axis: &str| {
            deviation.map_or_else(String::new, |deviation| {
                format!(
                    "\n[[source]]\nname = \"scatter {axis}\"\nclass = \"random\"\ndistribution = \"normal\"\nframe = \"wrist 3\"\ne_{axis} = \"{deviation} mm\"\n"
                )
            })
        };
        let spec = format!("{}{}", shipped("ur5"), ["x", "y", "z"].map(source).concat());
        let spec = bench.file("nominal.toml", &spec);
        prints(&["identify", path(&spec), path(&data), "--map", path(&bench.map)])
            .split_whitespace()
            .collect::<Vec<_>>()
            .join(" ")
    };
    let (lacks, explained) =
        ("errors that the model does not have", "the random sources of the spec explain that");
    for (deviation, expected, other) in
        [(None, lacks, explained), (Some(0.0566), explained, lacks), (Some(0.02), lacks, explained)]
    {
        let text = said(deviation);
        assert!(text.contains(expected) && !text.contains(other), "{deviation:?}: {text}");
    }
}
