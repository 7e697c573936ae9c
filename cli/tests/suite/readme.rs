//! The README: its spec and its commands work. The spec and the code of `docs/in-your-program.md`
//! are those of the example crate.

use std::fs;
use std::path::{Path, PathBuf};

use super::running::{command, full, json};

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..")
}

/// Returns the blocks of this language in a document, without their fences.
fn blocks(document: &str, language: &str) -> Vec<String> {
    let text = fs::read_to_string(root().join(document)).unwrap();
    let fenced = text.split("```").skip(1).step_by(2);
    let blocks =
        fenced.filter_map(|block| block.strip_prefix(language)?.strip_prefix('\n')).map(str::to_owned);
    blocks.collect()
}

fn example(file: &str) -> String {
    fs::read_to_string(root().join("tests/examples/own-robot").join(file)).unwrap()
}

/// Returns the spec of the example crate: an arm with a parameter, an input and two sources.
pub(crate) fn spec() -> String {
    example("specs/arm.toml")
}

#[test]
fn code_of_the_chapter_is_that_of_the_example() {
    let chapter = "docs/in-your-program.md";
    assert_eq!(blocks(chapter, "toml")[0], spec());
    let code = blocks(chapter, "rust,ignore");
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
    fs::write(&path, &blocks("README.md", "toml")[0]).unwrap();
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
fn it_fits_130_lines() {
    let lines = fs::read_to_string(root().join("README.md")).unwrap().lines().count();
    assert!(lines <= 130, "{lines}");
}

#[test]
fn its_commands_run() {
    let folder = tempfile::tempdir().unwrap();
    for sub in ["specs", "src"] {
        fs::create_dir(folder.path().join(sub)).unwrap();
    }
    fs::write(folder.path().join("specs/arm.toml"), &blocks("README.md", "toml")[0]).unwrap();
    let lines: Vec<String> = blocks("README.md", "text").concat().lines().map(str::to_owned).collect();
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

#[test]
fn commands_in_the_table_of_the_chapter_run() {
    let folder = tempfile::tempdir().unwrap();
    for sub in ["specs", "src"] {
        fs::create_dir(folder.path().join(sub)).unwrap();
    }
    fs::write(folder.path().join("specs/arm.toml"), spec()).unwrap();
    let chapter = fs::read_to_string(root().join("docs/in-your-program.md")).unwrap();
    let commands = chapter.lines().filter_map(|line| line.strip_prefix("| `abbe ")?.split('`').next());
    let mut run = 0;
    for line in commands {
        let words: Vec<&str> = line.split_whitespace().collect();
        let output = command(&words).current_dir(folder.path()).output().unwrap();
        assert!(output.status.success(), "{line}: {}", String::from_utf8_lossy(&output.stderr));
        assert!(folder.path().join(words[words.len() - 1]).exists(), "{line}");
        run += 1;
    }
    assert_eq!(run, 8);
}
