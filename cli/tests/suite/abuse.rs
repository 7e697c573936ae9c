//! Inputs that once broke the command, and a sample of damaged files: every run ends, refusals have
//! a cause and a remedy, and files stay unchanged.

use std::fs;
use std::path::Path;

use abbe_tests::abuse::{Choices, damaged, damaged_table};
use tempfile::tempdir;

use crate::running::{Run, ends, shipped, write};

const MAP: &str = r#"
[data]
uncertainty = "0.05 mm"
base = "unknown"
[joints]
q1 = { column = "q1", unit = "deg" }
q2 = { column = "q2", unit = "deg" }
d3 = { column = "d3", unit = "mm" }
q4 = { column = "q4", unit = "deg" }
[point]
columns = ["x", "y", "z"]
unit = "mm"
"#;

/// Returns a spec with one frame.
fn arm(transform: &str) -> String {
    format!(
        "[manipulator]\nname = \"arm\"\nlength = \"mm\"\n[[frame]]\nname = \"f\"\n\
         variable = {{ name = \"q1\", kind = \"revolute\", limits = [-1, 1] }}\ntransform = \"{transform}\"\n\
         [tool]\ntransform = \"Tx(100)\"\n[[source]]\nname = \"rail\"\nclass = \"repeatable\"\nframe = \"f\"\ne_y = \"0.1 mm\"\n"
    )
}

/// Runs the command. Asserts that it ends, and that a refusal has a place and a help line.
fn run(arguments: &[&str]) -> Run {
    let (run, _) = ends(arguments, None);
    match run.status {
        0 | 1 => {}
        2 => assert!(
            ["error: ", "--> ", "help: "].iter().all(|part| run.stderr.contains(part))
                && run.stdout.is_empty(),
            "{arguments:?}: {}",
            run.stderr
        ),
        other => panic!("{arguments:?} ends with {other}: {}", run.stderr),
    }
    run
}

fn refused(arguments: &[&str], said: &str) {
    let run = run(arguments);
    assert_eq!(run.status, 2, "{arguments:?}: {}", run.stdout);
    assert!(run.stderr.contains(said), "{arguments:?}: {said}\n{}", run.stderr);
}

fn path(path: &Path) -> &str {
    path.to_str().unwrap()
}

/// Simulates measurements of the shipped SCARA.
fn measurements(folder: &Path) -> (String, String) {
    let map = write(folder, "map.toml", MAP);
    let data = folder.join("data.csv");
    let run = run(&["simulate", "scara", "--map", path(&map), "--samples", "40", "--out", path(&data)]);
    assert_eq!(run.status, 0, "{}", run.stderr);
    (path(&map).to_owned(), fs::read_to_string(data).unwrap())
}

/// Replaces the last cell of one row.
fn with_cell(data: &str, cell: &str) -> String {
    let mut lines: Vec<String> = data.lines().map(str::to_owned).collect();
    let (before, _) = lines[7].rsplit_once(',').unwrap();
    lines[7] = format!("{before},{cell}");
    lines.join("\n") + "\n"
}

#[test]
fn sines_of_sines_are_generated() {
    let folder = tempdir().unwrap();
    let spec = write(folder.path(), "arm.toml", &arm("Rz(sin(q1)) Ty(3 mm*cos(sin(q1)))"));
    for language in ["rust", "js"] {
        assert_eq!(run(&["generate", path(&spec), "--lang", language]).status, 0);
    }
}

#[test]
fn what_is_far_too_large_is_refused_where_it_is_read() {
    let folder = tempdir().unwrap();
    let spec = write(folder.path(), "arm.toml", &arm("Rz(q1) Tx(1e200)"));
    for command in ["check", "analyze", "jacobian", "generate"] {
        refused(&[command, path(&spec)], "arm.toml:7:");
    }
    refused(&["jacobian", "ur5", "--q", "1e200,0,0,0,0,0"], "--q:1:1");
    refused(&["analyze", "pps", "--set", "z_offset=1e200mm"], "too large to compute with");
    refused(&["jacobian", "pps", "--set", "arm_EI=0"], "the source \"arm deflection\" has no finite value");
    let blamed = run(&["jacobian", "pps", "--set", "arm_EI=0"]).stderr;
    assert!(blamed.contains("at d1 = ") && !blamed.contains("assembly"), "{blamed}");
}

#[test]
fn one_cell_holds_nothing_up() {
    let folder = tempdir().unwrap();
    let (map, data) = measurements(folder.path());
    for (cell, said) in
        [("1e300", Some("the maximum is 1e150")), ("1e150", None), ("1e149", None), ("1e75", None)]
    {
        let file = write(folder.path(), "wild.csv", &with_cell(&data, cell));
        for command in ["measure", "identify"] {
            let run = run(&[command, "scara", path(&file), "--map", &map]);
            let all = format!("{}{}", run.stdout, run.stderr);
            assert!(said.is_none_or(|said| all.contains(said)), "{command}: {all}");
        }
    }
}

#[cfg(target_os = "linux")]
#[test]
fn what_never_ends_is_not_read_to_its_end() {
    let folder = tempdir().unwrap();
    let (map, _) = measurements(folder.path());
    refused(&["check", "/dev/zero"], "larger than 4 MiB");
    refused(&["measure", "scara", "/dev/zero", "--map", &map], "not a text file");
    refused(&["measure", "scara", path(folder.path()), "--map", &map], "directory");
    let study = "[study]\ntitle = \"Path\"\n[workspace.path]\nfile = \"/dev/zero\"\n";
    let study = write(folder.path(), "study.toml", study);
    refused(
        &["analyze", "scara", "--study", path(&study)],
        "/dev/zero: the row in line 1 is longer than 4 MiB",
    );
    // An unclosed quotation mark.
    let file =
        write(folder.path(), "open.csv", &format!("q1,q2,d3,q4,x,y,z\n1,\"{}", "2,3\n".repeat(2_000_000)));
    refused(&["measure", "scara", path(&file), "--map", &map], "is longer than 4 MiB");
}

#[test]
fn files_of_another_kind_are_called_by_their_names() {
    let folder = tempdir().unwrap();
    let (map, data) = measurements(folder.path());
    let utf_16: Vec<u8> = format!("\u{feff}{data}").encode_utf16().flat_map(u16::to_le_bytes).collect();
    for (bytes, said) in [
        (&b"\x1f\x8b\x08\x00\x00\x00\x00\x00"[..], "compressed by gzip"),
        (&utf_16, "text in UTF-16"),
        (MAP.as_bytes(), "it seems to be TOML"),
    ] {
        let file = folder.path().join("data.csv");
        fs::write(&file, bytes).unwrap();
        refused(&["measure", "scara", path(&file), "--map", &map], said);
    }
    let code = write(folder.path(), "arm.rs", "//! An arm.\nuse abbe::Pose;\n");
    refused(&["check", path(&code)], "it seems to be source code");
}

/// A subnormal σ: its reciprocal overflowed, and the decomposition of the weighted rows did not
/// end.
#[test]
fn uncertainties_that_nothing_can_be_weighted_with() {
    let folder = tempdir().unwrap();
    let map = write(folder.path(), "m.toml", &MAP.replace("0.05 mm", "5e-324 mm"));
    refused(
        &["plan", "scara", "--map", map.to_str().unwrap(), "--optimal", "20"],
        "too small to compute with",
    );
}

#[test]
fn damaged_files() {
    let folder = tempdir().unwrap();
    let (_, data) = measurements(folder.path());
    let files = [("spec.toml", shipped("scara")), ("map.toml", MAP), ("data.csv", &data)];
    for seed in 0..36 {
        let mut c = Choices::seeded(seed);
        let (which, mut paths) = (seed as usize % 3, Vec::new());
        for (i, (name, whole)) in files.iter().enumerate() {
            let bytes = match (i == which, i) {
                (true, 2) => damaged_table(&mut c, whole.as_bytes()),
                (true, _) => damaged(&mut c, whole.as_bytes()),
                _ => whole.as_bytes().to_vec(),
            };
            let file = folder.path().join(name);
            fs::write(&file, &bytes).unwrap();
            paths.push((path(&file).to_owned(), bytes));
        }
        let [spec, map, data] = [0, 1, 2].map(|i| paths[i].0.as_str());
        let ended = match seed % 5 {
            0 => run(&["jacobian", spec, "--json"]),
            1 => run(&["measure", spec, data, "--map", map, "--json"]),
            2 => run(&["compensate", spec, data, "--map", map, "--json"]),
            3 => run(&["identify", spec, data, "--map", map, "--folds", "3", "--json"]),
            _ => run(&["simulate", spec, "--map", map, "--samples", "5"]),
        };
        if ended.status != 2 {
            let is_number = |letter: char| letter.is_alphanumeric() || letter == '∞';
            for word in ended.stdout.split(|letter| !is_number(letter)) {
                assert!(!["NaN", "inf", "∞"].contains(&word), "{seed}: {word} in {}", ended.stdout);
            }
        }
        for (file, bytes) in &paths {
            assert!(fs::read(file).unwrap() == *bytes, "{seed}: {file} has changed");
        }
    }
}
