//! Pages of reports on paper: Chromium prints each to PDF, and every figure and table is on it.

use std::fs;
use std::path::Path;
use std::process::Command;

use abbe_tests::needs::{Missing, Tests, tool};

use crate::browser::{chromium, pages};

pub(crate) const TESTS: Tests = &[("every_figure_and_table_is_on_paper", every_figure_and_table_is_on_paper)];

fn every_figure_and_table_is_on_paper() -> Result<(), Missing> {
    tool("chromium", "")?;
    // It has no `--version`.
    if Command::new("pdftotext").arg("-v").output().is_err() {
        return Err(Missing("pdftotext is not installed".to_owned()));
    }
    let folder = tempfile::tempdir().expect("a folder");
    for page in pages(folder.path()) {
        let name = page.display();
        let html = fs::read_to_string(&page).expect("a page");
        let paper = printed(&page, folder.path());
        let figures = between(&html, "<figure>", "</figure>");
        assert!(!figures.is_empty(), "{name}: no figure");
        for figure in figures {
            // Title and axes are texts of the picture itself, which an empty frame does not have.
            let texts = between(figure, "<text", "</text>");
            assert!(!texts.is_empty(), "{name}: {figure}");
            for text in between(figure, "<h3>", "</h3>").into_iter().chain(texts) {
                let text = letters(&format!("<{text}"));
                assert!(paper.contains(&text), "{name}: `{text}` is not on paper");
            }
        }
        for caption in between(&html, "<caption>", "</caption>") {
            let caption = letters(&format!(">{caption}"));
            assert!(paper.contains(&caption), "{name}: the table `{caption}` is not on paper");
        }
    }
    Ok(())
}

/// Returns the letters and digits of a page printed to PDF.
fn printed(page: &Path, folder: &Path) -> String {
    let pdf = page.with_extension("pdf");
    chromium(folder, &[&format!("--print-to-pdf={}", pdf.display()), "--no-pdf-header-footer"], page);
    let output = Command::new("pdftotext").arg("-raw").arg(&pdf).arg("-").output().expect("pdftotext runs");
    assert!(output.status.success(), "{}: {}", page.display(), String::from_utf8_lossy(&output.stderr));
    only_letters(&String::from_utf8_lossy(&output.stdout))
}

/// Returns the texts between two marks.
fn between<'t>(text: &'t str, begin: &str, end: &str) -> Vec<&'t str> {
    text.split(begin).skip(1).filter_map(|rest| Some(rest.split_once(end)?.0)).collect()
}

/// Returns the letters and digits of HTML, without its tags.
fn letters(html: &str) -> String {
    let texts = html.split('<').map(|part| part.split_once('>').map_or("", |(_, text)| text));
    let text = texts.collect::<String>().replace("&lt;", "").replace("&gt;", "").replace("&amp;", "");
    only_letters(&text.replace("&quot;", ""))
}

/// Leaves out blanks, line breaks and signs, which differ on paper.
fn only_letters(text: &str) -> String {
    text.chars().filter(|letter| letter.is_ascii_alphanumeric()).collect()
}
