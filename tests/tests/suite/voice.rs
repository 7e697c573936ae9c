//! Comments keep the house style: doc comments begin with a verb or a noun, lines fit 100 columns,
//! and function names say more than `of`.

use std::fs;
use std::path::{Path, PathBuf};

/// Words that no doc comment begins with.
const BANNED: [&str; 16] = [
    "What", "How", "Whether", "Of", "By", "Which", "Who", "Whose", "Where", "As", "From", "With", "Those",
    "That", "If", "When",
];
/// Longest line of a comment, in characters.
const WIDTH: usize = 100;

/// Collects the Rust sources below a folder, except build artifacts.
pub(crate) fn sources(folder: &Path, found: &mut Vec<PathBuf>) {
    for entry in fs::read_dir(folder).expect("a folder of sources").flatten() {
        let (path, name) = (entry.path(), entry.file_name());
        if path.is_dir() && name != "target" && !name.to_string_lossy().starts_with('.') {
            sources(&path, found);
        } else if path.extension().is_some_and(|kind| kind == "rs") {
            found.push(path);
        }
    }
}

/// Returns the text of a comment line, if it is one, and whether it is documentation.
fn comment(line: &str) -> Option<(&str, bool)> {
    let text = line.trim_start().strip_prefix("//")?;
    let documentation = text.strip_prefix(['/', '!']);
    Some((documentation.unwrap_or(text).trim_start(), documentation.is_some()))
}

/// Returns whether a comment can be wrapped: tables, aligned formulas, code and links cannot.
fn is_prose(words: &str) -> bool {
    !words.starts_with(['|', '#'])
        && !["    ", "://", "assert", "println", "::{", " = "].iter().any(|mark| words.contains(mark))
}

/// Returns the faults of a source, each with the number of its line.
fn faults(text: &str) -> Vec<String> {
    let mut faults = Vec::new();
    let mut inside = false;
    for (number, line) in (1..).zip(text.lines()) {
        let mut fault = |what: &str| faults.push(format!("{number}: {what}: {}", line.trim()));
        let found = comment(line);
        let documentation = found.is_some_and(|(_, documentation)| documentation);
        if let Some((words, true)) = found
            && !inside
        {
            let first = words.split(' ').next().unwrap_or_default();
            if BANNED.contains(&first) || words.starts_with("The same ") {
                fault("begin with a verb or a noun");
            }
        }
        if found.is_some_and(|(words, _)| is_prose(words)) && line.chars().count() > WIDTH {
            fault("wrap at 100 columns");
        }
        if line.contains("fn of(") || line.contains("fn of<") {
            fault("name what it returns");
        }
        inside = documentation;
    }
    faults
}

#[test]
fn comments_are_in_the_house_style() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let mut files = Vec::new();
    sources(&root, &mut files);
    assert!(files.len() > 500, "{}", files.len());
    let mut all = Vec::new();
    // Generated code repeats texts of specs.
    let is_ours =
        |path: &&PathBuf| !path.ends_with("suite/voice.rs") && !path.starts_with(root.join("tests/golden"));
    for path in files.iter().filter(is_ours) {
        let text = fs::read_to_string(path).expect("a source file");
        let name = path.strip_prefix(&root).expect("below the root").display();
        all.extend(faults(&text).into_iter().map(|fault| format!("{name}:{fault}")));
    }
    assert!(all.is_empty(), "{} faults\n{}", all.len(), all.join("\n"));
}

#[test]
fn faults_are_found() {
    let text = "/// What it is.\n/// How it is.\nfn of(x: f64) {}\n// What counts.\n/// Returns it.\n/// What follows.\nfn f() {}\n";
    let found = faults(text);
    assert_eq!(found.len(), 2, "{found:?}");
    assert!(found[0].starts_with("1: begin") && found[1].starts_with("3: name"), "{found:?}");
    assert_eq!(faults(&format!("// {}\n", "x".repeat(98))).len(), 1);
}
