//! The Python module `abbe.reports`: a class for each report and each group of fields.

use std::fmt::Write;

use super::page::groups_below;
use super::reports::REPORTS;
use super::shape::{Group, Shape, Shapes};
use super::unit;

const HEAD: &str = "\
\"\"\"Reports and their groups of fields, for editors and type checkers.

Units are those of docs/reference/json.md: `length unit` is that of the spec, `coherent` the length unit for lengths, rad
for angles and the unit of the spec for parameters and inputs, and `1` none. Optional fields are None where they do not
apply.
\"\"\"

# Generated from the types of the reports and their comments: `UPDATE_EXPECT=1 cargo test -p abbe-tests json_reference`.
from __future__ import annotations

from typing import Literal

from ._abbe import Report
from ._fields import Fields, Named
";

/// Reports without a method in Python.
const COMMAND_ONLY: [&str; 4] = ["CompensateReport", "ExploreReport", "JacobianReport", "ShippedManipulator"];

/// Methods of a report, which hide the fields of their names.
const METHODS: [&str; 1] = ["table"];

/// Words that are no names in Python; such a field is `[\"class\"]`.
const KEYWORDS: [&str; 4] = ["class", "from", "lambda", "in"];

/// Formats the module.
pub(super) fn module(shapes: &Shapes) -> String {
    let reports = REPORTS.iter().filter(|(name, ..)| !COMMAND_ONLY.contains(name));
    let names: std::collections::BTreeSet<String> =
        reports.flat_map(|(name, ..)| groups_below(shapes, name)).collect();
    let mut text = HEAD.to_owned();
    for name in &names {
        let base = if REPORTS.iter().any(|(report, ..)| report == name) { "Report" } else { "Fields" };
        class(&mut text, name, base, &shapes.groups[name]);
    }
    text
}

fn class(text: &mut String, name: &str, base: &str, group: &Group) {
    let _ = write!(text, "\n\nclass {name}({base}):\n");
    let mut documentation = group.documentation.clone();
    let hidden = group.fields.iter().filter(|field| KEYWORDS.contains(&field.name.as_str()));
    for field in hidden {
        let _ = write!(documentation, "\n`[\"{}\"]`: {}", field.name, field.documentation);
    }
    docstring(text, &documentation);
    if base == "Report" {
        // The layout of its base, so that a report can become one.
        *text += "\n    __slots__ = ()\n";
    }
    for field in &group.fields {
        let is_hidden = KEYWORDS.contains(&field.name.as_str())
            || (base == "Report" && METHODS.contains(&field.name.as_str()));
        if is_hidden {
            continue;
        }
        let shown = annotation(&field.shape);
        let optional = match (field.may_be_absent, base) {
            (false, _) => "",
            (true, "Report") => " | None",
            (true, _) => " | None = None",
        };
        let _ = write!(text, "\n    {}: {shown}{optional}\n", field.name);
        let unit = group.unit(field).filter(|_| unit::said(&field.documentation).is_none());
        let unit = unit.map(|unit| format!("\nUnit: {unit}.")).unwrap_or_default();
        docstring(text, &(field.documentation.clone() + &unit));
    }
}

fn annotation(shape: &Shape) -> String {
    match shape {
        Shape::Boolean => "bool".to_owned(),
        Shape::Integer => "int".to_owned(),
        Shape::Number => "float".to_owned(),
        Shape::Text => "str".to_owned(),
        Shape::Choice(choices) => literal(choices.iter().map(|(name, _)| name.as_str())),
        Shape::List(inner, _) => format!("list[{}]", annotation(inner)),
        Shape::Tuple(shapes) => {
            let mut kinds: Vec<_> = shapes.iter().map(annotation).collect();
            kinds.dedup();
            format!("list[{}]", kinds.join(" | "))
        }
        Shape::Map(inner) => format!("Named[{}]", annotation(inner)),
        Shape::Optional(inner) => format!("{} | None", annotation(inner)),
        Shape::Group(name) => name.clone(),
        Shape::Variant(choices, name) if choices.is_empty() => name.clone(),
        Shape::Variant(choices, name) => {
            format!("{} | {name}", literal(choices.iter().map(|(name, _)| name.as_str())))
        }
    }
}

/// Formats a type of several texts.
pub(super) fn literal<'n>(names: impl Iterator<Item = &'n str>) -> String {
    format!("Literal[{}]", names.map(|name| format!("{name:?}")).collect::<Vec<_>>().join(", "))
}

/// Adds a docstring in lines of at most 100 columns.
pub(super) fn docstring(text: &mut String, documentation: &str) {
    let quoted = documentation.replace('\\', "\\\\").replace("`None`", "None");
    let mut lines = Vec::new();
    for paragraph in quoted.lines() {
        let mut line = String::new();
        for word in paragraph.split(' ') {
            if !line.is_empty() && line.chars().count() + word.chars().count() > 110 {
                lines.push(std::mem::take(&mut line));
            }
            if !line.is_empty() {
                line.push(' ');
            }
            line += word;
        }
        lines.push(line);
        lines.push(String::new());
    }
    lines.pop();
    match &lines[..] {
        [] => {}
        [line] => {
            let _ = writeln!(text, "    \"\"\"{line}\"\"\"");
        }
        [first, others @ ..] => {
            let _ = writeln!(text, "    \"\"\"{first}");
            for line in others {
                let _ = writeln!(text, "{}", format!("    {line}").trim_end());
            }
            *text += "    \"\"\"\n";
        }
    }
}

/// Formats the module of the names of options.
pub(super) fn options(names: &[(&str, String)]) -> String {
    let mut text = "\
\"\"\"Names that options accept, for editors and type checkers.\"\"\"

# Generated from the options of the jobs: `UPDATE_EXPECT=1 cargo test -p abbe-tests json_reference`.
from typing import Literal, TypeAlias

"
    .to_owned();
    for (name, literal) in names {
        let _ = writeln!(text, "{name}: TypeAlias = {literal}");
    }
    text
}
