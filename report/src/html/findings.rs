//! Sentences of the printed report, so that the page has every sentence that the terminal shows.

use super::{escaped, section};
use crate::text::{WIDTH, at_width};

/// Formats the sentences that `print` returns and `page` does not contain.
pub(super) fn findings(print: impl FnOnce() -> String, page: &str) -> String {
    let text = &at_width(WIDTH, print);
    let page = page.replace('\u{a0}', " ");
    let is_missing = |sentence: &&str| !page.contains(&escaped(sentence.trim()));
    let missing = paragraphs(text).into_iter().map(|paragraph| {
        let sentences = paragraph.split_inclusive(". ").filter(is_missing).collect::<String>();
        match sentences.trim() {
            "" => String::new(),
            sentences => format!("<p>{}</p>\n", escaped(sentences)),
        }
    });
    match missing.collect::<String>() {
        none if none.is_empty() => none,
        paragraphs => section("Findings", &paragraphs),
    }
}

/// Returns the paragraphs of a printed report without its titles and tables, and without line
/// breaks.
fn paragraphs(text: &str) -> Vec<String> {
    let mut all: Vec<String> = Vec::new();
    let mut before = "";
    for line in text.lines() {
        let is_table = line.starts_with("   ") || line.trim_start().contains("  ");
        if line.is_empty() || is_table {
            before = "";
            continue;
        }
        // A line may end early, because a number and its unit stay together.
        let is_continued = before.chars().count() > WIDTH / 2 && !before.ends_with('.');
        match all.last_mut() {
            Some(paragraph) if is_continued => *paragraph += &format!(" {}", line.trim_start()),
            _ => all.push(line.strip_prefix("- ").unwrap_or(line).to_owned()),
        }
        before = line;
    }
    all.retain(|paragraph| paragraph.ends_with('.') && !paragraph.starts_with(' '));
    all
}

#[cfg(test)]
mod tests {
    use super::{findings, paragraphs};

    const TEXT: &str = "\
Machine: measured

Verdict: not met
The error is within 0.5 mm with a probability of 95 %, which is asked for. This is the least of all
4 configurations, where d1 = 8 mm.
A title of more than half of the width, which has no full stop, and the name of a unit (mm)
           mean      rms
───────────────────────────
  x      0.2635   0.5520
- A note that needs more than one line, because it is long and has to say something about the paper
  of the machine.
";

    #[test]
    fn paragraphs_are_whole_sentences_without_tables() {
        let expected = [
            "The error is within 0.5 mm with a probability of 95 %, which is asked for. This is the least of all 4 \
             configurations, where d1 = 8 mm.",
            "A note that needs more than one line, because it is long and has to say something about the paper of the \
             machine.",
        ];
        assert_eq!(paragraphs(TEXT), expected);
    }

    #[test]
    fn sentences_of_the_page_are_not_repeated() {
        let page = "<p>The error is within 0.5 mm with a probability of 95 %, which is asked for.</p>";
        let found = findings(|| TEXT.to_owned(), page);
        assert!(
            !found.contains("The error is within") && found.contains("<p>This is the least of all 4"),
            "{found}"
        );
        assert_eq!(findings(|| "Nothing.\n".to_owned(), "<p>Nothing.</p>"), "");
    }
}
