//! What cannot be told apart, in words.

use abbe_study::identify::Alike;
use abbe_study::number;

use crate::table::Table;

/// Groups that have the same reason.
struct Sentence<'r> {
    reason: &'r str,
    /// `e_z1 acts as e_z2`.
    groups: Vec<String>,
}

/// What cannot be told apart, and why; nothing if all can.
pub(crate) fn table(groups: &[Alike]) -> String {
    let mut table = Table::new(&["because", "these cannot be told apart"]);
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
fn sentences(groups: &[Alike]) -> Vec<Sentence<'_>> {
    let mut sentences: Vec<Sentence> = Vec::new();
    for group in groups {
        let words = in_words(group);
        match sentences.last_mut() {
            Some(last) if last.reason == group.reason => last.groups.push(words),
            _ => sentences.push(Sentence { reason: &group.reason, groups: vec![words] }),
        }
    }
    sentences
}

fn in_words(group: &Alike) -> String {
    let these = combination(&group.these);
    let verb = if group.these.len() == 1 { "acts" } else { "act" };
    if group.act_as.is_empty() {
        format!("{these} cannot be seen")
    } else {
        format!("{these} {verb} as {}", combination(&group.act_as))
    }
}

/// `e_r2 − 425 e_y2`.
fn combination(terms: &[(String, f64)]) -> String {
    let mut text = String::new();
    for (name, factor) in terms {
        let size = number::digits(factor.abs(), 4);
        let factor_text = if size == "1" { String::new() } else { format!("{size} ") };
        let sign = match (text.is_empty(), *factor < 0.0) {
            (true, false) => "",
            (true, true) => "−",
            (false, false) => " + ",
            (false, true) => " − ",
        };
        text += &format!("{sign}{factor_text}{name}");
    }
    text
}
