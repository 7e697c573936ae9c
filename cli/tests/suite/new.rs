//! `abbe new` and `abbe schema`: first specs, and what editors know of them.

use std::fs;
use std::path::Path;

use abbe::Class;
use abbe_spec::Spec;
use abbe_study::template::Template;
use serde_json::Value;
use tempfile::tempdir;

use crate::running::{abbe, command, json, prints};

/// Every template is a valid spec under any name, passes `check`, has sources of both classes, and
/// errors of a plausible size.
#[test]
fn every_template_is_a_good_first_spec() {
    let folder = tempdir().unwrap();
    for (template, name, _) in Template::CHOICES.0 {
        assert!(Spec::parse(name, template.text()).is_ok(), "{name}");
        let path = folder.path().join(format!("{name}.toml"));
        let path = path.to_str().unwrap();
        let text = prints(&["new", "my_machine", "--template", name, "--out", path]);
        assert!(text.ends_with(&format!("Next      abbe check {path}\n")), "{text}");
        let spec = Spec::read(path).unwrap();
        assert_eq!(spec.name, "my_machine");
        assert_eq!(fs::read_to_string(path).unwrap().lines().count(), template.text().lines().count());
        let check = json(&["check", path, "--json"]);
        assert!(check["laws"].as_array().unwrap().iter().all(|law| law["holds"] == true), "{name}");
        assert_eq!((&check["warnings"], &check["notes"]), (&serde_json::json!([]), &serde_json::json!([])));
        // Of each class.
        let has = |class: fn(Class) -> bool| spec.sources.iter().any(|source| class(source.class));
        assert!(has(|class| class == Class::Repeatable) && has(|class| matches!(class, Class::Tolerance(_))));
        assert!(has(|class| matches!(class, Class::Random(_))), "{name}");
        if *name == "six-axis" {
            assert!(prints(&["check", path]).contains("Sources   1 repeatable, 2 tolerances, 2 random\n"));
        }
        let budget = json(&["analyze", path, "--json"]);
        let radius = budget["combined"]["radius"].as_f64().unwrap();
        assert!((0.02..5.0).contains(&radius), "{name}: {radius} mm");
    }
}

/// Returns the exit status and the messages of a run in a folder.
fn run_in(folder: &Path, arguments: &[&str]) -> (i32, String) {
    let run = command(arguments).current_dir(folder).output().unwrap();
    (run.status.code().unwrap(), String::from_utf8(run.stderr).unwrap())
}

#[test]
fn the_spec_is_named_and_never_overwrites() {
    let folder = tempdir().unwrap();
    assert_eq!(run_in(folder.path(), &["new", "arm"]), (0, String::new()));
    let file = folder.path().join("arm.toml");
    assert_eq!(fs::read_to_string(&file).unwrap(), Template::SixAxis.spec("arm").unwrap());
    fs::write(&file, "mine").unwrap();
    let (status, message) = run_in(folder.path(), &["new", "arm"]);
    assert!(status == 2 && message.contains("--force"), "{message}");
    assert_eq!(fs::read_to_string(&file).unwrap(), "mine");
    assert_eq!(run_in(folder.path(), &["new", "arm", "--force"]).0, 0);
    assert!(prints(&["new", "arm", "-o", "-"]).starts_with("# A six-axis arm"));
}

#[test]
fn names_are_checked_as_in_a_spec() {
    for (name, message) in [
        ("My", "the name of a manipulator must be in lower case"),
        ("my arm", "`my arm` is not a valid name"),
        ("a\"b", "is not a valid name"),
        ("fn", "`fn` is a keyword of Rust"),
        ("", "this name is empty"),
    ] {
        let run = abbe(&["new", name]);
        assert!(run.status == 2 && run.stderr.contains(message), "{name}: {}", run.stderr);
    }
}

fn schema(file: &str) -> Value {
    serde_json::from_str(&prints(&["schema", file])).unwrap()
}

/// The schemas themselves are tested in `tests/tests/suite/schemas.rs`.
#[test]
fn schemas_are_printed() {
    for file in ["spec", "study", "map", "plan"] {
        let schema = schema(file);
        assert_eq!(schema["$schema"], "https://json-schema.org/draft/2020-12/schema");
        assert_eq!(schema["title"], format!("{file} file of abbe"));
    }
    let dh = &schema("spec")["$defs"]["frame.dh"];
    assert_eq!(dh["required"], serde_json::json!(["theta", "d", "a", "alpha"]));
}
