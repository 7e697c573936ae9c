//! The documents show the output of the command: every `$ abbe …` in `docs/` is run, and the lines
//! below it must appear in its output in that order. The pictures of a chapter are files that its
//! commands write. `UPDATE_EXPECT=1` writes lines and pictures anew: look at the diff.

use std::collections::BTreeSet;
use std::fs::{self, OpenOptions};
use std::io::Write as _;
use std::path::{MAIN_SEPARATOR, Path};

use expect_test::expect_file;

use super::running::command;

/// Returns the fenced blocks of a document: language and text.
pub(crate) fn blocks(text: &str) -> Vec<(&str, &str)> {
    text.split("```").skip(1).step_by(2).filter_map(|block| block.split_once('\n')).collect()
}

#[test]
fn what_they_show_is_what_is_printed() {
    let (mut run, mut pictures) = (0, 0);
    let pages = fs::read_dir(Path::new(env!("CARGO_MANIFEST_DIR")).join("../docs")).unwrap();
    let pages =
        pages.map(|entry| entry.unwrap().path()).filter(|path| path.extension().is_some_and(|e| e == "md"));
    let readme = Path::new(env!("CARGO_MANIFEST_DIR")).join("../README.md");
    for page in pages.chain([readme]) {
        // Each chapter has its own files.
        let folder = tempfile::tempdir().unwrap();
        let text = fs::read_to_string(&page).unwrap();
        let mut new = text.clone();
        for (language, block) in blocks(&text) {
            // The first line of a file names it.
            let first = block.lines().next().unwrap_or_default();
            let name = match language {
                "toml" | "csv" => first.strip_prefix("# "),
                "rapid" => first.strip_prefix("! "),
                "xml" => first.strip_prefix("<!-- ").and_then(|line| line.strip_suffix(" -->")),
                _ => None,
            };
            if let Some(name) = name.and_then(|name| name.strip_prefix("at the end of ")) {
                let path = folder.path().join(name);
                let mut file = OpenOptions::new().append(true).open(path).unwrap();
                write!(file, "\n{block}").unwrap();
            } else if let Some(name) = name {
                fs::write(folder.path().join(name), block).unwrap();
            }
            if language == "console" {
                let fenced = |block: &str| format!("```console\n{block}```");
                new = new.replace(&fenced(block), &fenced(&refreshed(block, folder.path())));
                run += 1;
            }
        }
        expect_file![page].assert_eq(&new);
        let linked = text.split("](pictures/").skip(1).filter_map(|rest| rest.split(')').next());
        for picture in linked.filter(|picture| !picture.starts_with("gallery/")) {
            let written = fs::read_to_string(folder.path().join(picture)).unwrap();
            let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../docs/pictures").join(picture);
            expect_file![path].assert_eq(&written);
            pictures += 1;
        }
    }
    assert!(run >= 100 && pictures >= 1, "{run} commands, {pictures} pictures");
}

/// The counts in the chapter are those of the plan file.
#[test]
fn counts_in_sentences_are_those_of_the_plan() {
    let text = include_str!("../../../docs/from-measurements-to-a-spec.md");
    let (_, plan) = text.split_once(" rows determine ").unwrap();
    let numbers = plan.split(|c: char| !c.is_ascii_digit()).filter_map(|number| number.parse::<usize>().ok());
    let [known, of] = numbers.take(2).collect::<Vec<_>>()[..] else { panic!("{plan}") };
    let sentence = format!("\n{known} of {of}, before anything is measured: the other {} act", of - known);
    assert!(plan.contains(&sentence), "{sentence}");
}

/// Runs the command of a block, and returns the block with the lines that it prints, in their
/// order: a line that is not printed becomes the most similar one, or disappears if none has half
/// of its words.
fn refreshed(block: &str, folder: &Path) -> String {
    let mut lines = block.lines();
    let first = lines.next().unwrap_or_default();
    let line = first.strip_prefix("$ abbe ").expect("a command");
    let output = command(&shell_words::split(line).unwrap()).current_dir(folder).output().unwrap();
    // Pages have slashes in paths.
    let printed = String::from_utf8(output.stdout).unwrap().replace(MAIN_SEPARATOR, "/");
    assert!(output.status.success(), "{line}: {}", String::from_utf8_lossy(&output.stderr));
    let printed: Vec<&str> = printed.lines().collect();
    let (mut shown, mut next) = (BTreeSet::new(), 0);
    for expected in lines {
        let exact = |from: usize| (from..printed.len()).find(|i| printed[*i] == expected);
        let similar = |from: usize| {
            let is_similar =
                |i: &usize| 2 * common_words(expected, printed[*i]) > expected.split_whitespace().count();
            let best = (from..printed.len()).rev().max_by_key(|i| common_words(expected, printed[*i]));
            best.filter(is_similar)
        };
        if let Some(found) = exact(next).or_else(|| exact(0)).or_else(|| similar(next)).or_else(|| similar(0))
        {
            shown.insert(found);
            next = found + 1;
        }
    }
    format!("{first}\n{}", shown.into_iter().map(|i| format!("{}\n", printed[i])).collect::<String>())
}

/// Counts the words of a line that another line has, too.
fn common_words(line: &str, other: &str) -> usize {
    line.split_whitespace().filter(|word| other.split_whitespace().any(|found| found == *word)).count()
}
