//! URDF robots as specs: the imported robot equals that of the file.

use std::f64::consts::FRAC_PI_2;
use std::fmt::Write;

use abbe::Manipulator;
use abbe::analysis::{Workspace, random_joint_samples, sampling};
use abbe_interpreter::Interpreter;
use abbe_spec::{Document, Spec};
use abbe_study::Machine;
use abbe_study::import::{Format, Import, Report};
use nalgebra::{Matrix4, Rotation3, Unit, Vector3};

use super::imported_tables::Heard;

struct Imported {
    report: Report,
    spec: Interpreter,
}

fn imported(urdf: &str, tip: &str, fold: bool, round_angles: bool) -> Imported {
    imported_from(None, urdf, tip, fold, round_angles)
}

fn imported_from(base: Option<&str>, urdf: &str, tip: &str, fold: bool, round_angles: bool) -> Imported {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("robot.urdf");
    std::fs::write(&file, urdf).unwrap();
    let format = Format::Urdf { base: base.map(str::to_owned), tip: Some(tip.to_owned()), fold };
    let report = Import { file, format, round_angles }.run(&mut ()).unwrap();
    let spec = Interpreter::new(Spec::parse("robot.toml", &report.spec).unwrap());
    Imported { report, spec }
}

fn pose(arm: &dyn Manipulator, q: &[f64]) -> Matrix4<f64> {
    let rows = arm.pose(q, &sampling::nominal_parameters(arm.description())).unwrap().rows();
    Matrix4::from_fn(|i, j| rows[i][j])
}

fn joint(name: &str, kind: &str, ends: [&str; 2], origin: &str, rest: &str) -> String {
    let [parent, child] = ends;
    format!(
        "<joint name=\"{name}\" type=\"{kind}\"><parent link=\"{parent}\"/><child link=\"{child}\"/>\
         <origin {origin}/>{rest}</joint>\n"
    )
}

/// Checks a Panda by Craig's parameters, `A = Rx(α) Tx(a) Rz(θ) Tz(d)`: the axis of θ is at
/// `(a, −d sin α, d cos α)`, rotated by α about x.
#[test]
fn a_panda_in_urdf_is_the_shipped_one() {
    let numbers: [[f64; 3]; 7] = [
        [0.0, 0.333, 0.0],
        [0.0, 0.0, -FRAC_PI_2],
        [0.0, 0.316, FRAC_PI_2],
        [0.0825, 0.0, FRAC_PI_2],
        [-0.0825, 0.384, -FRAC_PI_2],
        [0.0, 0.0, FRAC_PI_2],
        [0.088, 0.0, FRAC_PI_2],
    ];
    let mut urdf = String::from("<robot name=\"Panda of numbers\">\n");
    for i in 0..=8 {
        writeln!(urdf, "<link name=\"link{i}\"/>").unwrap();
    }
    for (i, [a, d, alpha]) in numbers.into_iter().enumerate() {
        let origin = format!("xyz=\"{a} {} {}\" rpy=\"{alpha} 0 0\"", -d * alpha.sin(), d * alpha.cos());
        let ends = [format!("link{i}"), format!("link{}", i + 1)];
        let rest = "<axis xyz=\"0 0 1\"/><limit lower=\"-2\" upper=\"2\"/>";
        urdf += &joint(
            &format!("Joint {}", i + 1),
            "revolute",
            ends.each_ref().map(String::as_str),
            &origin,
            rest,
        );
    }
    urdf += &joint("flange", "fixed", ["link7", "link8"], "xyz=\"0 0 0.107\"", "");
    urdf += "</robot>\n";

    let shipped = Machine::find("panda").unwrap().evaluator(true);
    for fold in [false, true] {
        let Imported { report, spec } = imported(&urdf, "link8", fold, false);
        assert_eq!(report.manipulator, "panda_of_numbers");
        assert_eq!(spec.description().frames.len(), if fold { 7 } else { 8 });
        assert_eq!(spec.description().variables[0].name, "joint_1");
        let samples = random_joint_samples(&*shipped, &[0, 1, 2, 3, 4, 5, 6], 100, 1).unwrap().reached();
        for sample in samples {
            let off = (pose(&*shipped, &sample.q) - pose(&spec, &sample.q)).abs().max();
            assert!(off < 2e-15, "{off:.1e}");
        }
    }
}

/// Compares every feature of a chain with rotations by Rodrigues' formula: prismatic and revolute
/// joints in general direction, mimic joints of all four kinds, and fixed joints between them.
#[test]
fn joints_of_every_kind() {
    let links = ["ground", "base", "carriage", "arm", "plate", "finger", "wheel", "tip", "camera"];
    let mut urdf = String::from("<robot name=\"mixed\">\n");
    for link in links {
        writeln!(
            urdf,
            "<link name=\"{link}\"><inertial><origin xyz=\"0.1 0 0\"/><mass value=\"2\"/></inertial></link>"
        )
        .unwrap();
    }
    let limits = "<limit lower=\"0.1\" upper=\"0.5\"/>";
    urdf += &joint(
        "foot",
        "fixed",
        ["ground", "base"],
        "xyz=\"0.1 0.2 0.3\" rpy=\"0.1 1.5707963267948966 0.4\"",
        "",
    );
    urdf += &joint(
        "slide",
        "prismatic",
        ["base", "carriage"],
        "xyz=\"0 0 0.5\"",
        &format!("<axis xyz=\"0.6 0.8 0\"/>{limits}"),
    );
    urdf += &joint("turn", "continuous", ["carriage", "arm"], "rpy=\"0 0.3 0\"", "<axis xyz=\"2 2 1\"/>");
    urdf += &joint("mount", "fixed", ["arm", "plate"], "xyz=\"0.4 0 0\" rpy=\"1.57079632679 0 0\"", "");
    // It translates with the rotation of another joint, and rotates with the translation of
    // another.
    let follows = |joint: &str, numbers: &str| format!("<mimic joint=\"{joint}\" {numbers}/>");
    let mimic =
        format!("<axis xyz=\"0 1 0\"/>{limits}{}", follows("turn", "multiplier=\"-0.05\" offset=\"0.02\""));
    urdf += &joint("finger joint", "prismatic", ["plate", "finger"], "xyz=\"0 0.1 0\"", &mimic);
    let mimic = format!("<axis xyz=\"0 -1 -4e-8\"/>{}", follows("slide", "multiplier=\"3\" offset=\"-0.5\""));
    urdf +=
        &joint("wheel joint", "continuous", ["finger", "wheel"], "xyz=\"0 0 0.2\" rpy=\"0.2 0 0\"", &mimic);
    // It follows a mimic joint.
    let mimic = format!("<axis xyz=\"1 1 0\"/>{}", follows("wheel joint", "multiplier=\"2\""));
    urdf += &joint("last", "continuous", ["wheel", "tip"], "xyz=\"0.05 0 0\"", &mimic);
    urdf += &joint("hook", "fixed", ["plate", "camera"], "xyz=\"0 0 1\"", "");
    urdf += "</robot>\n";

    let almost_right = "1.57079632679".parse::<f64>().unwrap();
    let about = |axis: [f64; 3], angle: f64| {
        Rotation3::from_axis_angle(&Unit::new_normalize(Vector3::from(axis)), angle).to_homogeneous()
    };
    let along = |x: f64, y: f64, z: f64| Matrix4::new_translation(&Vector3::new(x, y, z));
    let [x, y, z] = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    let expected = |slide: f64, turn: f64| {
        let wheel = 3.0 * slide - 0.5;
        along(0.1, 0.2, 0.3)
            * about(z, 0.4)
            * about(y, FRAC_PI_2)
            * about(x, 0.1)
            * along(0.0, 0.0, 0.5)
            * along(0.6 * slide, 0.8 * slide, 0.0)
            * about(y, 0.3)
            * about([2.0, 2.0, 1.0], turn)
            * along(0.4, 0.0, 0.0)
            * about(x, almost_right)
            * along(0.0, 0.1, 0.0)
            * along(0.0, 0.02 - 0.05 * turn, 0.0)
            * along(0.0, 0.0, 0.2)
            * about(x, 0.2)
            * about([0.0, -1.0, -4e-8], wheel)
            * along(0.05, 0.0, 0.0)
            * about([1.0, 1.0, 0.0], 2.0 * wheel)
    };
    for fold in [false, true] {
        let Imported { report, spec } = imported(&urdf, "tip", fold, false);
        let description = spec.description();
        assert_eq!(
            description.variables.iter().map(|variable| &*variable.name).collect::<Vec<_>>(),
            ["slide", "turn"]
        );
        assert_eq!(report.frames.len(), if fold { 5 } else { 7 });
        assert_eq!(report.frames.iter().filter(|frame| frame.follows).count(), 3);
        // All but the ground, which carries the first frame; folded, the base is part of the ground
        // as well.
        assert_eq!(report.loads, if fold { 7 } else { 8 });
        for (slide, turn) in [(0.1, 0.0), (0.3, 1.0), (0.47, -2.9), (0.25, 3.1)] {
            let off = (pose(&spec, &[slide, turn]) - expected(slide, turn)).abs().max();
            assert!(off < 2e-15, "{off:.1e}");
        }
    }

    // The only angle that is almost 90° is rounded.
    let rounded = imported(&urdf, "tip", false, true);
    assert!(rounded.report.spec.contains("rpy = [\"pi/2\", 0, 0]"), "{}", rounded.report.spec);
    let off = (pose(&rounded.spec, &[0.3, 1.0]) - expected(0.3, 1.0)).abs().max();
    assert!((1e-13..1e-11).contains(&off), "{off:.1e}");
}

/// Checks a chain from foot to hand: up a leg to the pelvis and down an arm. Its pose is the pose
/// of the hand relative to the foot of the two chains from the root. The foot turns against the
/// root, so that gravity has no direction in it, and there are no loads.
#[test]
fn a_chain_goes_up_one_branch_and_down_another() {
    let mut urdf = String::from("<robot name=\"humanoid\">\n<link name=\"world\"/>\n");
    for link in ["pelvis", "thigh", "foot", "arm", "hand"] {
        urdf += &format!(
            "<link name=\"{link}\"><inertial><origin xyz=\"0.01 0.02 0.03\"/><mass value=\"2\"/></inertial></link>\n"
        );
    }
    let turn = |axis: &str| format!("<axis xyz=\"{axis}\"/><limit lower=\"-2\" upper=\"2\"/>");
    urdf += &joint("root", "fixed", ["world", "pelvis"], "xyz=\"0 0 1\" rpy=\"0 0 0.3\"", "");
    urdf += &joint(
        "hip",
        "revolute",
        ["pelvis", "thigh"],
        "xyz=\"0.1 0.2 -0.1\" rpy=\"0.4 -0.2 0.1\"",
        &turn("0 0.6 0.8"),
    );
    urdf += &joint("ankle", "revolute", ["thigh", "foot"], "xyz=\"0 0.05 -0.8\"", &turn("1 0 0"));
    urdf += &joint(
        "shoulder",
        "revolute",
        ["pelvis", "arm"],
        "xyz=\"-0.2 0 0.4\" rpy=\"-1 0.5 0\"",
        &turn("0 0 1"),
    );
    urdf += &joint("wrist", "fixed", ["arm", "hand"], "xyz=\"0.3 0 0\" rpy=\"0 0 0.7\"", "");
    urdf += "</robot>\n";
    let [leg, arm] = ["foot", "hand"].map(|tip| imported(&urdf, tip, false, false).spec);
    for fold in [false, true] {
        let Imported { report, spec } = imported_from(Some("foot"), &urdf, "hand", fold, false);
        let names: Vec<&str> = spec.description().variables.iter().map(|v| v.name.as_ref()).collect();
        assert_eq!(names, ["ankle", "hip", "shoulder"]);
        for q in [[0.0, 0.0, 0.0], [0.3, -0.7, 1.1], [-1.2, 0.4, -0.6]] {
            let [ankle, hip, shoulder] = q;
            let expected = pose(&leg, &[hip, ankle]).try_inverse().unwrap() * pose(&arm, &[shoulder]);
            let found = pose(&spec, &q);
            assert!((found - expected).abs().max() < 1e-12, "{found}, not {expected}");
        }
        assert!(!report.spec.contains("[[load]]") && !report.spec.contains("gravity"), "{}", report.spec);
    }
}

/// Imports a text, and returns the spec with all notes.
fn with_notes(text: &str, base: Option<&str>, round_angles: bool) -> Result<(String, Vec<String>), String> {
    let format = Format::Urdf { base: base.map(str::to_owned), tip: Some("tip".to_owned()), fold: false };
    let mut heard = Heard::default();
    let import = Import { file: "robot.urdf".into(), format, round_angles };
    let report = import.read(Document::new("robot.urdf", text), &mut heard);
    report.map(|report| (report.spec, heard.0)).map_err(|mistakes| mistakes.to_string())
}

/// A robot of two joints, with something in its second joint, and something behind its joints.
fn robot(second: &str, behind: &str) -> String {
    let turn = "<axis xyz=\"0 1 0\"/><limit lower=\"-2\" upper=\"2\"/>";
    let links: String =
        ["base", "arm", "tip", "side", "lamp"].map(|name| format!("<link name=\"{name}\"/>\n")).concat();
    let joints = [
        joint("a", "revolute", ["base", "arm"], "xyz=\"0 0 0.3\"", turn),
        joint("b", "revolute", ["arm", "tip"], "xyz=\"0.4 0 0\"", &format!("{turn}{second}")),
        joint("to_side", "fixed", ["arm", "side"], "xyz=\"0.1 0 0\"", ""),
        joint("to_lamp", "fixed", ["arm", "lamp"], "xyz=\"0.2 0 0\"", ""),
    ];
    format!("<robot name=\"r\">\n{links}{}{behind}</robot>\n", joints.concat())
}

/// Checks that what stands beside the chain never keeps it from being read, and has one note.
#[test]
fn faults_beside_the_chain_are_noted() {
    let (expected, notes) = with_notes(&robot("", ""), None, false).unwrap();
    assert_eq!(notes, Vec::<String>::new());
    let limits = "<axis xyz=\"0 0 1\"/><limit lower=\"-1\" upper=\"1\"/>";
    let branch = |kind: &str, rest: &str| {
        format!("<link name=\"more\"/>{}", joint("branch", kind, ["lamp", "more"], "xyz=\"0 0 0\"", rest))
    };
    let faults = [
        (branch("revolute", "<axis xyz=\"0 0 1\"/><limit lower=\"1\" upper=\"-1\"/>"), "reversed"),
        (branch("revolute", "<axis xyz=\"0 0 0\"/><limit lower=\"-1\" upper=\"1\"/>"), "is zero"),
        (branch("revolute", "<axis xyz=\"0 0 one\"/>"), "three finite numbers"),
        (branch("revolute", "<limit lower=\"nan\" upper=\"1\"/>"), "finite number"),
        (branch("hinge", limits), "unknown joint type"),
        (branch("revolute", &format!("{limits}<mimic/>")), "has no `joint`"),
        (branch("revolute", "<axis xyz=\"${x}\"/>"), "xacro"),
        (joint("branch", "fixed", ["lamp", "nowhere"], "xyz=\"0 0 0\"", ""), "no link `nowhere`"),
    ];
    for (fault, part) in faults {
        let (spec, notes) =
            with_notes(&robot("", &fault), None, false).unwrap_or_else(|text| panic!("{text}"));
        assert_eq!(spec, expected, "{fault}");
        let about = notes.iter().filter(|note| note.contains(part)).count();
        assert!(about == 1 && notes.iter().any(|note| note.starts_with("line ")), "{fault}: {notes:?}");
    }
    // Prefixes are part of names, declared or not, however deep.
    let nested: String = (0..2000).map(|i| format!("<p{i}:x xmlns:p{i}=\"u{i}\">")).collect();
    let ends: String = (0..2000).rev().map(|i| format!("</p{i}:x>")).collect();
    let vendor = "<gazebo><!-- a:b --><vendor:lamp vendor:on='a>:b'/><![CDATA[<c:d>]]></gazebo>";
    for beside in [vendor.to_owned(), nested + &ends] {
        let (spec, notes) = with_notes(&robot("", &beside), None, false).unwrap();
        assert!(spec == expected && notes.is_empty(), "{notes:?}");
    }
    let lamp = robot("", "<xacro:lamp on=\"side\"/>")
        .replace("<robot", "<robot xmlns:xacro=\"http://ros.org/xacro\"");
    let (spec, notes) = with_notes(&lamp, None, false).unwrap();
    assert!(spec == expected && notes[0].contains("the macro `lamp` was not expanded"), "{notes:?}");
    let (spec, notes) = with_notes(&robot("<mimic joint=\"elsewhere\"/>", ""), None, false).unwrap();
    assert!(spec == expected && notes[0].contains("which is no joint: it was given"), "{notes:?}");
    // A similar name is named, and not taken.
    let (spec, notes) = with_notes(&robot("<mimic joint=\"to_sida\"/>", ""), None, false).unwrap();
    assert!(spec == expected && notes[0].contains("(is `to_side` meant?)"), "{notes:?}");
    let root = robot("", "").replace("<link name=\"base\"/>", "");
    for base in [None, Some("base")] {
        let (spec, notes) = with_notes(&root, base, false).unwrap();
        assert!(spec == expected && notes[0].contains("`base` is not declared"), "{notes:?}");
    }
}

/// Checks that the same faults on the chain are mistakes.
#[test]
fn faults_of_the_chain_are_mistakes() {
    for (from, to, part) in [
        ("upper=\"2\"", "upper=\"-3\"", "are reversed"),
        ("xyz=\"0 1 0\"", "xyz=\"0 0 0\"", "is zero"),
        ("xyz=\"0.4 0 0\"", "xyz=\"${reach} 0 0\"", "xacro file"),
        (
            "<link name=\"tip\"/>",
            "<link name=\"tip\"><inertial><mass value=\"-1\"/></inertial></link>",
            "is negative",
        ),
    ] {
        let mistakes = with_notes(&robot("", "").replace(from, to), None, false).unwrap_err();
        assert!(mistakes.contains(part), "{mistakes}");
    }
}

/// Limits that are no limits count as none, and those that may be degrees are asked about.
#[test]
fn limits_beyond_two_turns_are_questioned() {
    let of = |upper: &str| with_notes(&robot("", "").replace("upper=\"2\"", upper), None, false).unwrap();
    for (upper, is_asked, has_limits) in [
        ("6.28", false, true),
        ("180", true, true),
        ("360", true, true),
        ("10", false, true),
        ("20", true, true),
        ("999999", false, false),
    ] {
        let (spec, notes) = of(&format!("upper=\"{upper}\""));
        let asked = notes.iter().any(|note| note.contains(&format!("\"{upper} deg\"")));
        assert_eq!(asked, is_asked, "{upper}: {notes:?}");
        assert_eq!(!spec.contains("turns without end"), has_limits, "{spec}");
        assert_eq!(notes.iter().any(|note| note.contains("count as none")), !has_limits, "{notes:?}");
    }
}

/// Checks that angles of few digits near a multiple of 45° are named, with their effect.
#[test]
fn angles_of_few_digits_are_named() {
    let tipped = |rpy: &str, round| {
        let text = robot("", "").replace("xyz=\"0 0 0.3\"", &format!("xyz=\"0 0 0.3\" rpy=\"{rpy}\""));
        with_notes(&text, None, round).unwrap().1
    };
    // The tip is 0.4 m behind the angle.
    let notes = tipped("0 1.57 3.141", false);
    assert!(notes[0].contains("2 angles are (1.57, 3.141 rad) by up to 0.8 mrad"), "{notes:?}");
    assert!(
        notes[0].contains("would move the tool by up to 0.3") || notes[0].contains("by up to 0.4"),
        "{notes:?}"
    );
    assert!(tipped("0 1.57 3.141", true)[0].contains("too far to be rounded"));
    // Calibrated ones have more digits.
    assert_eq!(tipped("0 1.5700123456 0", false), Vec::<String>::new());
    assert!(tipped("0 0 0", true)[0].contains("no angle was rounded"));
}
