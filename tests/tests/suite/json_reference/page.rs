//! The page `docs/reference/json.md`: a section for each command and each group of fields.

use std::collections::BTreeSet;
use std::fmt::Write;

use super::reports::REPORTS;
use super::shape::{Field, Group, Shape, Shapes};

const INTRODUCTION: &str = "\
# JSON of reports

<!-- Generated from the types of the reports: `UPDATE_EXPECT=1 cargo test -p abbe-tests json_reference`. -->

`abbe COMMAND … --json` prints its report as one line of JSON on stdout; messages go to stderr. The keys are a
contract: a new version may add keys, and its [release notes](../releases/0.3.md) name every key that it changes. In
[Python](../python.md) the same names are fields: `report.combined.radius`, `report.ledger.sources[0].max`; the class of
each group is in `abbe.reports`, by the name of its section.

- Objects with fixed keys are groups, with a section each. In other objects the keys are names of the machine, such as
  those of its joint variables: `{\"q1\": 0.5, \"q2\": 0.0}`.
- `optional` keys are left out where they do not apply; `or null` values are null there, or where they are infinite.
- `statements` are the sentences of a report by name: `answer` is the first line of its text. Names stay; words may
  change, and a sentence that does not apply is left out.
- The unit `length unit` is that of the spec, which most reports name as `length`: `\"mm\"`. `coherent` is the length
  unit for lengths, rad for angles, and the unit that the spec names for parameters and inputs. `1` is a number
  without a unit. Names in code, such as `` `unit` ``, are keys of the same group that hold the unit. Vectors are
  along the axes of `F_0`.
";

/// Formats the page.
pub(super) fn page(shapes: &Shapes) -> String {
    let below: Vec<BTreeSet<String>> = REPORTS.iter().map(|(name, ..)| groups_below(shapes, name)).collect();
    let uses = |group: &str| below.iter().filter(|groups| groups.contains(group)).count();
    let mut text = INTRODUCTION.to_owned();
    for ((name, _, commands), groups) in REPORTS.iter().zip(&below) {
        let said = commands.iter().map(|command| format!("`abbe {command} --json`")).collect::<Vec<_>>();
        let list = if *name == "ShippedManipulator" { ", a list of" } else { "" };
        let _ = write!(text, "\n## {}\n\n{}{list}:\n", commands.join(", "), said.join(" and "));
        let own = groups.iter().filter(|group| *group != name && uses(group) == 1);
        for group in [*name].into_iter().chain(own.map(String::as_str)) {
            section(&mut text, group, &shapes.groups[group]);
        }
    }
    text += "\n## Groups of several reports\n";
    for (name, group) in shapes.groups.iter().filter(|(name, _)| uses(name) > 1) {
        section(&mut text, name, group);
    }
    text
}

fn section(text: &mut String, name: &str, group: &Group) {
    let documentation = json_words(&group.documentation).replace('\n', "\n\n");
    let _ = write!(text, "\n### {name}\n\n");
    documentation.lines().for_each(|line| wrap(text, line));
    *text += "\n| Key | Type | Unit | Meaning |\n|---|---|---|---|\n";
    for field in &group.fields {
        let optional = if field.may_be_absent { ", optional" } else { "" };
        let (kind, unit) = (kind(&field.shape, 1), group.unit(field).unwrap_or_default());
        let said = meaning(field);
        let said = if field.may_be_absent { said.replace("`None`", "absent") } else { json_words(&said) };
        let said = cell(&said);
        let _ = writeln!(text, "| `{}` | {kind}{optional} | {unit} | {said} |", field.name);
    }
}

/// Returns the sentences of a field, and those of its choices.
fn meaning(field: &Field) -> String {
    let choices = match innermost(&field.shape) {
        Shape::Choice(choices) | Shape::Variant(choices, _) => choices.as_slice(),
        _ => &[],
    };
    let choices = choices.iter().map(|(name, sentence)| format!(" `\"{name}\"`: {}", lower(sentence)));
    field.documentation.replace('\n', " ") + &choices.collect::<String>()
}

fn lower(sentence: &str) -> String {
    let second = sentence.chars().nth(1).is_some_and(char::is_lowercase);
    let mut letters = sentence.chars();
    match letters.next() {
        Some(first) if second => first.to_lowercase().chain(letters).collect(),
        _ => sentence.to_owned(),
    }
}

fn innermost(shape: &Shape) -> &Shape {
    match shape {
        Shape::List(inner, _) | Shape::Optional(inner) | Shape::Map(inner) => innermost(inner),
        shape => shape,
    }
}

/// Describes a shape; the plural for a count other than 1.
fn kind(shape: &Shape, count: usize) -> String {
    let plural = if count == 1 { "" } else { "s" };
    match shape {
        Shape::Boolean => format!("Boolean{plural}"),
        Shape::Integer => format!("integer{plural}"),
        Shape::Number => format!("number{plural}"),
        Shape::Text | Shape::Choice(_) => format!("text{plural}"),
        Shape::List(inner, None) => format!("list{plural} of {}", kind(inner, 2)),
        Shape::List(inner, Some(length)) => format!("list{plural} of {length} {}", kind(inner, *length)),
        Shape::Tuple(shapes) => {
            let inner: Vec<_> = shapes.iter().map(|shape| kind(shape, 1)).collect();
            format!("list{plural} of {}", inner.join(" and "))
        }
        Shape::Map(inner) => format!("object{plural} of {} by name", kind(inner, 2)),
        Shape::Optional(inner) => format!("{} or null", kind(inner, count)),
        Shape::Group(name) => format!("[{name}](#{})", name.to_lowercase()),
        Shape::Variant(_, name) => format!("text or [{name}](#{}) with one of its keys", name.to_lowercase()),
    }
}

/// Says null for none.
fn json_words(text: &str) -> String {
    text.replace("`None`", "null")
}

fn cell(text: &str) -> String {
    text.replace('|', "\\|")
}

/// Adds a paragraph in lines of at most 120 columns.
fn wrap(text: &mut String, paragraph: &str) {
    let mut width = 0;
    for word in paragraph.split(' ') {
        let length = word.chars().count();
        let separator = match width {
            0 => "",
            _ if width + 1 + length > 120 => "\n",
            _ => " ",
        };
        width = if separator == " " { width + 1 + length } else { length };
        *text += separator;
        *text += word;
    }
    text.push('\n');
}

/// Returns the names of a group and all groups below it.
pub(super) fn groups_below(shapes: &Shapes, name: &str) -> BTreeSet<String> {
    let mut found = BTreeSet::new();
    let mut next = vec![name.to_owned()];
    while let Some(name) = next.pop() {
        if found.insert(name.clone()) {
            shapes.groups[&name].fields.iter().for_each(|field| inside(&field.shape, &mut next));
        }
    }
    found
}

fn inside(shape: &Shape, found: &mut Vec<String>) {
    match shape {
        Shape::Group(name) | Shape::Variant(_, name) => found.push(name.clone()),
        Shape::List(inner, _) | Shape::Optional(inner) | Shape::Map(inner) => inside(inner, found),
        Shape::Tuple(shapes) => shapes.iter().for_each(|shape| inside(shape, found)),
        _ => {}
    }
}
