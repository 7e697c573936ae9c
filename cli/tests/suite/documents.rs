//! The documents show the output of the command: every `$ abbe …` in `docs/` is run, and the lines
//! below it must appear in its output in that order.

use std::fs;
use std::path::Path;

use super::running::command;

/// Returns the fenced blocks of a document: language and text.
pub(crate) fn blocks(text: &str) -> Vec<(&str, &str)> {
    text.split("```").skip(1).step_by(2).filter_map(|block| block.split_once('\n')).collect()
}

#[test]
fn what_they_show_is_what_is_printed() {
    let mut run = 0;
    let pages = fs::read_dir(Path::new(env!("CARGO_MANIFEST_DIR")).join("../docs")).unwrap();
    let pages =
        pages.map(|entry| entry.unwrap().path()).filter(|path| path.extension().is_some_and(|e| e == "md"));
    let readme = Path::new(env!("CARGO_MANIFEST_DIR")).join("../README.md");
    for page in pages.chain([readme]) {
        // Each chapter has its own files.
        let folder = tempfile::tempdir().unwrap();
        let text = fs::read_to_string(page).unwrap();
        for (language, block) in blocks(&text) {
            // The first line of a file names it.
            let first = block.lines().next().unwrap_or_default();
            let name = match language {
                "toml" | "csv" => first.strip_prefix("# "),
                "xml" => first.strip_prefix("<!-- ").and_then(|line| line.strip_suffix(" -->")),
                _ => None,
            };
            if let Some(name) = name {
                fs::write(folder.path().join(name), block).unwrap();
            }
            if language == "console" {
                shown(block, folder.path());
                run += 1;
            }
        }
    }
    assert!(run >= 4);
}

/// The counts in the chapter are those of the plan file.
#[test]
fn counts_in_sentences_are_those_of_the_plan() {
    let text = include_str!("../../../docs/from-measurements-to-a-spec.md");
    let (_, plan) = text.split_once("They determine ").unwrap();
    let numbers = plan.split(|c: char| !c.is_ascii_digit()).filter_map(|number| number.parse::<usize>().ok());
    let [known, of] = numbers.take(2).collect::<Vec<_>>()[..] else { panic!("{plan}") };
    let sentence = format!("\n{known} of {of}, before anything is measured: the other {} act", of - known);
    assert!(plan.contains(&sentence), "{sentence}");
}

fn shown(block: &str, folder: &Path) {
    let mut lines = block.lines();
    let line = lines.next().and_then(|line| line.strip_prefix("$ abbe ")).expect("a command");
    let output = command(&shell_words::split(line).unwrap()).current_dir(folder).output().unwrap();
    let printed = String::from_utf8(output.stdout).unwrap();
    assert!(output.status.success(), "{line}: {}", String::from_utf8_lossy(&output.stderr));
    let mut rest = printed.lines();
    for expected in lines {
        assert!(
            rest.any(|found| found == expected),
            "{line}\ndoes not print, or not there:\n{expected}\nbut\n{printed}"
        );
    }
}
