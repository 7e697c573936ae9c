//! The Python module `abbe.spec`: a class for each table of a spec file.

use std::collections::BTreeMap;
use std::fmt::Write;

use abbe_spec::keys::{Key, Value};

use super::python::{docstring, literal};

const HEAD: &str = "\
\"\"\"Specs from objects: a class for each table of a spec file. `Manipulator(…).load()` is the machine.

Numbers without a unit are in the unit that a key states, `length unit` is that of the spec; texts such as `\"2 mm\"`
have their own. Where a field has another name than its key, it says so.

>>> from abbe.spec import DH, Frame, Manipulator, Source, Variable
>>> joint = Variable(name=\"q1\", kind=\"revolute\")
>>> frame = Frame(name=\"arm\", variable=joint, dh=DH(theta=\"q1\", d=0, a=300, alpha=0))
>>> bent = Source(name=\"bent\", class_=\"repeatable\", frame=\"arm\", e_z=\"-0.1 mm\")
>>> arm = Manipulator(name=\"arm\", length=\"mm\", frames=[frame], sources=[bent]).load()
>>> arm.pose([0.0])[0, 3]
np.float64(300.0)
\"\"\"

# Generated from the keys of the reader: `UPDATE_EXPECT=1 cargo test -p abbe-tests json_reference`.
from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Literal

from ._toml import File, Keys
";

/// Classes, with their bases and the headers of their tables. The keys of `[manipulator]` are in a
/// table of their own.
const CLASSES: [(&str, &str, &[&str]); 21] = [
    ("Manipulator", "File", &["[manipulator]", "the file"]),
    ("Parameter", "Keys", &["[parameters.NAME]"]),
    ("Input", "Keys", &["[inputs.NAME]"]),
    ("Lookup", "Keys", &["[tables.NAME]"]),
    ("Axis", "Keys", &["[tables.NAME.x]", "[tables.NAME.y]"]),
    ("Frame", "Keys", &["[[frame]]"]),
    ("Variable", "Keys", &["[frame.variable]", "[loop.variable]"]),
    ("DH", "Keys", &["[frame.dh]", "[frame.mdh]"]),
    ("Origin", "Keys", &["[frame.origin]"]),
    ("Limit", "Keys", &["[[limit]]"]),
    ("Loop", "Keys", &["[[loop]]"]),
    ("Tool", "Keys", &["[tool]"]),
    ("Effect", "Keys", &["[[source.effect]]"]),
    ("Source", "Effect", &["[[source]]"]),
    ("DHErrors", "Keys", &["[source.dh]", "[source.effect.dh]"]),
    ("Magnitude", "Keys", &["[source.magnitude]"]),
    ("Beam", "Keys", &["[source.beam]", "[source.effect.beam]"]),
    ("Compliance", "Keys", &["[source.compliance]", "[source.effect.compliance]"]),
    ("Load", "Keys", &["[[load]]"]),
    ("Covariance", "Keys", &["[covariance]"]),
    ("CovarianceOf", "Keys", &["[covariance.of]"]),
];

/// Formats the module.
pub(super) fn module() -> String {
    let mut text = HEAD.to_owned();
    for (name, base, headers) in &CLASSES {
        let _ = write!(text, "\n\n@dataclass(kw_only=True)\nclass {name}({base}):\n");
        let titles: Vec<String> = headers.iter().map(|header| format!("`{header}`")).collect();
        docstring(&mut text, &format!("{}.", titles.join(", ")).replace("`the file`", "keys of the file"));
        let of_base = CLASSES.iter().filter(|(other, ..)| other == base).flat_map(|(.., headers)| *headers);
        let mut written: Vec<&str> = of_base.flat_map(|header| keys(header)).map(|key| key.name).collect();
        for header in *headers {
            for key in keys(header) {
                if key.name != "manipulator" && !written.contains(&key.name) {
                    written.push(key.name);
                    field(&mut text, key, (*base == "File").then_some(*header));
                }
            }
        }
    }
    text
}

/// Returns the keys of the table with a header.
fn keys(header: &str) -> impl Iterator<Item = &'static Key> {
    abbe_spec::tables()
        .into_iter()
        .filter(move |keys| keys.tables.contains(&header))
        .flat_map(|keys| &keys.keys)
}

fn field(text: &mut String, key: &Key, header: Option<&str>) {
    let mut metadata = BTreeMap::new();
    if header == Some("[manipulator]") {
        metadata.insert("table", "manipulator");
    }
    let name = match (key.name, &key.value) {
        ("class", _) => "class_".to_owned(),
        (name, Value::Tables(_)) if name != "of" => format!("{name}s"),
        (name, _) => name.to_owned(),
    };
    let mut documentation = format!("{}.", key.what);
    if name != key.name {
        metadata.insert("key", key.name);
        let _ = write!(documentation, " Key: `{}`.", key.name);
    }
    if key.unit != "-" {
        let unit = key.unit.strip_prefix("none: ").unwrap_or(key.unit);
        let _ = write!(documentation, " Unit: {unit}.");
    }
    let is_required = key.default == "required";
    if !is_required {
        let _ = write!(documentation, " Default: {}.", key.default);
    }
    let metadata: Vec<String> = metadata.iter().map(|(name, value)| format!("{name:?}: {value:?}")).collect();
    let value = match (is_required, metadata.is_empty()) {
        (true, true) => String::new(),
        (false, true) => " = None".to_owned(),
        (true, false) => format!(" = field(metadata={{{}}})", metadata.join(", ")),
        (false, false) => format!(" = field(default=None, metadata={{{}}})", metadata.join(", ")),
    };
    let optional = if is_required { "" } else { " | None" };
    let _ = write!(text, "\n    {name}: {}{optional}{value}\n", annotation(&key.value));
    docstring(text, &documentation);
}

fn annotation(value: &Value) -> String {
    let class = |header: &str| {
        let found = CLASSES.iter().find(|(.., headers)| headers.contains(&header));
        found.map_or_else(|| panic!("no class of {header}"), |(name, ..)| (*name).to_owned())
    };
    match value {
        Value::Text => "str".to_owned(),
        Value::Number => "float | str".to_owned(),
        Value::Whole(..) => "int".to_owned(),
        Value::Boolean => "bool".to_owned(),
        Value::Choice(words) => literal(words.iter().copied()),
        Value::List(_, each) => format!("Sequence[{}]", annotation(each)),
        Value::Table(header) | Value::Open(header, _) => class(header),
        Value::Tables(header) => format!("Sequence[{}]", class(header)),
        Value::Names(each) => format!("Mapping[str, {}]", annotation(each)),
        Value::Either(forms) => forms.iter().map(annotation).collect::<Vec<_>>().join(" | "),
    }
}
