//! The README: its spec and its commands work, and its code is that of the example crate.

use std::fs;
use std::path::{Path, PathBuf};

use super::running::{command, full, json};

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..")
}

/// Returns the blocks of this language, without their fences.
fn blocks(language: &str) -> Vec<String> {
    let readme = fs::read_to_string(root().join("README.md")).unwrap();
    let fenced = readme.split("```").skip(1).step_by(2);
    let blocks =
        fenced.filter_map(|block| block.strip_prefix(language)?.strip_prefix('\n')).map(str::to_owned);
    blocks.collect()
}

fn example(file: &str) -> String {
    fs::read_to_string(root().join("tests/examples/own-robot").join(file)).unwrap()
}

/// Returns the spec in the README.
pub(crate) fn spec() -> String {
    blocks("toml").swap_remove(0)
}

#[test]
fn its_code_is_that_of_the_example() {
    assert_eq!(blocks("toml")[0], example("specs/arm.toml"));
    let code = blocks("rust,ignore");
    assert_eq!(code[0], format!("// build.rs\n{}", example("build.rs")));
    let main = code[1].strip_prefix("// src/main.rs\n").unwrap();
    assert!(example("src/main.rs").starts_with(main));
}

/// 20 µrad × 850 mm with the arm stretched: the lever begins at the axis of the shoulder, not at
/// the elbow.
#[test]
fn its_shoulder_encoder_turns_about_the_shoulder() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("arm.toml");
    fs::write(&path, &blocks("toml")[0]).unwrap();
    let path = path.to_str().unwrap();
    let report = json(&["analyze", path, "--json"]);
    let encoder = &report["sources"][0];
    assert_eq!(
        (encoder["name"].as_str(), encoder["at"].as_str()),
        (Some("shoulder encoder"), Some("joint q2"))
    );
    let norm = encoder["plain_max"]["norm"].as_f64().unwrap();
    assert!((norm - 0.0170).abs() < 1e-5, "{norm}");
    assert_eq!(json(&["check", path, "--json"])["notes"].as_array().map(Vec::len), Some(0));
    // As an error of the frame it differs, and a message says so.
    let spec = fs::read_to_string(path).unwrap();
    let start = spec.find("joint = \"q2\"").unwrap();
    let end = spec[start..].find("error = \"20e-6\"").unwrap() + start;
    let other = format!("{}frame = \"shoulder\"\ne_r{}", &spec[..start], &spec[end + "error".len()..]);
    fs::write(path, other).unwrap();
    let note = "`shoulder encoder` at shoulder rotates about an axis 400 mm from that of q2; for an error of the \
                joint itself, write `joint = \"q2\"`.";
    assert_eq!(json(&["check", path, "--json"])["notes"][0], note);
    let text = full(&["check", path]).split_whitespace().collect::<Vec<_>>().join(" ");
    assert!(text.contains(note), "{text}");
}

#[test]
fn its_commands_run() {
    let folder = tempfile::tempdir().unwrap();
    for sub in ["specs", "src"] {
        fs::create_dir(folder.path().join(sub)).unwrap();
    }
    fs::write(folder.path().join("specs/arm.toml"), &blocks("toml")[0]).unwrap();
    let lines: Vec<String> = blocks("text").concat().lines().map(str::to_owned).collect();
    let mut commands: Vec<&str> = lines.iter().filter_map(|line| line.strip_prefix("abbe ")).collect();
    let main_job = lines.iter().find_map(|line| line.strip_prefix("cargo run --release -- ")).unwrap();
    let generate = "generate specs/arm.toml --lang rust --out src/arm.rs";
    assert!(fs::read_to_string(root().join("README.md")).unwrap().contains(&format!("`abbe {generate}`")));
    commands.extend([main_job, generate, "list"]);
    assert!(commands.len() >= 6);
    for line in commands {
        let words: Vec<&str> = line.split('#').next().unwrap().split_whitespace().collect();
        let output = command(&words).current_dir(folder.path()).output().unwrap();
        assert!(output.status.success(), "{line}: {}", String::from_utf8_lossy(&output.stderr));
    }
    assert!(folder.path().join("src/arm.rs").exists());
}
