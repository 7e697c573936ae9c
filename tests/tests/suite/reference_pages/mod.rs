//! `docs/reference` describes every key as the readers implement it, no less and no more.
//!
//! The readers' keys are those of their `keys.txt`. Every key has a row and occurs in an
//! example of its page, with its example value. A key is `required` if the example without it is
//! rejected as incomplete. The message of a mistake is that of `bad-specs` and similar folders;
//! `UPDATE_EXPECT=1` writes it.

mod example;
mod page;

use std::collections::BTreeSet;
use std::path::Path;
use std::sync::LazyLock;

use abbe::identify::INSTRUMENTS;
use abbe_metrology::data::Map;
use abbe_metrology::plan::{Choice, Plan, Sets};
use abbe_metrology::schema::FileKind;
use abbe_metrology::simulate::{Places, Simulate};
use abbe_metrology::{data, plan};
use abbe_spec::Spec;
use abbe_spec::diagnostic::Diagnostics;
use abbe_spec::document::Document;
use abbe_spec::expr::{FUNCTION_NAMES, UNIT_NAMES};
use abbe_spec::keys::Keys;
use abbe_study::analyze::Analyze;
use abbe_study::check::Check;
use abbe_study::{Machine, Study};
use abbe_tests::thorough;
use example::{Use, uses};
use page::Page;
use tempfile::TempDir;

use crate::schemas::Validator;

/// Reader of a file, given its name and text.
type Reader = fn(&Path, &str) -> Result<(), Diagnostics>;

/// Returns every page, its keys, and the reader of its examples.
fn pages() -> Vec<(Page, Vec<&'static Keys>, Reader)> {
    vec![
        (Page::read("spec.md"), FileKind::Spec.tables(), |path, text| {
            Spec::parse_in(path.parent().unwrap(), "example", text)?;
            Ok(())
        }),
        (Page::read("study.md"), FileKind::Study.tables(), |path, text| {
            Study::read(Document::new(path.to_string_lossy(), text), &CELL)?;
            Ok(())
        }),
        (Page::read("map.md"), FileKind::Map.tables(), |_, text| {
            Map::parse("example", text, &CELL)?;
            Ok(())
        }),
        (Page::read("plan.md"), plan::tables(), |path, text| {
            std::fs::write(path, text).unwrap();
            Sets::find(path, &CELL)?;
            Ok(())
        }),
    ]
}

/// Manipulator of `spec.md`, on which all other pages are based.
static CELL: LazyLock<Spec> = LazyLock::new(|| {
    let page = Page::read("spec.md");
    let (name, text) = page.files()[0];
    Spec::parse(name, text).unwrap()
});

/// Writes the files of a page to a folder, so that they can refer to each other.
fn written(page: &Page) -> TempDir {
    let folder = tempfile::tempdir().unwrap();
    for (name, text) in page.files() {
        std::fs::write(folder.path().join(name), text).unwrap();
    }
    folder
}

fn nothing(problems: &[String]) {
    assert!(problems.is_empty(), "\n{}\n", problems.join("\n"));
}

#[test]
fn every_key_has_a_row_and_every_row_a_key() {
    let mut problems = Vec::new();
    for (page, keys, _) in pages() {
        let known: BTreeSet<(&str, &str)> = keys
            .iter()
            .flat_map(|keys| keys.tables.iter().flat_map(|table| keys.names().map(|key| (*table, key))))
            .collect();
        let rows = page.rows();
        let explained: BTreeSet<(&str, &str)> = rows
            .iter()
            .flat_map(|row| row.tables.iter().map(|table| (table.as_str(), row.key.as_str())))
            .collect();
        for (table, key) in known.difference(&explained) {
            problems.push(format!(
                "docs/reference/{} has no row for the key `{key}` of `{table}`: add it to a table below a heading that names `{table}`.",
                page.name
            ));
        }
        for (table, key) in explained.difference(&known) {
            problems.push(format!(
                "docs/reference/{} explains the key `{key}` of `{table}`, which no reader knows: remove the row, or add the key to keys.txt.",
                page.name
            ));
        }
    }
    nothing(&problems);
}

#[test]
fn every_key_stands_in_an_example_as_its_row_says() {
    let mut problems = Vec::new();
    for (page, _, read) in pages() {
        let folder = written(&page);
        let files = page.files();
        let files = files.into_iter().filter(|(name, _)| name.ends_with(".toml")).collect::<Vec<_>>();
        let every: Vec<(&str, &str, Use)> = files
            .iter()
            .flat_map(|(name, text)| uses(text).into_iter().map(|key| (*name, *text, key)))
            .collect();
        for row in page.rows() {
            let name =
                format!("docs/reference/{}: the key `{}` of {}", page.name, row.key, row.tables.join(", "));
            let here = every.iter().filter(|(_, _, key)| row.describes(key)).collect::<Vec<_>>();
            if here.is_empty() {
                problems.push(format!("{name} stands in no example of the page: add it to one."));
                continue;
            }
            // Tables with a heading cannot be removed.
            let without = here.iter().filter_map(|(file, text, key)| Some((file, key.removed(text)?)));
            let told = without.map(|(file, text)| match read(&folder.path().join(file), &text) {
                Ok(()) => false,
                Err(mistakes) => mistakes.to_string().contains(&format!("`{}` is missing in", row.key)),
            });
            let told = told.collect::<Vec<_>>();
            if !told.is_empty() && told.contains(&true) != row.facts[2].starts_with("required") {
                let truth = if told.contains(&true) { "is required" } else { "is not required" };
                problems.push(format!("{name} {truth}, but its default is \"{}\".", row.facts[2]));
            }
            let value = row.example.strip_prefix('`').and_then(|value| value.strip_suffix('`'));
            if value.is_some_and(|value| !here.iter().any(|(_, _, key)| key.value == value)) {
                problems.push(format!("{name}: no example of the page has the value {}.", row.example));
            }
        }
    }
    nothing(&problems);
}

/// Checks that another word in place of a choice produces a list of all valid words.
#[test]
fn every_choice_is_that_of_the_reader() {
    let mut problems = Vec::new();
    let mut choices = 0;
    for (page, _, read) in pages() {
        let folder = written(&page);
        let files = page.files().into_iter().filter(|(name, _)| name.ends_with(".toml")).collect::<Vec<_>>();
        for row in page.rows().into_iter().filter(|row| !row.choices.is_empty()) {
            let name = format!("docs/reference/{}: `{}` of {}", page.name, row.key, row.tables.join(", "));
            let answers = files.iter().flat_map(|(file, text)| {
                let here =
                    uses(text).into_iter().filter(|key| row.describes(key) && key.value.starts_with('"'));
                let folder = &folder;
                let wrong =
                    here.filter_map(|key| key.replaced(text, "\"none of these\"")).collect::<Vec<_>>();
                wrong.into_iter().filter_map(move |text| read(&folder.path().join(file), &text).err())
            });
            let Some(answer) =
                answers.map(|answer| answer.to_string()).find(|answer| answer.contains("none of these"))
            else {
                problems
                    .push(format!("{name} is one of {:?}, but any other word may stand there.", row.choices));
                continue;
            };
            let said =
                answer.split("expected ").nth(1).and_then(|said| said.lines().next()).unwrap_or_default();
            let said: BTreeSet<&str> = said.split(" or ").map(str::trim).collect();
            let written: BTreeSet<&str> = row.choices.iter().map(String::as_str).collect();
            if said != written {
                problems.push(format!("{name}: the reader takes {said:?}, the page has {written:?}."));
            }
            choices += 1;
        }
    }
    nothing(&problems);
    assert!(choices > 10);
}

#[test]
fn every_row_has_the_facts_of_its_key_and_the_message_of_its_mistake() {
    let mut problems = Vec::new();
    for (page, keys, _) in pages() {
        if std::env::var_os("UPDATE_EXPECT").is_some() {
            page.write(&keys);
            continue;
        }
        for row in page.rows() {
            let name = format!("docs/reference/{}, `{}`", page.name, row.key);
            if let Some(expected) = row.expected(&keys).filter(|expected| *expected != row.facts) {
                problems.push(format!("{name}: keys.txt has {expected:?}, the page has {:?}: run this test with UPDATE_EXPECT=1.", row.facts));
            }
            match row.said() {
                Some(said) if said == row.mistake => {}
                Some(said) => problems.push(format!(
                    "{name}: {} says \"{said}\", not \"{}\": run this test with UPDATE_EXPECT=1.",
                    row.golden, row.mistake
                )),
                None => problems.push(format!(
                    "{name}: its last cell must be [?](../../tests/bad-specs/NAME.txt) with a file that exists, not {}.",
                    row.golden
                )),
            }
        }
    }
    nothing(&problems);
}

/// Compares the rows of the table of instruments with the descriptions in their files.
#[test]
fn every_instrument_has_its_row() {
    let page = std::fs::read_to_string("../docs/reference/map.md").unwrap();
    let mut problems = Vec::new();
    for kind in INSTRUMENTS {
        let keys: Vec<String> = data::required_keys(kind).iter().map(|key| format!("`{key}`")).collect();
        let row = format!("| `\"{}\"` | {} | {} |", kind.name, kind.reads, keys.join(", "));
        if !page.lines().any(|line| line == row) {
            problems.push(format!("docs/reference/map.md has no row\n{row}"));
        }
        let known = data::tables().into_iter().filter(|table| table.tables == ["[[instrument]]"]);
        let known: Vec<&str> = known.flat_map(|table| table.names()).collect();
        let unknown = kind.keys.iter().filter(|key| !known.contains(key));
        problems.extend(
            unknown.map(|key| format!("metrology/src/data/keys.txt has no key `{key}` of `{}`", kind.name)),
        );
    }
    nothing(&problems);
}

/// Checks that the schema of a file accepts every example, and every change of one that the reader
/// accepts. An ordinary run has every seventh change: of 13 changes of a key, each comes up.
#[test]
fn the_schema_accepts_what_the_reader_accepts() {
    let kinds = [FileKind::Spec, FileKind::Study, FileKind::Map, FileKind::Plan];
    let values = [
        "1",
        "2.5",
        "true",
        "\"a\"",
        "\"1 mm\"",
        "\"1 deg\"",
        "[]",
        "[1, 2]",
        "[1, 2, 3]",
        "[\"a\"]",
        "{}",
        "{ value = 1 }",
    ];
    let every = if thorough() { 1 } else { 7 };
    let (mut problems, mut accepted, mut rejected, mut changes) = (Vec::new(), 0, 0, 0);
    for ((page, _, read), kind) in pages().into_iter().zip(kinds) {
        let (folder, validator) = (written(&page), Validator::new(kind));
        let mut compare = |name: &str, change: &str, text: &str| match (
            read(&folder.path().join(name), text),
            validator.validate(text),
        ) {
            (Ok(()), Err(reason)) => problems.push(format!("{name}, {change}: {reason}")),
            (Ok(()), Ok(())) => accepted += 1,
            (Err(_), Err(_)) => rejected += 1,
            (Err(_), Ok(())) => {}
        };
        for (name, text) in page.files().into_iter().filter(|(name, _)| name.ends_with(".toml")) {
            compare(name, "unchanged", text);
            for key in uses(text) {
                for (change, text) in values
                    .iter()
                    .filter_map(|value| Some((format!("{} = {value}", key.key), key.replaced(text, value)?)))
                    .chain(key.removed(text).map(|text| (format!("without {}", key.key), text)))
                {
                    changes += 1;
                    if changes % every == 0 {
                        compare(name, &change, &text);
                    }
                }
            }
        }
    }
    nothing(&problems);
    assert!(
        accepted > 500 / every && rejected > 1000 / every,
        "{accepted} changes are accepted, {rejected} rejected"
    );
}

#[test]
fn every_unit_and_function_is_listed() {
    let page = Page::read("spec.md");
    for (heading, known) in [("## Units", &UNIT_NAMES[..]), ("## Functions", &FUNCTION_NAMES[..])] {
        let listed = page.names(heading);
        let listed: BTreeSet<&str> = listed.iter().map(String::as_str).collect();
        let known: BTreeSet<&str> = known.iter().copied().collect();
        let missing = known.difference(&listed).collect::<Vec<_>>();
        let stale = listed.difference(&known).collect::<Vec<_>>();
        assert!(missing.is_empty(), "docs/reference/spec.md, {heading}: add {missing:?} to the table");
        assert!(stale.is_empty(), "docs/reference/spec.md, {heading}: there is no {stale:?}");
    }
}

#[test]
fn every_example_runs() {
    let page = Page::read("spec.md");
    let folder = written(&page);
    for (name, _) in page.files().into_iter().filter(|(name, _)| name.ends_with(".toml")) {
        let machine = Machine::of_spec(Spec::read(folder.path().join(name)).unwrap(), name);
        assert!(Check { machine }.run(&mut ()).unwrap().passed(), "{name}: a law does not hold");
    }
    let machine = Machine::of_spec(CELL.clone(), "cell.toml");
    let page = Page::read("study.md");
    let folder = written(&page);
    for (name, _) in page.files().into_iter().filter(|(name, _)| name.ends_with(".toml")) {
        let document = Document::read(&folder.path().join(name)).unwrap();
        let study = Study::read(document, &machine.spec).unwrap();
        let report = Analyze::new(machine.clone(), study).run(&mut ()).unwrap();
        assert!(report.budget.configurations > 0, "{name}: no configuration is reached");
    }
    let mut maps = Vec::new();
    for (name, text) in Page::read("map.md").files() {
        let map = Map::parse(name, text, &machine.spec).unwrap();
        let at = Places::Samples(20);
        let simulate = Simulate {
            machine: machine.clone(),
            map: map.clone(),
            at,
            noise: Some(0.0),
            outliers: 0.0,
            random: false,
            seed: 1,
        };
        if text.contains("[command_pose]") {
            assert!(simulate.run(&mut ()).unwrap_err().to_string().contains("needs joints"), "{name}");
            continue;
        }
        assert_eq!(simulate.run(&mut ()).unwrap().observations.len(), 20, "{name}");
        maps.push(map);
    }
    let page = Page::read("plan.md");
    let folder = written(&page);
    for (name, _) in page.files() {
        let sets = Sets::find(&folder.path().join(name), &machine.spec).unwrap();
        let study = Study::joint_samples(&machine.spec);
        let plan = Plan {
            machine: machine.clone(),
            map: maps[0].clone(),
            choice: Choice::Sets(sets),
            study,
            model_error: 0.0,
            seed: None,
        };
        assert!(plan.run(&mut ()).unwrap().rows > 0, "{name}");
    }
}
