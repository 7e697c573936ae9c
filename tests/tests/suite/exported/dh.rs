//! Export of DH tables.

use abbe::Manipulator;
use abbe_interpreter::Interpreter;
use abbe_spec::{DhConvention, Spec};
use abbe_study::export::{Export, Format};
use abbe_study::import;
use nalgebra::{Isometry3, Matrix4, Vector3};

use super::urdf::imported;
use super::{about, difference, exported, machine, matrix};

/// Returns the tool pose of a DH table, multiplied in the test.
fn by_table(text: &str, q: &[f64], is_standard: bool) -> Matrix4<f64> {
    let mut q = q.iter();
    let mut pose = Isometry3::identity();
    for line in text.lines().filter(|line| !line.starts_with('#')).skip(1) {
        let cells: Vec<&str> = line.split(',').collect();
        let numbers: Vec<f64> = cells[2..].iter().map(|cell| cell.parse().unwrap()).collect();
        let [sign, mut theta, mut d, a, alpha] = numbers[..] else { panic!("{line}") };
        match cells[1] {
            "revolute" => theta += sign * q.next().unwrap(),
            "prismatic" => d += sign * q.next().unwrap(),
            other => assert_eq!(other, "fixed"),
        }
        let (z, x) = (about(Vector3::z(), theta, d), about(Vector3::x(), alpha, a));
        pose *= if is_standard { z * x } else { x * z };
    }
    assert!(q.next().is_none());
    pose.to_homogeneous()
}

/// Checks errors of DH parameters: the table contains all of them.
#[test]
fn numbers_that_are_off_are_in_the_table() {
    let standard = machine(
        "ur5",
        "[[source]]\nname = \"as built\"\nclass = \"repeatable\"\nframe = \"shoulder\"\ndh = { theta = \"0.4 mrad\", a = \"0.3 mm\", alpha = \"-0.5 mrad\" }\n\
         [[source]]\nname = \"elbow zero\"\nclass = \"repeatable\"\njoint = \"q3\"\nerror = \"-0.7 mrad\"\n\
         [[source]]\nname = \"wrist\"\nclass = \"repeatable\"\nframe = \"wrist 2\"\ndh = { d = \"-0.2 mm\", alpha = \"0.3 mrad\" }\n",
    );
    let modified = machine(
        "panda",
        "[[source]]\nname = \"zero\"\nclass = \"repeatable\"\njoint = \"q4\"\nerror = \"0.6 mrad\"\n",
    );
    for (machine, is_standard) in [(standard, true), (modified, false)] {
        let report = exported(&machine, Format::Dh);
        let unit = machine.spec.length.in_metres();
        assert!(report.before.position.largest * unit > 2e-4, "{report:?}");
        assert!(
            report.remains.position.largest * unit < 1e-9 && report.remains.angle.largest < 1e-9,
            "{report:?}"
        );
        // The tool after the flange is listed beside the table.
        let tool = if is_standard { 0.0 } else { 0.107 };
        let tool = Matrix4::new_translation(&Vector3::new(0.0, 0.0, tool));
        let [shift, turn] = difference(&machine, |q| by_table(&report.files[0].text, q, is_standard) * tool);
        assert!(shift * unit < 1e-9 && turn < 1e-9, "{shift:e} {turn:e}");
        assert!(report.left_out.iter().all(|line| !line.contains("holds their means")));

        // Read by `abbe import`, as any other table.
        let folder = tempfile::tempdir().unwrap();
        let file = folder.path().join("arm.csv");
        std::fs::write(&file, &report.files[0].text).unwrap();
        let convention = if is_standard { DhConvention::Standard } else { DhConvention::Modified };
        let text = imported(&file, import::Format::Table { convention, units: import::Units::default() });
        let read = Spec::parse("read.toml", &text).unwrap();
        assert_eq!(read.length, machine.spec.length);
        let names = |spec: &Spec| spec.variables.iter().map(|one| one.name.clone()).collect::<Vec<_>>();
        assert_eq!(names(&read), names(&machine.spec));
        let read = Interpreter::new(read);
        let [shift, turn] = difference(&machine, |q| matrix(&read.pose(q, &[]).unwrap()) * tool);
        assert!(shift * unit < 1e-9 && turn < 1e-9, "{shift:e} {turn:e}");
    }
}

/// Checks that a chain of matrices (PUMA) and one with a prismatic joint (Stanford arm) have
/// tables, and that the export of a milling machine is refused.
#[test]
fn chains_of_any_form_have_a_table_if_they_are_of_one_convention() {
    for (name, word) in
        [("puma560", "standard"), ("stanford", "standard"), ("wam", "standard"), ("iiwa", "modified")]
    {
        let report = exported(&machine(name, ""), Format::Dh);
        assert!(report.format.ends_with(word), "{}", report.format);
    }
    let job = Export { machine: machine("machine3", ""), format: Format::Dh, samples: 10, seed: 0 };
    let mistake = job.run(&mut ()).unwrap_err();
    assert!(
        mistake.list[0].message.contains("the frame \"X\" has no Denavit-Hartenberg numbers"),
        "{mistake:?}"
    );
}

/// Checks that a tilt between parallel axes, about the normal that alpha does not turn about,
/// remains, and that no parameter diverges.
#[test]
fn a_tilt_that_a_table_cannot_hold_remains() {
    let tilt =
        "[[source]]\nname = \"tilt\"\nclass = \"repeatable\"\nframe = \"shoulder\"\ne_s = \"0.5 mrad\"\n";
    let machine = machine("ur5", tilt);
    let report = exported(&machine, Format::Dh);
    let [shift, _] = difference(&machine, |q| by_table(&report.files[0].text, q, true));
    assert!(
        report.remains.position.largest > 0.01 && report.remains.position.rms < report.before.position.rms
    );
    // Other configurations of the same robot: residuals of the same size.
    assert!((shift / report.remains.position.largest - 1.0).abs() < 0.3, "{shift} {:?}", report.remains);
    for line in report.files[0].text.lines().skip(2) {
        let numbers: Vec<f64> = line.split(',').skip(3).map(|cell| cell.parse().unwrap()).collect();
        assert!(numbers.iter().all(|number| number.abs() < 500.0), "{line}");
    }
    assert!(report.left_out.iter().any(|line| line.contains("q2 and q3")), "{:?}", report.left_out);
}

/// Checks that sources that vary with the configuration are named, and only these, and that an
/// input that is set stays.
#[test]
fn what_changes_is_held_at_its_mean() {
    let machine = machine(
        "ur5",
        "[[source]]\nname = \"zero\"\nclass = \"repeatable\"\njoint = \"q2\"\nerror = \"0.3 mrad\"\n\
         [[source]]\nname = \"windup\"\nclass = \"repeatable\"\njoint = \"q3\"\nerror = \"0.2 mrad * cos(q2)\"\n",
    );
    let report = exported(&machine, Format::Dh);
    let said: Vec<&String> =
        report.left_out.iter().filter(|line| line.contains("holds their means")).collect();
    assert!(matches!(said[..], [line] if line.ends_with(": \"windup\".")), "{:?}", report.left_out);
    assert!(report.remains.position.largest > 0.01);
}
