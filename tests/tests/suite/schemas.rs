//! The JSON Schemas of `abbe schema` accept every file that the readers accept, and reject every
//! unknown key, missing key, wrong type and wrong word.

use std::fmt::Write as _;
use std::fs;
use std::path::{Path, PathBuf};

use abbe_metrology::schema::FileKind;
use boon::{Compiler, SchemaIndex, Schemas};
use expect_test::expect_file;
use serde_json::Value;
use toml::de::{DeTable, DeValue};

/// Validator of a kind of file.
pub(crate) struct Validator {
    schemas: Schemas,
    index: SchemaIndex,
}

impl Validator {
    pub(crate) fn new(kind: FileKind) -> Self {
        let (mut schemas, mut compiler) = (Schemas::new(), Compiler::new());
        compiler.add_resource("schema.json", kind.schema()).unwrap();
        let index = compiler.compile("schema.json", &mut schemas).unwrap_or_else(|error| panic!("{error:#}"));
        Self { schemas, index }
    }

    /// Validates a TOML file; text that is no TOML is rejected.
    pub(crate) fn validate(&self, text: &str) -> Result<(), String> {
        let table = DeTable::parse(text).map_err(|error| error.to_string())?.into_inner();
        let value = json(&DeValue::Table(table));
        self.schemas.validate(&value, self.index).map_err(|error| format!("{error:#}"))
    }
}

/// Converts a TOML value as editors do: a date becomes a string.
fn json(value: &DeValue<'_>) -> Value {
    match value {
        DeValue::String(text) => text.to_string().into(),
        DeValue::Integer(number) => number.to_string().parse::<i64>().map_or(Value::Null, Value::from),
        DeValue::Float(number) => number.to_string().parse::<f64>().map_or(Value::Null, Value::from),
        DeValue::Boolean(value) => (*value).into(),
        DeValue::Datetime(date) => date.to_string().into(),
        DeValue::Array(items) => items.iter().map(|item| json(item.get_ref())).collect(),
        DeValue::Table(table) => {
            let entries = table.iter().map(|(key, value)| (key.get_ref().to_string(), json(value.get_ref())));
            Value::Object(entries.collect())
        }
    }
}

/// Returns the TOML files of a folder.
fn files(folder: &str) -> Vec<PathBuf> {
    let entries = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path());
    let mut files: Vec<PathBuf> =
        entries.filter(|file| file.extension().is_some_and(|extension| extension == "toml")).collect();
    files.sort();
    files
}

#[test]
fn shipped_files_are_accepted() {
    let folders = [
        ("../manipulators/specs", FileKind::Spec),
        ("specs", FileKind::Spec),
        ("../manipulators/studies", FileKind::Study),
        ("../manipulators/maps", FileKind::Map),
        ("../manipulators/plans", FileKind::Plan),
    ];
    for (folder, kind) in folders {
        let (validator, files) = (Validator::new(kind), files(folder));
        assert!(!files.is_empty(), "{folder}");
        for file in files {
            let accepted = validator.validate(&fs::read_to_string(&file).unwrap());
            assert!(accepted.is_ok(), "{}: {}", file.display(), accepted.unwrap_err());
        }
    }
}

type Recognize = fn(&str) -> bool;

/// Mistakes that a schema must find, and how their messages are recognized.
const CLASSES: [(&str, Recognize); 4] = [
    ("unknown key", |message| message.starts_with("there is no key `")),
    ("missing key", |message| message.contains("` is missing in ")),
    ("wrong type", |message| {
        let types = ["string", "integer", "float", "boolean", "array", "table", "single table"];
        message.starts_with('`')
            && message
                .rsplit_once(", not a")
                .is_some_and(|(_, found)| types.contains(&found.trim_start_matches('n').trim_start()))
    }),
    ("wrong word", |message| message.contains("` cannot be `")),
];

/// Missing keys that depend on the kind of another table's instrument.
const DEPEND_ON_ANOTHER_TABLE: [&str; 3] =
    ["place_of_camera.toml", "place_without_position.toml", "place_without_zero.toml"];

#[test]
fn structural_mistakes_are_rejected() {
    let folders = [
        ("bad-specs", FileKind::Spec),
        ("bad-studies", FileKind::Study),
        ("bad-maps", FileKind::Map),
        ("bad-plans", FileKind::Plan),
    ];
    let (mut table, mut problems) = (String::new(), Vec::new());
    for (folder, kind) in folders {
        let validator = Validator::new(kind);
        let (files, mut rejected, mut counts) = (files(folder), 0, [0; CLASSES.len()]);
        for file in &files {
            let accepted = validator.validate(&fs::read_to_string(file).unwrap()).is_ok();
            rejected += usize::from(!accepted);
            let told = fs::read_to_string(file.with_extension("txt")).unwrap();
            for ((class, is_of), count) in CLASSES.iter().zip(&mut counts) {
                let Some(message) =
                    told.lines().filter_map(|line| line.strip_prefix("error: ")).find(|said| is_of(said))
                else {
                    continue;
                };
                *count += 1;
                let name = Path::new(file).file_name().unwrap().to_str().unwrap();
                if accepted && !DEPEND_ON_ANOTHER_TABLE.contains(&name) {
                    problems.push(format!("{}: {class} is accepted: {message}", file.display()));
                }
            }
        }
        writeln!(table, "{folder}: {} files, {rejected} rejected by the schema", files.len()).unwrap();
        for ((class, _), count) in CLASSES.iter().zip(counts) {
            writeln!(table, "  {class}: {count} files").unwrap();
        }
    }
    assert!(problems.is_empty(), "\n{}\n", problems.join("\n"));
    expect_file!["../../golden/schemas.txt"].assert_eq(&table);
}
