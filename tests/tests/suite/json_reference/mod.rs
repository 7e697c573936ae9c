//! `docs/reference/json.md` and the Python module `abbe.reports` describe every field of every
//! report. Both are generated from the types of the reports and their comments, and the reports of
//! real jobs must have these fields.
//!
//! `source` reads the types, `shape` says what serde makes of them, `unit` finds their units,
//! `page` and `python` format them, and `jobs` runs every command.

mod crates;
mod jobs;
mod objects;
mod page;
mod python;
mod reports;
mod shape;
mod source;
mod unit;

use std::path::Path;

use abbe_codegen::print::Language;
use abbe_metrology::identify::options::{LOSSES, TERMS};
use abbe_metrology::plan::options::CRITERIA;
use abbe_study::export::Format;
use abbe_study::generate::Generate;
use abbe_study::options::CONVENTIONS;
use expect_test::expect_file;
use serde_json::Value;

use reports::REPORTS;
use shape::{Shape, Shapes};
use source::Sources;

/// Calls a function with the shapes of all reports.
fn with_shapes(work: impl FnOnce(&Shapes)) {
    let sources = Sources::read(&Path::new(env!("CARGO_MANIFEST_DIR")).join(".."));
    let mut shapes = Shapes::new(&sources);
    for (name, path, _) in REPORTS {
        shapes.add(name, path);
    }
    work(&shapes);
}

fn nothing(problems: &[String]) {
    assert!(problems.is_empty(), "\n{}\n", problems.join("\n"));
}

#[test]
fn page_and_classes_are_those_of_the_types() {
    with_shapes(|shapes| {
        expect_file!["../../../../docs/reference/json.md"].assert_eq(&page::page(shapes));
        expect_file!["../../../../python/abbe/reports.py"].assert_eq(&python::module(shapes));
    });
}

#[test]
fn names_of_options_are_those_of_the_jobs() {
    let names = [
        ("Convention", python::literal(CONVENTIONS.0.iter().map(|(_, name, _)| *name))),
        ("Criterion", python::literal(CRITERIA.0.iter().map(|(_, name, _)| *name))),
        ("Format", python::literal(Format::names())),
        (
            "Language",
            python::literal(Generate::LANGUAGES.0.iter().map(|(_, name, _): &(Language, _, _)| *name)),
        ),
        ("Real", python::literal(Generate::REALS.0.iter().map(|(_, name, _)| *name))),
        ("Robust", python::literal(LOSSES.0.iter().map(|(_, name, _)| *name))),
        ("Terms", python::literal(TERMS.0.iter().map(|(_, name, _)| *name))),
    ];
    expect_file!["../../../../python/abbe/options.py"].assert_eq(&python::options(&names));
}

#[test]
fn objects_are_those_of_the_keys() {
    expect_file!["../../../../python/abbe/spec.py"].assert_eq(&objects::module());
}

#[test]
fn every_field_has_a_sentence_and_every_number_a_unit() {
    with_shapes(|shapes| {
        let mut problems = Vec::new();
        for (name, group) in &shapes.groups {
            for field in &group.fields {
                if field.documentation.is_empty() {
                    problems.push(format!("`{}` of {name} has no doc comment", field.name));
                } else if field.shape.has_numbers() && group.unit(field).is_none() {
                    problems.push(format!(
                        "no unit of `{}` of {name}: say it in its doc comment, with a phrase of unit.rs: {}",
                        field.name, field.documentation
                    ));
                }
            }
        }
        nothing(&problems);
    });
}

#[test]
fn reports_of_real_jobs_have_these_fields() {
    with_shapes(|shapes| {
        let (mut problems, mut seen) = (Vec::new(), Vec::new());
        for (name, json) in jobs::reports() {
            let before = problems.len();
            compare(shapes, &Shape::Group(name.to_owned()), &json, name, &mut problems);
            assert!(json.as_object().is_some_and(|fields| !fields.is_empty()), "{name}");
            problems.truncate(before + 10);
            seen.push(name);
        }
        let unseen = REPORTS.iter().filter(|(name, ..)| !seen.contains(name));
        problems.extend(unseen.map(|(name, ..)| format!("no job of {name} was run")));
        nothing(&problems);
    });
}

/// Compares a value with a shape: no other fields, none missing, and their types.
fn compare(shapes: &Shapes, shape: &Shape, value: &Value, path: &str, problems: &mut Vec<String>) {
    let fits = match (shape, value) {
        (Shape::Boolean, value) => value.is_boolean(),
        (Shape::Integer, value) => value.is_u64() || value.is_i64(),
        (Shape::Number, value) => value.is_number(),
        (Shape::Text, value) => value.is_string(),
        (Shape::Choice(choices), value) => choices.iter().any(|(name, _)| value == name),
        (Shape::List(inner, length), Value::Array(list)) => {
            let each = list.iter().enumerate();
            each.for_each(|(i, one)| compare(shapes, inner, one, &format!("{path}[{i}]"), problems));
            length.is_none_or(|length| length == list.len())
        }
        (Shape::Tuple(inner), Value::Array(list)) => {
            let pairs = inner.iter().zip(list).enumerate();
            pairs
                .for_each(|(i, (inner, one))| compare(shapes, inner, one, &format!("{path}[{i}]"), problems));
            inner.len() == list.len()
        }
        (Shape::Map(inner), Value::Object(fields)) => {
            let each = fields.iter();
            each.for_each(|(name, one)| compare(shapes, inner, one, &format!("{path}.{name}"), problems));
            true
        }
        (Shape::Optional(inner), value) => {
            if !value.is_null() {
                compare(shapes, inner, value, path, problems);
            }
            true
        }
        (Shape::Variant(choices, _), Value::String(text)) => choices.iter().any(|(name, _)| name == text),
        (Shape::Variant(_, name), Value::Object(fields)) => {
            compare(shapes, &Shape::Group(name.clone()), value, path, problems);
            fields.len() == 1
        }
        (Shape::Group(name), Value::Object(fields)) => {
            let group = &shapes.groups[name];
            for field in &group.fields {
                let path = format!("{path}.{}", field.name);
                match fields.get(&field.name) {
                    Some(value) => compare(shapes, &field.shape, value, &path, problems),
                    None if field.may_be_absent => {}
                    None => problems.push(format!("{path} is not in the report")),
                }
            }
            let unknown = fields.keys().filter(|name| group.fields.iter().all(|field| field.name != **name));
            problems.extend(unknown.map(|name| format!("{path}.{name} is not on the page")));
            true
        }
        _ => false,
    };
    if !fits {
        problems.push(format!("{path} is {value}, not {shape:?}"));
    }
}
