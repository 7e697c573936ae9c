//! What cannot be told apart, in words.

use abbe::identify::{Group, Model, Reason, Unknown};
use abbe::{Description, VariableKind};

use crate::table::Table;
use abbe_study::number;

/// Groups that have the same reason.
struct Sentence {
    reason: String,
    /// `e_z1 acts as e_z2`.
    groups: Vec<String>,
}

/// What cannot be told apart, and why; nothing if all can.
pub(crate) fn table(groups: &[Group], model: &Model, description: &Description) -> String {
    let mut table = Table::new(&["because", "these cannot be told apart"]);
    for sentence in sentences(groups, model, description) {
        table.row(vec![wrapped_at(&sentence.reason, 38), sentence.groups.join("\n")]);
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
fn sentences(groups: &[Group], model: &Model, description: &Description) -> Vec<Sentence> {
    let mut sentences: Vec<Sentence> = Vec::new();
    for group in groups {
        let reason = reason(group.reason, description);
        let group = in_words(group, model);
        match sentences.last_mut() {
            Some(last) if last.reason == reason => last.groups.push(group),
            _ => sentences.push(Sentence { reason, groups: vec![group] }),
        }
    }
    sentences
}

/// Why, with the names of the spec.
pub(super) fn reason(reason: Reason, description: &Description) -> String {
    let name = |variable: usize| &description.variables[variable].name;
    match reason {
        Reason::Commutes(variable) => match description.variables[variable].kind {
            VariableKind::Revolute => {
                format!(
                    "{} turns: turns about its axis and shifts along it stay what they are behind it",
                    name(variable)
                )
            }
            VariableKind::Prismatic => {
                format!(
                    "{} slides: all shifts and turns about its direction stay what they are behind it",
                    name(variable)
                )
            }
        },
        Reason::Still(variable) => format!("{} is not moved in these data", name(variable)),
        Reason::Fixed(frame) => {
            format!("nothing moves at frame {} ({})", frame + 1, description.frames[frame].name)
        }
        Reason::Tool => "the place of the target on the tool is unknown too".to_owned(),
        Reason::Unseen => "turns about a single target do not move it".to_owned(),
    }
}

fn in_words(group: &Group, model: &Model) -> String {
    let these = combination(&group.these, model);
    let verb = if group.these.len() == 1 { "acts" } else { "act" };
    if group.act_as.is_empty() {
        format!("{these} cannot be seen")
    } else {
        format!("{these} {verb} as {}", combination(&group.act_as, model))
    }
}

/// `e_r2 − 425 e_y2`.
pub(super) fn combination(terms: &[(Unknown, f64)], model: &Model) -> String {
    let mut text = String::new();
    for (unknown, factor) in terms {
        let size = number::digits(factor.abs(), 4);
        let factor_text = if size == "1" { String::new() } else { format!("{size} ") };
        let sign = match (text.is_empty(), *factor < 0.0) {
            (true, false) => "",
            (true, true) => "−",
            (false, false) => " + ",
            (false, true) => " − ",
        };
        text += &format!("{sign}{factor_text}{}", model.name(*unknown));
    }
    text
}
