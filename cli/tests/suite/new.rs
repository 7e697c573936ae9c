//! `abbe new` and `abbe schema`: first specs, and what editors know of them.

use std::fs;
use std::path::Path;

use abbe::analysis::sampling;
use abbe::{Class, Manipulator, rotation_vector};
use abbe_interpreter::Interpreter;
use abbe_spec::{Source, Spec};
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
        let text = template.spec("other_name", None).unwrap();
        assert!(Spec::parse(name, &text).is_ok(), "{name}");
        let lines = text.lines().count();
        let path = folder.path().join(format!("{name}.toml"));
        let path = path.to_str().unwrap();
        let text = prints(&["new", "my_machine", "--template", name, "--out", path]);
        assert!(text.ends_with(&format!("Next      abbe check {path}\n")), "{text}");
        let spec = Spec::read(path).unwrap();
        assert_eq!(spec.name, "my_machine");
        assert_eq!(fs::read_to_string(path).unwrap().lines().count(), lines);
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
    assert_eq!(fs::read_to_string(&file).unwrap(), Template::SixAxis.spec("arm", None).unwrap());
    fs::write(&file, "mine").unwrap();
    let (status, message) = run_in(folder.path(), &["new", "arm"]);
    assert!(status == 2 && message.contains("--force"), "{message}");
    assert_eq!(fs::read_to_string(&file).unwrap(), "mine");
    assert_eq!(run_in(folder.path(), &["new", "arm", "--force"]).0, 0);
    assert!(prints(&["new", "arm", "-o", "-"]).starts_with("# A six-axis arm"));
}

/// A machine tool has the axes of its order, and the pose that they mean: each coordinate moves the
/// tool against the workpiece, whichever of the two it carries. Errors of places stand still where
/// the axis does.
#[test]
fn machine_tools_of_any_order() {
    let folder = tempdir().unwrap();
    let path = folder.path().join("mill.toml");
    let path = path.to_str().unwrap();
    for (order, frames) in [
        ("w X' Y' b Z t", "X' Y' bed Z"),
        ("[w b X Y Z (C) t]", "bed X Y Z"),
        ("V [w C' A' b X Y Z (C1) t]", "C' A' bed X Y Z"),
        ("w Y′ b X Z B t", "Y' bed X Z B"),
        ("w X' b Y Z C B t", "X' bed Y Z C B"),
        ("w C' X' b Z W t", "C' X' bed Z W"),
    ] {
        prints(&["new", "mill", "--axes", order, "-o", path, "--force"]);
        let spec = Spec::read(path).unwrap();
        let names: Vec<&str> = spec.frames.iter().map(|frame| &*frame.name).collect();
        assert_eq!(names.join(" "), frames);
        let check = json(&["check", path, "--json"]);
        assert!(check["laws"].as_array().unwrap().iter().all(|law| law["holds"] == true), "{order}");
        assert_eq!((&check["warnings"], &check["notes"]), (&serde_json::json!([]), &serde_json::json!([])));
        let machine = Interpreter::new(spec.clone());
        let s: Vec<f64> = spec.parameters.iter().map(|parameter| parameter.value).collect();
        let home = sampling::home(machine.description());
        let at_home = machine.pose(&home, &s).unwrap();
        for (i, variable) in spec.variables.iter().enumerate() {
            let mut q = home.clone();
            q[i] += 0.25;
            let moved = machine.pose(&q, &s).unwrap();
            let axis = "xyzuvwabc".find(&variable.name).unwrap();
            // All rotary axes are at 0 at home: axes are those of the workpiece.
            let by: [f64; 3] = match axis {
                0..6 => [0, 1, 2].map(|k| moved.position()[k] - at_home.position()[k]),
                _ => rotation_vector(&moved),
            };
            (0..3).for_each(|k| assert!((by[k] - if k == axis % 3 { 0.25 } else { 0.0 }).abs() < 1e-9));
        }
        // The place of a rotary axis is wrong by 10 um: of one that carries the workpiece the tool
        // is moved in axes that turn with the workpiece, of others in those before it.
        for source in spec.sources.iter().filter(|source| {
            source.name.contains('0') && !source.name.contains("0Y") && !source.name.contains("0Z")
        }) {
            let letter = source.name.chars().last().unwrap().to_lowercase().to_string();
            let place = spec.variables.iter().position(|variable| variable.name == letter).unwrap();
            let along = "XYZ".find(&source.name[1..2]);
            let (Some(along), 1) =
                (along, spec.variables.iter().filter(|one| "abc".contains(&*one.name)).count())
            else {
                continue;
            };
            let carries = names.iter().any(|name| name.to_lowercase() == format!("{letter}'"));
            let mut q = home.clone();
            q[place] = 1.0;
            let alone = Source { class: Class::Repeatable, ..source.clone() };
            let real = Interpreter::new(Spec { sources: vec![alone], ..spec.clone() });
            let real = real.real_pose(&q, &s, &[]).unwrap();
            let turned = machine.pose(&q, &s).unwrap();
            let unit = [0, 1, 2].map(|k| if k == along { 0.01 } else { 0.0 });
            let wanted = if carries { turned.turn(unit) } else { unit };
            let moved = [0, 1, 2].map(|k| real.position()[k] - turned.position()[k]);
            (0..3).for_each(|k| {
                assert!((moved[k] - wanted[k]).abs() < 1e-9, "{order} {}: {moved:?}", source.name);
            });
        }
    }
    for (order, message) in [
        ("X Y Z", "begins with `w`"),
        ("w X Y' b Z t", "the axis X is on the wrong side of the bed"),
        ("w b X' t", "the axis X' is on the wrong side of the bed"),
        ("w b X X t", "the axis X is there twice"),
        ("w b Q t", "unknown axis `Q`"),
        ("w b t", "there are no axes"),
        ("", "there are no axes"),
    ] {
        let (status, said) = run_in(folder.path(), &["new", "mill", "--axes", order, "-o", "-"]);
        assert!(status == 2 && said.contains(message), "{order}: {said}");
    }
    let (status, said) = run_in(folder.path(), &["new", "mill", "--axes", "w b X t", "--template", "scara"]);
    assert!(status == 2 && said.contains("only a machine tool has axes in an order"), "{said}");
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
