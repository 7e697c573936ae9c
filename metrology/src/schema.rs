//! JSON Schemas of the input files, generated from the keys of their readers.
//!
//! A schema accepts every file that the reader accepts. Of the others, it rejects those with an
//! unknown key, a missing key, a value of the wrong type or a wrong word.

use abbe_spec::keys::{Keys, Rule, Then, Value, When};
use serde_json::{Map, Value as Json, json};

use crate::{data, plan};
use abbe_study::{options::Choices, study_file, workspace};

/// Kind of an input file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FileKind {
    /// A manipulator.
    Spec,
    /// An analysis of a manipulator.
    Study,
    /// The columns of measured data.
    Map,
    /// Configurations to measure.
    Plan,
}

impl FileKind {
    /// Kinds, with their names.
    pub const CHOICES: Choices<Self> = Choices(&[
        (Self::Spec, "spec", "a manipulator and its errors"),
        (Self::Study, "study", "a workspace, a tolerance and figures"),
        (Self::Map, "map", "the columns of measured data"),
        (Self::Plan, "plan", "configurations to measure"),
    ]);

    /// Returns the tables of the file.
    pub fn tables(self) -> Vec<&'static Keys> {
        match self {
            Self::Spec => abbe_spec::tables(),
            Self::Study => [study_file::tables(), workspace::tables()].concat(),
            Self::Map => data::tables(),
            Self::Plan => [plan::tables(), workspace::tables()].concat(),
        }
    }

    fn rules(self) -> Vec<Rule> {
        match self {
            Self::Spec => abbe_spec::rules(),
            Self::Study => [study_file::rules(), workspace::rules()].concat(),
            Self::Map => data::rules(),
            Self::Plan => [plan::rules(), workspace::rules()].concat(),
        }
    }

    /// Returns the JSON Schema of the file, draft 2020-12.
    pub fn schema(self) -> Json {
        let name = Self::CHOICES.name(self);
        let (tables, rules) = (self.tables(), self.rules());
        let mut headers: Vec<&str> = tables.iter().flat_map(|keys| &keys.tables).copied().collect();
        headers.sort_unstable();
        headers.dedup();
        let mut schema = table("the file", &tables, &rules);
        let others = headers.into_iter().filter(|header| *header != "the file");
        let definitions = others.map(|header| (path(header).to_owned(), table(header, &tables, &rules)));
        schema["$schema"] = json!("https://json-schema.org/draft/2020-12/schema");
        schema["title"] = json!(format!("{name} file of abbe"));
        schema["$defs"] = Json::Object(definitions.collect());
        schema
    }
}

/// Returns the path of a table: its header without brackets.
fn path(header: &str) -> &str {
    header.trim_matches(['[', ']'])
}

/// Returns the schema of the table with a header.
fn table(header: &str, tables: &[&Keys], rules: &[Rule]) -> Json {
    let keys = tables.iter().filter(|keys| keys.tables.contains(&header)).flat_map(|keys| &keys.keys);
    let (mut properties, mut required) = (Map::new(), Vec::new());
    for key in keys {
        let mut schema = value(&key.value);
        let unit = if key.unit == "-" { String::new() } else { format!("\n\nUnit: {}", key.unit) };
        schema["description"] = json!(format!("{}.{unit}\n\nDefault: {}", key.what, key.default));
        properties.insert(key.name.to_owned(), schema);
        if key.default == "required" {
            required.push(key.name);
        }
    }
    let mut schema = json!({ "type": "object", "properties": properties });
    // Names of the user beside the keys.
    let names = tables.iter().flat_map(|keys| &keys.keys).find_map(|key| match &key.value {
        Value::Open(open, names) if *open == header => Some(value(names)),
        _ => None,
    });
    schema["additionalProperties"] = names.unwrap_or(json!(false));
    if !required.is_empty() {
        schema["required"] = json!(required);
    }
    let rules: Vec<Json> = rules.iter().filter(|rule| rule.table == header).map(relation).collect();
    if !rules.is_empty() {
        schema["allOf"] = json!(rules);
    }
    schema
}

/// Returns the schema of a value.
fn value(kind: &Value) -> Json {
    let reference = |header: &str| json!({ "$ref": format!("#/$defs/{}", path(header)) });
    match kind {
        Value::Text => json!({ "type": "string" }),
        Value::Number => json!({ "type": ["number", "string"] }),
        Value::Whole(least, most) => {
            let mut whole = json!({ "type": ["integer", "string"], "minimum": least });
            if let Some(most) = most {
                whole["maximum"] = json!(most);
            }
            whole
        }
        Value::Boolean => json!({ "type": "boolean" }),
        Value::Choice(words) => json!({ "enum": words }),
        Value::List(count, entry) => {
            let mut list = json!({ "type": "array", "items": value(entry) });
            if let Some(count) = count {
                list["minItems"] = json!(count);
                list["maxItems"] = json!(count);
            }
            list
        }
        Value::Table(header) | Value::Open(header, _) => reference(header),
        Value::Tables(header) => json!({ "type": "array", "items": reference(header) }),
        Value::Names(each) => json!({ "type": "object", "additionalProperties": value(each) }),
        Value::Either(forms) => json!({ "anyOf": forms.iter().map(value).collect::<Vec<_>>() }),
    }
}

/// Returns the schema of a rule.
fn relation(Rule { when, then, .. }: &Rule) -> Json {
    let has = |key: &str| at(key, &|last| json!({ "required": [last] }), true);
    let all = |keys: &[&str], one: &dyn Fn(&str) -> Json| json!({ "allOf": keys.iter().map(|key| at(key, one, false)).collect::<Vec<_>>() });
    let then = match then {
        Then::Needs(keys) => all(keys, &|last| json!({ "required": [last] })),
        Then::Refuses(keys) => all(keys, &|last| json!({ "properties": { last: false } })),
        Then::NeedsOne(keys) => json!({ "anyOf": keys.iter().map(|key| has(key)).collect::<Vec<_>>() }),
    };
    let when = match when {
        When::Always => return then,
        When::Has(key) => has(key),
        When::Lacks(keys) => {
            json!({ "not": { "anyOf": keys.iter().map(|key| has(key)).collect::<Vec<_>>() } })
        }
        When::Is(key, word) => json!({ "required": [key], "properties": { *key: { "const": word } } }),
    };
    json!({ "if": when, "then": then })
}

/// Applies a schema to the table that a path such as `data.uncertainty` leads to, and its last key.
/// `present` requires the tables on the way.
fn at(path: &str, last: &dyn Fn(&str) -> Json, present: bool) -> Json {
    let Some((first, rest)) = path.split_once('.') else { return last(path) };
    let inner = at(rest, last, present);
    let mut schema = match first.strip_suffix("[]") {
        Some(list) => json!({ "properties": { list: { "items": inner } } }),
        None => json!({ "properties": { first: inner } }),
    };
    if present {
        schema["required"] = json!([first.trim_end_matches("[]")]);
    }
    schema
}
