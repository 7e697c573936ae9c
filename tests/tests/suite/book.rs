//! The book in `docs`: its tables of contents have every chapter, and every relative link leads to
//! a file and a heading.

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

/// Returns the targets of relative links; code is no text.
fn links(text: &str) -> Vec<&str> {
    let prose = text.split("```").step_by(2).flat_map(|prose| prose.split("](").skip(1));
    let targets = prose.filter_map(|rest| rest.split(')').next());
    targets.filter(|target| !target.contains("://")).collect()
}

/// Returns the names by which links find the headings of a page.
fn anchors(text: &str) -> Vec<String> {
    let prose = text.split("```").step_by(2).flat_map(str::lines);
    let headings = prose.filter(|line| line.starts_with('#')).map(|line| line.trim_start_matches('#').trim());
    let kept = |c: &char| c.is_alphanumeric() || "-_ ".contains(*c);
    headings
        .map(|heading| heading.to_lowercase().chars().filter(kept).collect::<String>().replace(' ', "-"))
        .collect()
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
fn every_relative_link_leads_to_a_file_and_a_heading() {
    let others = ["README.md", "llms.txt"].map(|name| docs().join("..").join(name));
    let mut checked = 0;
    for path in chapters(&docs()).into_iter().chain(others) {
        let text = fs::read_to_string(&path).expect("a chapter");
        for link in links(&text) {
            let (file, heading) = link.split_once('#').unwrap_or((link, ""));
            let target =
                if file.is_empty() { path.clone() } else { path.parent().expect("a folder").join(file) };
            assert!(target.exists(), "{}: {link}", path.display());
            if !heading.is_empty() {
                let headings = anchors(&fs::read_to_string(target).expect("a chapter"));
                assert!(headings.iter().any(|anchor| anchor == heading), "{}: {link}", path.display());
            }
            checked += 1;
        }
    }
    assert!(checked > 50, "{checked}");
}
