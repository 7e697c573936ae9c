//! Parts with impossible content give errors with help, never a panic or an endless loop.

use abbe_spec::diagnostic::Diagnostics;
use abbe_study::analyze::Report;
use abbe_study::analyze::parts::{AnalysisRequest, FileText, Merge, Part};
use abbe_study::hash;
use rand::{RngExt, SeedableRng};
use rand_xoshiro::Xoshiro256PlusPlus;
use serde_json::{Value, json};

use crate::thorough::sample_size;

const FIGURES: &str = "[[figure]]\nkind = \"travel\"\nover = \"d1\"\n[[figure]]\nkind = \"surface\"\n\
                       over = [\"d1\", \"q4\"]\n[[figure]]\nkind = \"cloud\"\n[[figure]]\nkind = \"histogram\"\n";

/// A turning arm whose two errors were identified.
const CALIBRATED: &str = r#"
[manipulator]
name = "arm"
length = "mm"
[[frame]]
name = "turn"
variable = { name = "d1", kind = "prismatic", limits = ["0 mm", "100 mm"] }
transform = "Tx(d1)"
[[frame]]
name = "arm"
variable = { name = "q4", kind = "revolute", limits = ["-90 deg", "90 deg"] }
transform = "Rz(q4)"
[tool]
transform = "Tx(300)"
[[source]]
name = "identified"
class = "repeatable"
frame = "arm"
e_y = "0.1 mm"
e_r = "0.5 mrad"
[covariance]
of = [{ source = "identified", error = "e_y" }, { source = "identified", error = "e_r" }]
rows = [[1e-4, -2e-7], [-2e-7, 4e-9]]
"#;

/// Returns analyses that use all content of parts: repeatable and random sources, residuals,
/// tolerances, figures, unreachable configurations, and a calibration.
fn questions() -> [AnalysisRequest; 3] {
    let sampled = format!(
        "[study]\ntitle = \"t\"\ntolerance = {{ position = \"5 mm\", orientation = \"2 mrad\" }}\n\
         [workspace.random]\nsamples = 300\n[compensation]\ndefault = 0.1\n{FIGURES}"
    );
    let reached = "[study]\ntitle = \"t\"\n[workspace.box]\nx = { from = \"-1 m\", to = \"1 m\", count = 6 }\n\
                   y = { from = \"0 m\", to = \"1 m\", count = 6 }\nz = { from = \"0 m\", to = \"1.2 m\", count = 6 }\n";
    let calibrated = "[study]\ntitle = \"t\"\ntolerance = \"0.2 mm\"\n[workspace.random]\nsamples = 300\n";
    let all = [("pps", sampled), ("puma560", reached.to_owned()), ("arm.toml", calibrated.to_owned())];
    all.map(|(spec, text)| AnalysisRequest {
        spec: spec.to_owned(),
        spec_text: (spec == "arm.toml").then(|| FileText {
            name: spec.to_owned(),
            folder: None,
            text: CALIBRATED.to_owned(),
        }),
        study: Some(FileText { name: "study.toml".to_owned(), folder: None, text }),
        tolerances: Vec::new(),
        changes: Vec::new(),
        monte_carlo: Some(10),
        seed: None,
        interpret: false,
        figures: true,
    })
}

fn halves(question: &AnalysisRequest) -> [Part; 2] {
    ["1/2", "2/2"].map(|shard| Part::new(question.clone(), shard.parse().unwrap(), &mut ()).unwrap())
}

/// Returns the content of a part's file.
fn content(part: &Part) -> Value {
    let text = String::from_utf8(part.to_bytes()).unwrap();
    let lines: Vec<&str> = text.lines().collect();
    assert_eq!((lines.len(), lines[0]), (3, "abbe part 4"));
    serde_json::from_str(lines[1]).unwrap()
}

/// Reads a file with this content and a correct checksum.
fn read(content: &Value) -> Result<Part, Diagnostics> {
    let text = format!("abbe part 4\n{content}\n");
    let file = format!("{text}{}\n", hash::text(&text));
    Part::from_bytes("a.part", file.as_bytes())
}

fn merge(parts: Vec<(String, Part)>) -> Result<Report, Diagnostics> {
    Merge::new(parts, &mut ())?.report(&mut ())
}

fn refused(content: &Value, says: &str) {
    let mistakes = read(content).map(|_| ()).unwrap_err();
    let text = mistakes.to_string();
    assert!(text.contains(says), "{says}: {text}");
    assert!(mistakes.list.iter().all(|mistake| mistake.help.is_some()), "{text}");
}

#[test]
fn parts_survive_a_round_trip() {
    for question in questions() {
        for part in halves(&question) {
            let bytes = part.to_bytes();
            assert!(Part::from_bytes("a.part", &bytes).unwrap().to_bytes() == bytes);
            assert!(read(&content(&part)).is_ok());
        }
    }
}

/// No number of a part is beyond what sums of errors can hold, wherever it stands.
#[test]
fn impossible_numbers_are_refused() {
    let [part, _] = halves(&questions()[0]);
    for pointer in
        ["/gathered/budget/position/tallies/0/largest/0", "/gathered/budget/position/squares/0/sums/0"]
    {
        for number in [1e308, -1e200] {
            let mut content = content(&part);
            *content.pointer_mut(pointer).unwrap() = number.into();
            refused(&content, "this part has the impossible number");
        }
    }
}

/// Holds that parts merge to the report of a single run; the calibration is one source of it.
#[test]
fn halves_merge_to_the_whole() {
    for question in questions() {
        let merged = |parts: Vec<Part>| {
            let parts = parts.into_iter().enumerate().map(|(i, part)| (i.to_string(), part)).collect();
            serde_json::to_value(merge(parts).unwrap()).unwrap()
        };
        let whole = merged(vec![Part::new(question.clone(), "1/1".parse().unwrap(), &mut ()).unwrap()]);
        assert_eq!(merged(halves(&question).into()), whole);
        let ledger = &whole["ledger"]["sources"];
        let is_calibrated = question.spec_text.is_some();
        assert_eq!(
            ledger.as_array().unwrap().len() == 2 && ledger[1]["name"] == "calibration",
            is_calibrated
        );
    }
}

#[test]
fn shards_and_draws_are_limited() {
    let [question, ..] = questions();
    let [part, _] = halves(&question);
    let with = |path: &str, value: Value| {
        let mut content = content(&part);
        *content.pointer_mut(path).unwrap() = value;
        content
    };
    for shard in ["1/4294967295", "1/100001", "0/2", "3/2", "1/0", "-1/2", "1/2/3", ""] {
        refused(&with("/shard", json!(shard)), "content that this version of abbe does not write");
    }
    refused(&with("/shard", json!({ "number": 1, "of": 4_294_967_295_u32 })), "content that this version");
    for draws in [json!(0), json!(10_000_001), json!(1_000_000_000_000_u64), json!(1_u64 << 63)] {
        refused(&with("/request/monte_carlo", draws), "must be between 1 and 10000000");
    }
    refused(&with("/request/monte_carlo", json!(-1)), "content that this version");
    let too_many = AnalysisRequest { monte_carlo: Some(10_000_001), ..question };
    let refused = Part::new(too_many, "1/1".parse().unwrap(), &mut ()).map(|_| ()).unwrap_err();
    assert!(refused.to_string().contains("between 1 and 10000000"), "{refused}");
}

/// Holds that a merge opens no file: tables and paths are those that part 1 carries, wherever the
/// spec and the study of a part say that they are.
#[cfg(target_os = "linux")]
#[test]
fn a_merge_opens_no_file() {
    use std::fs::{self, OpenOptions};
    use std::os::unix::fs::{OpenOptionsExt, symlink};
    const O_NONBLOCK: i32 = 0o4000;
    let folder = tempfile::tempdir().unwrap();
    let at = |name: &str| folder.path().join(name).to_str().unwrap().to_owned();
    let table = "x,y\n0,0\n100,0.1\n";
    let spec = CALIBRATED.to_owned()
        + "[tables.rail]\nfile = \"rail.csv\"\nx = { column = \"x\", unit = \"mm\" }\n\
           y = { column = \"y\", unit = \"mm\" }\ninterpolation = \"linear\"\n\
           [[source]]\nname = \"rail\"\nclass = \"repeatable\"\nframe = \"turn\"\ne_y = \"rail(d1)\"\n";
    let study = "[study]\ntitle = \"t\"\n[workspace.path]\nfile = \"path.csv\"\n";
    fs::write(at("rail.csv"), table).unwrap();
    fs::write(at("path.csv"), "d1 (mm)\n1\n2\n").unwrap();
    symlink(at("rail.csv"), at("link.csv")).unwrap();
    let pipe = at("pipe.csv");
    assert!(std::process::Command::new("mkfifo").arg(&pipe).status().unwrap().success());

    let text = |name: &str, text: String| FileText {
        name: at(name),
        folder: Some(folder.path().to_str().unwrap().to_owned()),
        text,
    };
    let [_, _, question] = questions();
    let question = AnalysisRequest {
        spec_text: Some(text("arm.toml", spec)),
        study: Some(text("arm.study.toml", study.to_owned())),
        ..question
    };
    let part = Part::new(question, "1/1".parse().unwrap(), &mut ()).unwrap();
    let content = content(&part);
    let merged = |content: &Value| merge(vec![("a.part".to_owned(), read(content).unwrap())]);
    let files = content["files"].as_object().unwrap();
    assert_eq!(files.values().collect::<Vec<_>>(), ["d1 (mm)\n1\n2\n", table]);

    let inside = format!("../{}/rail.csv", folder.path().file_name().unwrap().to_str().unwrap());
    for named in [&at("rail.csv"), "rail.csv", "link.csv", &inside, "/dev/zero", "/etc/passwd", &pipe] {
        for (document, file) in [("spec_text", "rail.csv"), ("study", "path.csv")] {
            let mut hostile = content.clone();
            let document = &mut hostile["request"][document]["text"];
            *document = json!(document.as_str().unwrap().replace(file, named));
            hostile["files"] = json!({});
            let refused = merged(&hostile).unwrap_err().to_string();
            assert!(refused.contains("not among those that come with the text"), "{named}: {refused}");
        }
        let mut hostile = content.clone();
        hostile["request"]["spec"] = json!(named);
        hostile["request"]["spec_text"] = Value::Null;
        let refused = merged(&hostile).unwrap_err().to_string();
        assert!(refused.contains("no shipped manipulator of this name"), "{named}: {refused}");
    }
    let mut changed = content.clone();
    for text in changed["files"].as_object_mut().unwrap().values_mut() {
        *text = json!(text.as_str().unwrap().replace("0.1", "0.2").replace("\n2\n", "\n3\n"));
    }
    let refused = merged(&changed).unwrap_err().to_string();
    assert!(refused.contains("not those that it was created from"), "{refused}");

    // Only a process that reads the pipe makes it possible to open it for writing at once.
    let opened = OpenOptions::new().write(true).custom_flags(O_NONBLOCK).open(&pipe);
    assert!(opened.is_err(), "somebody reads the pipe");

    let whole = serde_json::to_value(merged(&content).unwrap()).unwrap();
    drop(folder);
    assert_eq!(serde_json::to_value(merged(&content).unwrap()).unwrap(), whole);
}

/// Collects the paths of all values.
fn paths(value: &Value, path: &str, all: &mut Vec<String>) {
    all.push(path.to_owned());
    match value {
        Value::Array(list) => {
            list.iter().enumerate().for_each(|(i, value)| paths(value, &format!("{path}/{i}"), all));
        }
        Value::Object(map) => {
            map.iter().for_each(|(key, value)| paths(value, &format!("{path}/{key}"), all));
        }
        _ => {}
    }
}

/// Damages a value: extreme numbers, fewer or more entries, other keys.
fn damage(value: &mut Value, random: &mut Xoshiro256PlusPlus) {
    let integers = [0, 1, 31, 63, 64, 1 << 31, 1 << 32, 1 << 53, 1 << 62, u64::MAX / 2, u64::MAX];
    let numbers = [0.0, -1.0, 1e308, -1e308, 1e-308, f64::MAX, f64::MIN];
    match value {
        Value::Number(_) if random.random_bool(0.8) && !value.is_f64() => {
            *value = json!(integers[random.random_range(0..integers.len())]);
        }
        Value::Number(_) => *value = json!(numbers[random.random_range(0..numbers.len())]),
        Value::Array(list) if list.is_empty() || random.random_bool(0.3) => list.clear(),
        Value::Array(list) if random.random_bool(0.5) => list.extend_from_within(..),
        Value::Array(list) => _ = list.pop(),
        Value::Object(map) => {
            if let Some((key, content)) = map.clone().into_iter().next() {
                let others = ["-9223372036854775808", "9223372036854775807", "18446744073709551615", "0"];
                map.remove(&key);
                map.insert(others[random.random_range(0..others.len())].to_owned(), content);
            }
        }
        Value::Null => *value = json!(1_u64 << 40),
        _ => *value = Value::Null,
    }
}

#[test]
fn a_damaged_part_merges_or_is_refused() {
    let times = sample_size(150);
    let mut random = Xoshiro256PlusPlus::seed_from_u64(32);
    let (mut merged, mut refused) = (0, 0);
    for question in questions() {
        let [one, other] = halves(&question);
        let content = content(&one);
        let mut all = Vec::new();
        paths(&content["gathered"], "/gathered", &mut all);
        for _ in 0..times {
            let mut damaged = content.clone();
            let path = &all[random.random_range(0..all.len())];
            damage(damaged.pointer_mut(path).unwrap(), &mut random);
            let parts =
                read(&damaged).map(|part| vec![("a".to_owned(), part), ("b".to_owned(), other.clone())]);
            match parts.and_then(merge) {
                Ok(_) => merged += 1,
                Err(mistakes) => {
                    refused += 1;
                    assert!(mistakes.list.iter().all(|mistake| mistake.help.is_some()), "{path}: {mistakes}");
                }
            }
        }
    }
    assert!(merged > times / 10 && refused > times / 10, "{merged} {refused}");
}

#[test]
fn more_than_one_run_sweeps_is_swept_in_parts() {
    let [question, ..] = questions();
    let large = |samples: &str| {
        let text = format!("[study]\ntitle = \"t\"\n[workspace.random]\nsamples = {samples}\nseed = 3\n");
        let study = Some(FileText { name: "study.toml".to_owned(), folder: None, text });
        AnalysisRequest { study, figures: false, monte_carlo: None, ..question.clone() }
    };
    let refused =
        large("3_000_000_001").job(&mut ()).unwrap().run(&mut ()).map(|_| ()).unwrap_err().to_string();
    assert!(refused.contains("3000000001 configurations are more than one run sweeps"), "{refused}");
    assert!(refused.contains("`abbe analyze pps --shard 1/4 --out FILE`"), "{refused}");
    assert!(Part::new(large("3_000_000_001"), "1/2".parse().unwrap(), &mut ()).is_err());
    // Nothing takes longer because the study is large: its last part, in whole chunks.
    let last = Part::new(large("10_000_000_000"), "100000/100000".parse().unwrap(), &mut ()).unwrap();
    let [reached, unreachable] = last.configurations();
    assert!((reached + unreachable).abs_diff(100_000) < 10_000, "{reached} {unreachable}");
    assert!(last.to_bytes().len() < 30_000, "{}", last.to_bytes().len());
}
