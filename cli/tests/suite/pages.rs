//! The pages of `identify`, `compensate` and `measure`: self-contained and reproducible.

use std::fs;
use std::path::Path;

use tempfile::tempdir;

use crate::report::is_alone;
use crate::running::{abbe, full, prints};

fn path(path: &Path) -> &str {
    path.to_str().expect("a path is text")
}

fn simulated(folder: &Path, samples: &str) -> String {
    let data = path(&folder.join("data.csv")).to_owned();
    prints(&["simulate", "pps", "--map", "pps", "--samples", samples, "--seed", "3", "--out", &data]);
    data
}

#[test]
fn pages_say_what_they_rest_on_and_are_the_same_every_time() {
    for samples in ["40", "1500"] {
        let folder = tempdir().unwrap();
        let data = simulated(folder.path(), samples);
        let page = folder.path().join("page.html");
        let identify =
            ["identify", "pps", &data, "--map", "pps", "--report", path(&page), "--date", "21 November"];
        let compensate = ["compensate", "pps", &data, "--map", "pps", "--report", path(&page)];
        for (arguments, expected) in [
            (
                &identify[..],
                &["Date: 21 November", "Residuals in space", "By joint", "Ranges", "cannot be told apart"][..],
            ),
            (&compensate[..], &["Position error by joint", "Joint corrections", "commands"][..]),
        ] {
            let written = || {
                // Status 1: some commands are at a limit and not corrected.
                assert!(abbe(arguments).status <= 1);
                fs::read_to_string(&page).unwrap()
            };
            let text = written();
            is_alone(&text);
            for expected in expected.iter().chain(&["SHA-256", "data.csv"]) {
                assert!(text.contains(expected), "{expected}");
            }
            assert!(text == written(), "another page the second time");
            if arguments[0] == "identify" {
                assert_eq!(text.contains("One in "), samples == "1500");
            }
        }
    }
}

#[test]
fn a_measuring_report_has_its_instrument_and_files() {
    let folder = tempdir().unwrap();
    let data = simulated(folder.path(), "40");
    let out = folder.path().join("out");
    full(&["measure", "pps", &data, "--map", "pps", "--out", path(&out), "--date", "2026-11-21"]);
    let text = fs::read_to_string(out.join("report.html")).unwrap();
    is_alone(&text);
    for expected in ["Instrument", "By joint", "Accuracy: errors in space", "SHA-256", "Date: 2026-11-21"] {
        assert!(text.contains(expected), "{expected}");
    }
}

/// Returns the sentences of a printed report, without its titles and tables.
fn sentences(text: &str) -> Vec<String> {
    let mut paragraphs = vec![String::new()];
    for line in text.lines() {
        let is_table = line.starts_with("   ") || line.trim_start().contains("  ");
        let is_title = line.len() < 50 && !line.ends_with('.');
        match paragraphs.last_mut() {
            Some(paragraph) if !is_table && !is_title => *paragraph += &format!("{} ", line.trim_start()),
            _ => paragraphs.push(String::new()),
        }
    }
    let sentences = paragraphs.iter().flat_map(|paragraph| paragraph.trim_end().split_inclusive(". "));
    let sentences = sentences.map(|sentence| sentence.trim().trim_start_matches("- "));
    sentences.filter(|sentence| sentence.ends_with('.')).map(str::to_owned).collect()
}

/// Returns the words of a page as a reader sees them.
fn words(page: &str) -> String {
    let mut words = String::new();
    for part in page.split('<').skip(1) {
        let (tag, text) = part.split_once('>').unwrap_or((part, ""));
        let is_inline = ["sub", "/sub", "i", "/i", "b", "/b"].contains(&tag);
        words += if is_inline { "" } else { " " };
        words += text;
    }
    let words = words.replace("&quot;", "\"").replace("&lt;", "<").replace("&gt;", ">").replace("&amp;", "&");
    words.split_whitespace().collect::<Vec<_>>().join(" ")
}

#[test]
fn every_sentence_of_a_report_is_on_its_page() {
    let folder = tempdir().unwrap();
    let data = simulated(folder.path(), "40");
    let at = |name: &str| folder.path().join(name).to_str().unwrap().to_owned();
    let page = at("page.html");
    for arguments in [
        &["analyze", "pps", "--monte-carlo", "100", "--out", &at("analysis")][..],
        &["analyze", "scara", "--out", &at("arm")],
        &["measure", "pps", &data, "--map", "pps", "--accept", "mean 9 mm", "--out", &at("measured")],
        &["identify", "pps", &data, "--map", "pps", "--report", &page],
        &["identify", "pps", &data, "--map", "pps", "--terms", "joint", "--report", &page],
        &["compensate", "pps", &data, "--map", "pps", "--report", &page],
    ] {
        let text = abbe(&[arguments, &["--full"]].concat()).stdout;
        let out = Path::new(arguments[arguments.len() - 1]);
        let page = if out.is_dir() { out.join("report.html") } else { out.to_owned() };
        let shown = words(&fs::read_to_string(page).unwrap());
        let sentences = sentences(&text);
        assert!(sentences.len() > 1, "{text}");
        for sentence in sentences {
            assert!(shown.contains(&sentence), "{arguments:?}: {sentence}");
        }
    }
}
