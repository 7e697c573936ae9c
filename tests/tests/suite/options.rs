//! Options in sentences: values, which each front end words in its way.

use std::fs;
use std::path::Path;

use super::voice::sources;

/// Returns `true` if a line of code has the text of an option: two dashes and a letter after a
/// quote, a backquote, a parenthesis or a space.
fn has_option(line: &str) -> bool {
    let code = line.trim_start();
    let mut rest = if code.starts_with("//") { "" } else { code };
    while let Some((before, after)) = rest.split_once("--") {
        let begins = before.ends_with(['"', '`', ' ', '(']) || before.is_empty();
        if begins && after.starts_with(|letter: char| letter.is_ascii_lowercase()) {
            return true;
        }
        rest = after;
    }
    false
}

#[test]
fn sentences_have_options_as_values() {
    assert!(has_option("\"try `--robust tukey`\"") && !has_option("/// `--q`") && !has_option("a--b"));
    let mut found = Vec::new();
    for folder in ["spec", "exchange", "calibration", "bound", "study", "metrology", "report"] {
        let mut files = Vec::new();
        sources(&Path::new("..").join(folder).join("src"), &mut files);
        // The table of options, what the reference of the files says, and tests.
        let is_exempt = |file: &Path| {
            file.ends_with("option.rs")
                || file.ends_with("tests.rs")
                || file.components().any(|one| one.as_os_str() == "explore")
        };
        for file in files.into_iter().filter(|file| !is_exempt(file)) {
            let text = fs::read_to_string(&file).unwrap();
            let code = text.split("#[cfg(test)]\nmod tests").next().unwrap_or_default();
            let lines = (1..).zip(code.lines()).filter(|(_, line)| has_option(line));
            found.extend(lines.map(|(number, line)| format!("{}:{number}: {}", file.display(), line.trim())));
        }
    }
    assert!(found.is_empty(), "name options by `abbe_spec::option`:\n{}", found.join("\n"));
}
