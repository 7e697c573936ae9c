//! Two ballbars on a milling machine.

use abbe_metrology::Acceptance;
use abbe_metrology::data::{Data, Map};
use abbe_metrology::identify::{Identify, Settings};
use abbe_metrology::plan::{Choice, Plan};
use abbe_metrology::simulate::{Places, Simulate};
use abbe_study::{Machine, Study};

/// Two balls on the table of a milling machine, left and right of the middle of x.
const BARS: &str = r#"
[data]
setup = "setup"
[joints]
x = { column = "x", unit = "mm" }
y = { column = "y", unit = "mm" }
z = { column = "z", unit = "mm" }
[[instrument]]
name = "left"
kind = "distance"
setup = 1
column = "length"
unit = "mm"
at = ["-100 mm", "3 mm", "250 mm"]
range = ["149 mm", "151 mm"]
uncertainty = "1 um"
[[instrument]]
name = "right"
kind = "distance"
setup = 2
column = "length"
unit = "mm"
at = ["100 mm", "0 mm", "250 mm"]
range = ["149 mm", "151 mm"]
uncertainty = "1 um"
"#;

fn mill() -> Machine {
    Machine::find("machine3").unwrap()
}

/// Halton candidates place the first joint left and right alternately; setups must not alternate in
/// the same rhythm.
#[test]
fn every_setup_covers_the_workspace() {
    let (machine, map) = (mill(), Map::parse("bars.toml", BARS, &mill().spec).unwrap());
    let study = Study::find(None, &machine).unwrap();
    let criterion = abbe::identify::Criterion::Variance;
    let choice = Choice::Optimal { criterion, count: 40, candidates: 200 };
    let report = Plan { machine, map, choice, study, model_error: 0.0, seed: None }.run(&mut ()).unwrap();
    for (setup, center) in [(1, 200.0), (2, 400.0)] {
        let in_setup = |row: &&abbe::identify::Observation| {
            let abbe::identify::Measurement::Readings(read) = &row.measured else { return false };
            read[setup - 1].is_some()
        };
        let x: Vec<f64> = report.observations.iter().filter(in_setup).map(|row| row.q[0] - center).collect();
        let share = x.iter().filter(|x| **x > 0.0).count() as f64 / x.len() as f64;
        assert!((0.2..0.8).contains(&share), "setup {setup}: {share}");
    }
    // Three squareness errors are all constant errors of such a machine.
    assert_eq!((report.rank, report.machine.rank), (9, 3));
}

/// A ballbar whose rows lie on a line through its ball determines only one coordinate of its place.
/// The others stay as stated and are listed as poorly determined, instead of having a standard
/// deviation of kilometres.
#[test]
fn places_that_rows_on_a_line_cannot_determine_stay_as_stated() {
    let first = &BARS[..BARS.rfind("[[instrument]]").unwrap()];
    let map = Map::parse("bar.toml", first, &mill().spec).unwrap();
    let simulate = |at| Simulate {
        machine: mill(),
        map: map.clone(),
        at,
        noise: None,
        outliers: 0.0,
        random: false,
        seed: 3,
    };
    let observations = simulate(Places::Samples(30)).run(&mut ()).unwrap().observations;
    let of = |observations| Data {
        file: "simulated".to_owned(),
        observations,
        stations: vec![String::new()],
        ..Data::default()
    };
    let mut data = of(observations);
    for (i, row) in data.observations.iter_mut().enumerate() {
        // The tool tip is at (x − 300, y − 200, z + 150), the ball at (−100, 3, 250); y is 0.1 µm
        // off.
        let beside = 1e-4 * (i as f64).sin();
        row.q = vec![250.0 + 5.0 * i as f64, 203.0 + beside, 100.0 - beside].into();
    }
    let data = of(simulate(Places::Rows(data)).run(&mut ()).unwrap().observations);
    let settings = Settings::default();
    let job = Identify {
        machine: mill(),
        map: map.clone(),
        data,
        test: None,
        terms: Vec::new(),
        harmonics: Vec::new(),
        settings,
        accept: Acceptance::default(),
    };
    let report = job.run(&mut ()).unwrap_or_else(|mistake| panic!("{mistake}"));
    let far = report.parameters.iter().filter(|one| one.unit == "mm" && one.standard_deviation > 50.0);
    assert_eq!(far.count(), 0, "{:?}", report.parameters);
    // The map says that nobody measured them.
    let variance = |i: usize| report.placed.instruments[0].covariance[i][i];
    assert!(variance(0).sqrt() < 1.0 && variance(1).min(variance(2)).sqrt() > 50.0, "{:?}", report.placed);
    let named = |name: &str| report.weakly_determined.iter().any(|one| one.name == name);
    // Both move beside the line in the same proportion, so they are one combination.
    assert!(named("left_y") || named("left_z"), "{:?} {:?}", report.weakly_determined, report.redundant);
}
