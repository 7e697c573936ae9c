//! Unknowns that cannot be distinguished, with the reason.

use abbe_metrology::identify::Indistinguishable;

use super::Table;

/// Groups that have the same reason.
struct Sentence<'r> {
    reason: &'r str,
    /// `e_z1 acts as e_z2`.
    groups: Vec<String>,
}

/// Lists indistinguishable unknowns with the reasons; empty if there are none.
pub(super) fn table(groups: &[Indistinguishable]) -> String {
    let mut table = Table::new(&["because", "indistinguishable errors"]);
    for sentence in sentences(groups) {
        table.row(vec![wrapped_at(sentence.reason, 38), sentence.groups.join("\n")]);
    }
    if groups.is_empty() { String::new() } else { table.to_string() }
}

/// Lines of at most so many characters.
fn wrapped_at(text: &str, width: usize) -> String {
    let mut lines = vec![String::new()];
    for word in text.split(' ') {
        let fits =
            |last: &&mut String| last.is_empty() || last.chars().count() + word.chars().count() < width;
        match lines.last_mut().filter(fits) {
            Some(last) if last.is_empty() => *last = word.to_owned(),
            Some(last) => *last += &format!(" {word}"),
            None => lines.push(word.to_owned()),
        }
    }
    lines.join("\n")
}

/// One sentence for every reason.
fn sentences(groups: &[Indistinguishable]) -> Vec<Sentence<'_>> {
    let mut sentences: Vec<Sentence> = Vec::new();
    for group in groups {
        let words = group.sentence();
        match sentences.last_mut() {
            Some(last) if last.reason == group.reason => last.groups.push(words),
            _ => sentences.push(Sentence { reason: &group.reason, groups: vec![words] }),
        }
    }
    sentences
}
