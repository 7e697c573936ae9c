//! Errors that the data cannot distinguish are named together.

use abbe_metrology::Acceptance;
use abbe_metrology::data::{Data, Map};
use abbe_metrology::identify::{Identify, JointError, Prior, Report, Settings};
use abbe_metrology::simulate::{Places, Simulate};
use abbe_spec::Spec;
use abbe_study::Machine;
use abbe_tests::sample_size;

/// An arm with a spherical wrist; the tool point is on the axis of q6, 206 mm from the wrist.
pub(super) const ARM: &str = r#"
[manipulator]
name = "arm"
title = "Six axes and a spherical wrist"
length = "mm"

[tool]
transform = "Tx(TOOL mm) Tz(126 mm)"

[[frame]]
name = "A1"
variable = { name = "q1", kind = "revolute", limits = ["-170 deg", "170 deg"], home = "10 deg" }
dh = { theta = "q1", d = "400 mm", a = "25 mm", alpha = "-90 deg" }

[[frame]]
name = "A2"
variable = { name = "q2", kind = "revolute", limits = ["-150 deg", "20 deg"], home = "-60 deg" }
dh = { theta = "q2", d = 0, a = "455 mm", alpha = 0 }

[[frame]]
name = "A3"
variable = { name = "q3", kind = "revolute", limits = ["-90 deg", "90 deg"], home = "10 deg" }
dh = { theta = "q3", d = 0, a = "35 mm", alpha = "-90 deg" }

[[frame]]
name = "A4"
variable = { name = "q4", kind = "revolute", limits = ["-180 deg", "180 deg"], home = "10 deg" }
dh = { theta = "q4", d = "420 mm", a = 0, alpha = "90 deg" }

[[frame]]
name = "A5"
variable = { name = "q5", kind = "revolute", limits = ["-115 deg", "115 deg"], home = "50 deg" }
dh = { theta = "q5", d = 0, a = 0, alpha = "-90 deg" }

[[frame]]
name = "A6"
variable = { name = "q6", kind = "revolute", limits = ["-180 deg", "180 deg"], home = "10 deg" }
dh = { theta = "q6", d = "80 mm", a = 0, alpha = 0 }
"#;

pub(super) const ZERO_OF_Q5: &str =
    "\n[[source]]\nname = \"truth\"\nclass = \"repeatable\"\njoint = \"q5\"\nerror = \"1 mrad\"\n";

/// Returns the arm with a target beside the axis of q6 by `tool` mm.
pub(super) fn arm(tool: f64, sources: &str) -> Machine {
    let text = format!("{}{sources}", ARM.replace("TOOL", &tool.to_string()));
    Machine::of_spec(Spec::parse("arm.toml", &text).expect("a spec"), "arm.toml")
}

fn identified(tool: f64, seed: u64) -> Report {
    identified_from(arm(tool, ZERO_OF_Q5), arm(tool, ""), "", 0.01, seed)
}

/// Returns the map of a point measured with 0.02 mm; `data` are more keys of `[data]`.
pub(super) fn point_map(machine: &Machine, data: &str) -> Map {
    let joints: String =
        (1..=6).map(|i| format!("q{i} = {{ column = \"j{i}\", unit = \"rad\" }}\n")).collect();
    let text = format!(
        "[data]\nuncertainty = \"0.02 mm\"\n{data}\n[joints]\n{joints}\n\
         [point]\ncolumns = [\"x\", \"y\", \"z\"]\nunit = \"mm\"\n"
    );
    Map::parse("map.toml", &text, &machine.spec).expect("a map")
}

/// Identifies the errors of a machine from 60 simulated points, with the nominal machine and priors
/// of this share.
pub(super) fn identified_from(
    machine: Machine,
    nominal: Machine,
    data: &str,
    share: f64,
    seed: u64,
) -> Report {
    let (map, at) = (point_map(&nominal, data), Places::Samples(60));
    let job = Simulate { machine, map: map.clone(), at, noise: None, outliers: 0.0, random: false, seed };
    let observations = job.run(&mut ()).expect("it is simulated").observations;
    let data = Data { file: "data.csv".to_owned(), observations, ..Data::default() };
    let settings = Settings {
        loss: abbe::identify::Loss::Squares,
        prior: Prior::Share(share),
        folds: 5,
        time: None,
        points: false,
        only_placement: false,
    };
    let (terms, harmonics) = (Vec::new(), Vec::new());
    let job = Identify {
        machine: nominal,
        map,
        data,
        test: None,
        terms,
        harmonics,
        settings,
        accept: Acceptance::default(),
    };
    job.run(&mut ()).expect("it is identified")
}

/// Returns whether the true error is named, alone or as an alternative, with its value.
fn names_the_truth(meaning: &JointError) -> bool {
    let is_true = |number: &str, value: f64| number == "zero of q5" && (value - 1e-3).abs() < 2e-4;
    is_true(&meaning.number, meaning.value)
        || meaning.alternatives.iter().any(|one| is_true(&one.number, one.value))
}

/// A target on the axis of q6 sees the zero of q5 as a displacement of the wrist. Every sentence
/// and the written spec must name both.
#[test]
fn errors_that_a_target_on_an_axis_cannot_tell_apart_are_named_together() {
    let seeds = sample_size(30);
    for seed in 0..seeds as u64 {
        let report = identified(0.0, seed);
        let meaning = report.joint_errors.iter().find(|one| names_the_truth(one));
        let meaning = meaning.unwrap_or_else(|| panic!("{seed}: {:?}", report.joint_errors));
        assert!(!meaning.alternatives.is_empty(), "{meaning:?}");
        for expected in ["zero of q5", "a of A5"] {
            let mut names = meaning.alternatives.iter().map(|one| &one.number).chain([&meaning.number]);
            assert!(names.any(|name| name == expected), "{expected}: {meaning:?}");
        }
        assert_eq!(report.target_on_axis.as_deref(), Some("q6"));
        let text = ARM.replace("TOOL", "0");
        let nominal = arm(0.0, "");
        let written = report.found.identified_spec(&nominal.spec, &text, "found.toml").expect("a spec").text;
        let line = written.lines().find(|line| line.contains("Explains the data as well: "));
        let line = line.unwrap_or_else(|| panic!("{written}"));
        assert!(line.contains("zero of q5") || line.contains("a of A5"), "{line}");
    }
}

/// A target beside the axis tells them apart: the true error is named, and `a of A5` is not.
#[test]
fn a_target_beside_the_axis_names_the_error_alone() {
    for seed in 0..sample_size(10) as u64 {
        let report = identified(100.0, seed);
        let meaning = report.joint_errors.iter().find(|one| names_the_truth(one));
        let meaning = meaning.unwrap_or_else(|| panic!("{seed}: {:?}", report.joint_errors));
        assert_eq!(meaning.number, "zero of q5", "{meaning:?}");
        assert!(meaning.alternatives.iter().all(|one| one.number != "a of A5"), "{meaning:?}");
    }
}
