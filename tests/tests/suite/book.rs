//! The book in `docs`: its tables of contents have every chapter, and every relative link leads to
//! a file.

use std::fs;
use std::path::{Path, PathBuf};

fn docs() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../docs")
}

/// Returns the chapters below a folder.
fn chapters(folder: &Path) -> Vec<PathBuf> {
    let paths = fs::read_dir(folder).expect("a folder").flatten().map(|entry| entry.path());
    let mut found = Vec::new();
    for path in paths {
        if path.is_dir() {
            found.extend(chapters(&path));
        } else if path.extension().is_some_and(|kind| kind == "md") {
            found.push(path);
        }
    }
    found
}

/// Returns the targets of relative links, without fragments; code is no text.
fn links(text: &str) -> Vec<&str> {
    let prose = text.split("```").step_by(2).flat_map(|prose| prose.split("](").skip(1));
    let targets = prose.filter_map(|rest| rest.split([')', '#']).next());
    targets.filter(|target| !target.is_empty() && !target.contains("://")).collect()
}

#[test]
fn every_chapter_is_in_the_table_of_contents() {
    let summary = fs::read_to_string(docs().join("SUMMARY.md")).expect("a summary");
    let index = fs::read_to_string(docs().join("README.md")).expect("an index");
    let list = fs::read_to_string(docs().join("../llms.txt")).expect("a list");
    let chapters = chapters(&docs());
    assert!(chapters.len() > 25, "{}", chapters.len());
    for path in chapters {
        let name = path.strip_prefix(docs()).expect("below docs").to_str().expect("ASCII").to_owned();
        if name != "SUMMARY.md" {
            assert!(summary.contains(&format!("]({name})")), "{name} is not in SUMMARY.md");
            assert!(list.contains(&format!("](docs/{name})")), "{name} is not in llms.txt");
            assert!(
                name == "README.md" || index.contains(&format!("]({name})")),
                "{name} is not in README.md"
            );
        }
    }
}

#[test]
fn every_relative_link_leads_to_a_file() {
    let others = ["README.md", "llms.txt"].map(|name| docs().join("..").join(name));
    let mut checked = 0;
    for path in chapters(&docs()).into_iter().chain(others) {
        let text = fs::read_to_string(&path).expect("a chapter");
        for link in links(&text) {
            let target = path.parent().expect("a folder").join(link);
            assert!(target.exists(), "{}: {link}", path.display());
            checked += 1;
        }
    }
    assert!(checked > 50, "{checked}");
}
