//! Round trip of backlash: inputs that `identify` derives from the row order or from poses are
//! found again by `measure`.

use abbe::identify::Loss;
use abbe_metrology::Acceptance;
use abbe_metrology::data::{Data, Map};
use abbe_metrology::identify::{Family, Identify, Prior, Report, Settings};
use abbe_metrology::measure::Measure;
use abbe_metrology::simulate::{Places, Simulate};
use abbe_study::Machine;

use super::simulated_ur5::{joints, machine, ur5};

/// Backlash of the shoulder by direction of approach, and of the elbow by direction of the gravity
/// moment.
const PLAY: &str = r#"
[inputs.shoulder_from]
value = 0
range = [-1, 1]

[inputs.elbow_pull]
value = 0
range = [-1, 1]

[[source]]
name = "play of the shoulder"
class = "repeatable"
joint = "q2"
error = "0.4 mrad * shoulder_from"

[[source]]
name = "play of the elbow"
class = "repeatable"
joint = "q3"
error = "0.5 mrad * elbow_pull"
"#;

const FOLLOWS: &str =
    "[inputs]\nshoulder_from = { approach = \"q2\" }\nelbow_pull = { gravity_moment = \"q3\" }\n";

fn map(machine: &Machine, more: &str) -> Map {
    let joints = joints();
    let point = "[point]\ncolumns = [\"x\", \"y\", \"z\"]\nunit = \"mm\"\n[placement]\ntargets = [[\"90 mm\", \"-35 mm\", \"60 mm\"]]\n";
    let text = format!("[data]\nuncertainty = \"0.02 mm\"\n\n[joints]\n{joints}\n{more}{point}");
    Map::parse("map.toml", &text, &machine.spec).unwrap()
}

/// Simulates measurements of the machine with backlash; the data do not contain the side of the
/// contact.
fn measured(samples: usize, seed: u64) -> Data {
    let real = machine("real.toml", &format!("{}{PLAY}", ur5().text().unwrap()));
    let map = map(&real, FOLLOWS);
    let at = Places::Samples(samples);
    let job = Simulate { machine: real, map, at, noise: None, outliers: 0.0, random: false, seed };
    let mut observations = job.run(&mut ()).unwrap().observations;
    let sides = |input: usize| observations.iter().map(|row| row.u[input]).collect::<Vec<f64>>();
    for side in [sides(0), sides(1)] {
        assert!(side.contains(&1.0) && side.contains(&-1.0) && side.iter().all(|side| side.abs() <= 1.0));
    }
    observations.iter_mut().for_each(|row| row.u = Vec::new().into());
    Data { file: "simulated".to_owned(), observations, stations: vec![String::new()], ..Data::default() }
}

fn identified(map: &Map, test: &Data) -> Report {
    let settings = Settings {
        loss: Loss::Squares,
        prior: Prior::default(),
        folds: 5,
        time: None,
        points: false,
        only_placement: false,
    };
    let job = Identify {
        machine: ur5(),
        map: map.clone(),
        data: measured(150, 1),
        test: Some(test.clone()),
        terms: vec![Family::Backlash],
        harmonics: Vec::new(),
        settings,
        accept: Acceptance::default(),
    };
    job.run(&mut ()).unwrap()
}

#[test]
fn backlash_survives_a_round_trip() {
    let (nominal, test) = (ur5(), measured(60, 2));
    let guess = map(&nominal, "");
    let report = identified(&guess, &test);
    let names: Vec<&str> = report.terms.iter().map(|term| &term.name[..]).collect();
    assert!(names.iter().any(|name| name.contains("q2_direction")), "{names:?}");
    assert!(names.iter().any(|name| name.contains("q3_pull")), "{names:?}");
    let after = report.test.as_ref().unwrap().after;
    assert!(after.mean < 0.05, "{after:?}");

    let spec = report.found.identified_spec(&nominal.spec, &nominal.text().unwrap(), "found.toml").unwrap();
    let found = machine("found.toml", &spec.text);
    let text = report.found.identified_map(&guess, &nominal.spec, "found.map.toml").unwrap();
    assert!(text.contains("approach = \"q2\"") && text.contains("gravity_moment = \"q3\""), "{text}");
    let left = |text: &str| {
        let map = Map::parse("found.map.toml", text, &found.spec).unwrap();
        let mut data = test.clone();
        data.observations.iter_mut().for_each(|row| row.u = vec![0.0; found.spec.inputs.len()].into());
        let job = Measure { machine: found.clone(), map, data, accept: Acceptance::default() };
        job.run(&mut ()).unwrap().explained.left_mean
    };
    let again = left(&text);
    assert!((again - after.mean).abs() < 0.01 * after.mean, "{again} {after:?}");
    // Without the derived inputs the machine fits badly.
    let silent = text.replace("approach = ", "value = 0 # ").replace("gravity_moment = ", "value = 0 # ");
    let silent = silent.replace("frame = \"", "# frame = \"");
    assert!(left(&silent) > 2.0 * after.mean, "{} {after:?}", left(&silent));
}

/// Inputs in an inline table of the map are kept.
#[test]
fn inline_inputs_are_kept() {
    let text = PLAY.replace("[[source]]", "[[source]]\nenabled = false");
    let nominal = machine("nominal.toml", &format!("{}{text}", ur5().text().unwrap()));
    let table = map(&nominal, FOLLOWS);
    let entries: Vec<&str> = FOLLOWS.trim_end().lines().skip(1).collect();
    let joints = table.text().find("[joints]").unwrap();
    let (head, rest) = table.text().split_at(joints);
    let line = format!("{}inputs = {{ {} }}\n{}", "", entries.join(", "), "");
    let text = format!("{line}{head}{}", rest.replace(FOLLOWS, ""));
    let map = Map::parse("map.toml", &text, &nominal.spec).unwrap();
    let settings = Settings {
        loss: Loss::Squares,
        prior: Prior::default(),
        folds: 5,
        time: None,
        points: false,
        only_placement: false,
    };
    let mut data = measured(150, 1);
    data.observations.iter_mut().for_each(|row| row.u = vec![0.0; 2].into());
    let job = Identify {
        machine: nominal.clone(),
        map: map.clone(),
        data,
        test: None,
        terms: vec![Family::Backlash, Family::Load],
        harmonics: Vec::new(),
        settings,
        accept: Acceptance::default(),
    };
    let report = job.run(&mut ()).unwrap();
    // The spec has inputs for both effects, so that no derived input replaces them.
    let names: Vec<&str> = report.terms.iter().map(|term| &term.name[..]).collect();
    assert!(names.contains(&"q2: joint error with shoulder_from"), "{names:?}");
    assert!(!names.iter().any(|name| name.contains("q2_direction")), "{names:?}");
    report.found.identified_map(&map, &nominal.spec, "found.map.toml").unwrap();
}
