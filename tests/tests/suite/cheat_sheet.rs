//! The tables of `docs/cheat-sheet.md`, evaluated.

use std::collections::BTreeSet;

use abbe::{Component, Manipulator, Pose, real_pose};
use abbe_interpreter::Interpreter;
use abbe_manipulators::SHIPPED;
use abbe_spec::Spec;
use abbe_spec::expr::UNIT_NAMES;

const SHEET: &str = include_str!("../../../docs/cheat-sheet.md");

/// Returns the cells of the table below a heading, without code marks and without its two head
/// lines.
fn table(heading: &str) -> Vec<Vec<String>> {
    let section = SHEET.split("\n## ").find(|section| section.starts_with(heading)).expect(heading);
    let rows = section.lines().filter(|line| line.starts_with('|')).skip(2);
    rows.map(|row| {
        row.trim_matches('|').split(" | ").map(|cell| cell.trim().replace('`', "")).collect::<Vec<_>>()
    })
    .collect()
}

fn robot(frames: &str) -> Interpreter {
    let head = "[manipulator]\nname = \"sheet\"\nlength = \"mm\"\n";
    Interpreter::new(Spec::parse("sheet.toml", &format!("{head}{frames}")).unwrap())
}

/// Returns the pose of a chain of one frame without a variable.
fn pose(frame: &str) -> [[f64; 3]; 4] {
    let free = "[[frame]]\nname = \"moved\"\nvariable = { name = \"q1\", kind = \"revolute\" }\ntransform = \"Rz(q1)\"\n";
    robot(&format!("{free}[[frame]]\nname = \"fixed\"\n{frame}\n")).pose(&[0.0], &[]).unwrap().0
}

fn close(a: &[[f64; 3]], b: &[[f64; 3]]) -> bool {
    a.iter().flatten().zip(b.iter().flatten()).all(|(a, b)| (a - b).abs() < 1e-9)
}

/// Checks order, kind, axis and sign of the six errors: each by itself displaces the exact chain.
#[test]
fn six_errors() {
    let rows = table("The six errors");
    assert_eq!(rows.len(), 6);
    let tool = [3.0, 5.0, 7.0];
    let size = 1e-6;
    for (index, row) in rows.iter().enumerate() {
        let [number, error, kind, axis, _] = &row[..] else { panic!("{row:?}") };
        assert_eq!(number.parse(), Ok(index + 1));
        assert_eq!(error.as_str(), Component::ALL[index].name());
        let axis = ["x", "y", "z"].iter().position(|name| name == axis).unwrap();
        let spec = format!(
            "[[frame]]\nname = \"f\"\nvariable = {{ name = \"q1\", kind = \"revolute\" }}\ntransform = \"Rz(q1)\"\n\
             [tool]\ntransform = \"Tx({}) Ty({}) Tz({})\"\n\
             [[source]]\nname = \"s\"\nclass = \"repeatable\"\nframe = \"f\"\n{error} = \"{size}\"\n",
            tool[0], tool[1], tool[2]
        );
        let robot = robot(&spec);
        let (mut errors, mut transforms) = ([[0.0; 6]], [Pose::IDENTITY; 2]);
        robot.generalized_errors(&[0.0], &[], &[], &mut errors).unwrap();
        robot.transforms(&[0.0], &[], &mut transforms).unwrap();
        let (real, ideal) = (real_pose(&transforms, &errors).0, robot.pose(&[0.0], &[]).unwrap().0);
        let displaced: [f64; 3] = std::array::from_fn(|i| (real[3][i] - ideal[3][i]) / size);
        let unit: [f64; 3] = std::array::from_fn(|i| if i == axis { 1.0 } else { 0.0 });
        let expected = if kind == "shift" {
            unit
        } else {
            assert!(kind.starts_with("turn"), "{kind}");
            std::array::from_fn(|i| {
                let (j, k) = ((i + 1) % 3, (i + 2) % 3);
                unit[j] * tool[k] - unit[k] * tool[j]
            })
        };
        for (a, b) in displaced.into_iter().zip(expected) {
            assert!((a - b).abs() < 1e-4, "{error}: {displaced:?}, expected {expected:?}");
        }
    }
}

#[test]
fn denavit_hartenberg_and_urdf_are_their_formulas() {
    let with = |formula: &str, numbers: &[(&str, f64)]| {
        let text = numbers.iter().fold(formula.to_owned(), |text, (name, value)| {
            text.replace(&format!("({name})"), &format!("({value})"))
        });
        pose(&format!("transform = \"{text}\""))
    };
    let numbers = [("theta", 0.3), ("d", 20.0), ("a", 50.0), ("alpha", 0.7)];
    let rows = table("Denavit-Hartenberg");
    assert_eq!(rows.len(), 2);
    for row in rows {
        let key = row[0].split(',').next().unwrap();
        let given = pose(&format!("{key} = {{ theta = 0.3, d = 20, a = 50, alpha = 0.7 }}"));
        assert!(close(&given, &with(&row[1], &numbers)), "{key}");
    }
    let numbers = [("x", 10.0), ("y", 20.0), ("z", 30.0), ("roll", 0.2), ("pitch", 0.4), ("yaw", 0.6)];
    let [row] = &table("URDF")[..] else { panic!("one row") };
    let given = pose("origin = { xyz = [10, 20, 30], rpy = [0.2, 0.4, 0.6] }");
    assert!(close(&given, &with(&row[1], &numbers)));
}

/// Checks the letters of ISO 230-1 against the sources of the shipped machine tool.
#[test]
fn letters_of_iso_230() {
    let machine = SHIPPED.iter().find(|shipped| shipped.name == "machine3").unwrap();
    let description = machine.compiled.description();
    let mut compared = 0;
    for row in table("The six errors") {
        for axis in ["X", "Y", "Z"] {
            let name = format!("{}{axis}", row[4]);
            let effect = description.effects.iter().find(|e| *description.sources[e.source].name == name);
            let effect = effect.unwrap_or_else(|| panic!("{name}"));
            assert_eq!(effect.component.name(), row[1], "{name}");
            assert_eq!(&*description.frames[effect.frame].name, axis, "{name}");
            compared += 1;
        }
    }
    assert_eq!(compared, 18);
}

#[test]
fn units_are_those_that_can_be_written() {
    let cells = table("Units");
    let listed: BTreeSet<&str> = cells.iter().flat_map(|row| row[1].split(", ")).collect();
    assert_eq!(listed, UNIT_NAMES.into_iter().collect());
}
