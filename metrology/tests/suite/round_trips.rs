//! Round trip of `identify`: the identified spec and map reproduce its figures in `measure`.

use abbe::identify::{Loss, Measurement};
use abbe_metrology::Acceptance;
use abbe_metrology::compensate::Compensate;
use abbe_metrology::data::{Data, Map};
use abbe_metrology::identify::{Identify, Prior, Report, Settings};
use abbe_metrology::measure::Measure;
use abbe_metrology::plan::{Choice, Plan, Sets};
use abbe_metrology::simulate::{Places, Simulate};
use abbe_spec::Spec;
use abbe_study::{Machine, Study};

use super::simulated_ur5::ERRORS;

/// A further error of the simulated UR5.
const WRIST: &str = r#"
[[source.effect]]
frame = "wrist 1"
e_z = "0.3 mm"
e_s = "0.7 mrad"
"#;

/// Station of the machine, 1.5 m away and rotated by 150 degrees.
pub(super) const STATION: &str = "[[station]]\nposition = [\"1200 mm\", \"-900 mm\", \"40 mm\"]\nquaternion = [0.2588190451, 0, 0, 0.9659258263]\n";

pub(super) fn ur5() -> Machine {
    Machine::find("ur5").unwrap()
}

pub(super) fn machine(name: &str, text: &str) -> Machine {
    Machine::of_spec(Spec::parse(name, text).unwrap(), name)
}

pub(super) fn real() -> Machine {
    machine("real.toml", &format!("{}{ERRORS}{WRIST}", ur5().text().unwrap()))
}

/// Measuring method: layout of the file with nominal targets, and the actual placement.
pub(super) struct Method {
    pub(super) layout: String,
    pub(super) mounted: String,
}

/// Returns a method with one target beside the last axis.
pub(super) fn one() -> Method {
    Method {
        layout: "[point]\ncolumns = [\"x\", \"y\", \"z\"]\nunit = \"mm\"\n".to_owned(),
        mounted: "[placement]\ntargets = [[\"90 mm\", \"-35 mm\", \"60 mm\"]]\n".to_owned(),
    }
}

/// Returns a method with three targets, each nominal position `off` mm away from the actual one in
/// every coordinate.
fn three(off: f64) -> Method {
    let places = [[60.0, 10.0, 40.0], [-50.0, 20.0, 60.0], [0.0, -70.0, 30.0]];
    let place = |at: [f64; 3]| {
        let [x, y, z] = at.map(|v| format!("\"{v} mm\""));
        format!("[{x}, {y}, {z}]")
    };
    let target = |(i, at): (usize, [f64; 3])| {
        let designed = place(at.map(|v| v + off));
        format!(
            "[[target]]\ncolumns = [\"x{i}\", \"y{i}\", \"z{i}\"]\nunit = \"mm\"\nposition = {designed}\n"
        )
    };
    Method {
        layout: places.into_iter().enumerate().map(target).collect(),
        mounted: format!("[placement]\ntargets = [{}]\n", places.map(place).join(", ")),
    }
}

pub(super) fn pose() -> Method {
    Method {
        layout: "[pose]\nposition = [\"x\", \"y\", \"z\"]\nunit = \"mm\"\n\
                 quaternion = { columns = [\"a\", \"b\", \"c\", \"d\"], order = \"wxyz\" }\n"
            .to_owned(),
        mounted: "[placement]\nposition = [\"3 mm\", \"-2 mm\", \"5 mm\"]\nquaternion = [0.99995, 0.005, -0.007, 0.005]\n"
            .to_owned(),
    }
}

impl Method {
    /// Returns a map; `data` are additional lines under `[data]`, `more` additional tables.
    pub(super) fn map(&self, data: &str, more: &str) -> Map {
        let joints: String =
            (1..=6).map(|i| format!("q{i} = {{ column = \"j{i}\", unit = \"deg\" }}\n")).collect();
        let head = format!(
            "[data]\nuncertainty = \"0.02 mm\"\nangle_uncertainty = \"0.05 mrad\"\n{data}\n[joints]\n"
        );
        let text = format!("{head}{joints}\n{}\n{more}", self.layout);
        Map::parse("map.toml", &text, &ur5().spec).unwrap()
    }

    /// Returns the map with the actual placement, for the simulation.
    pub(super) fn truth(&self, stands: &str) -> Map {
        self.map("", &format!("{stands}{}", self.mounted))
    }
}

pub(super) fn measured(map: &Map, samples: usize, seed: u64) -> Data {
    let job = Simulate {
        machine: real(),
        map: map.clone(),
        at: Places::Samples(samples),
        noise: None,
        outliers: 0.0,
        random: false,
        seed,
    };
    let report = job.run(&mut ()).unwrap();
    Data {
        file: "simulated".to_owned(),
        observations: report.observations,
        stations: map.station_names(),
        ..Data::default()
    }
}

pub(super) fn identify(map: &Map, data: Data, test: Option<Data>) -> Report {
    job(map, data, test).run(&mut ()).unwrap()
}

pub(super) fn job(map: &Map, data: Data, test: Option<Data>) -> Identify {
    let settings = Settings {
        loss: Loss::Squares,
        prior: Prior::default(),
        folds: 10,
        time: None,
        points: false,
        only_placement: false,
    };
    Identify {
        machine: ur5(),
        map: map.clone(),
        data,
        test,
        terms: Vec::new(),
        harmonics: Vec::new(),
        settings,
        accept: Acceptance::default(),
    }
}

/// Returns the machine and the map written by an identification.
pub(super) fn identified_machine_and_map(report: &Report, map: &Map) -> (Machine, Map) {
    let nominal = ur5();
    let spec = report.found.identified_spec(&nominal.spec, &nominal.text().unwrap(), "found.toml").unwrap();
    let found = machine("found.toml", &spec.text);
    let text = report.found.identified_map(map, &nominal.spec, "found.map.toml").unwrap();
    let map = Map::parse("found.map.toml", &text, &found.spec).unwrap();
    (found, map)
}

/// Returns mean and maximum of the residuals that `measure` reports.
pub(super) fn left(machine: Machine, map: Map, data: Data) -> [f64; 2] {
    let report = Measure { machine, map, data, accept: Acceptance::default() }.run(&mut ()).unwrap();
    [report.explained.left_mean, report.explained.left_max]
}

pub(super) fn assert_close(a: [f64; 2], b: [f64; 2], share: f64) {
    for (a, b) in a.into_iter().zip(b) {
        assert!((a - b).abs() <= share * b, "{a} {b}");
    }
}

/// `measure` with the identified spec and map reproduces the accuracy that `identify` states for
/// test rows, and the machine is equally accurate at a new station.
fn check_round_trip(way: &Method, known: bool) {
    let (stands, base) = if known { ("", "") } else { (STATION, "base = \"unknown\"\n") };
    let (truth, guess) = (way.truth(stands), way.map(base, ""));
    let unseen = measured(&truth, 100, 2);
    let report = identify(&guess, measured(&truth, 150, 1), Some(unseen.clone()));
    let test = report.test.unwrap();
    assert!(test.after.mean < 0.05 && test.before.mean > 0.3, "{test:?}");
    let figure = [test.after.mean, test.after.max];
    let (found, map) = identified_machine_and_map(&report, &guess);
    assert_close(left(found.clone(), map.clone(), unseen), figure, 0.01);

    let elsewhere =
        STATION.replace("1200 mm", "-2500 mm").replace("0.2588190451, 0, 0,", "0, 0, 0.2588190451,");
    let moved = measured(&way.truth(&elsewhere), 100, 2);
    let [mean, _] = left(found, map.newly_stationed(), moved);
    assert!((mean - figure[0]).abs() <= 0.1 * figure[0], "{mean} {figure:?}");
}

#[test]
fn one_target() {
    check_round_trip(&one(), true);
    check_round_trip(&one(), false);
}

#[test]
fn three_targets() {
    check_round_trip(&three(0.4), true);
    check_round_trip(&three(0.4), false);
}

#[test]
fn poses() {
    check_round_trip(&pose(), true);
    check_round_trip(&pose(), false);
}

/// Errors of the placement are not compensated: with targets guessed 200 mm off, commands change by
/// no more than the machine's own errors.
#[test]
fn placement_is_not_compensated() {
    let way = three(200.0);
    let guess = way.map("", "");
    let report = identify(&guess, measured(&way.truth(""), 150, 1), None);
    let (found, _) = identified_machine_and_map(&report, &guess);
    let commands = measured(&guess, 40, 3);
    let compensated = |machine: Machine| {
        let (map, data) = (guess.clone(), commands.clone());
        Compensate { machine, map, data, poses: false, tolerance: 1e-3, weight: None }
            .run(&mut ())
            .unwrap()
            .before
    };
    let (own, found) = (compensated(real()), compensated(found));
    assert!(own.max > 1.0, "{own:?}");
    assert!(found.max <= 1.1 * own.max && found.angle_max <= 1.1 * own.angle_max, "{found:?} {own:?}");
}

/// Two stations in one fit: the pose of each is registered from its own rows, and both determine
/// the errors of one machine.
#[test]
fn two_stations() {
    let way = one();
    let second = STATION.replace("1200 mm", "-700 mm").replace("0.9659258263", "-0.9659258263");
    let named = |station: &str, name: &str| station.replace("]]\n", &format!("]]\nname = {name:?}\n"));
    let stands = format!("{}{}", named(STATION, "door"), named(&second, "wall"));
    let column = "station = \"setup\"\n";
    let truth = way.map(column, &format!("{stands}{}", way.mounted));
    let guess = way.map(&format!("{column}base = \"unknown\"\n"), "");
    let unseen = measured(&truth, 100, 2);
    let report = identify(&guess, measured(&truth, 160, 1), Some(unseen.clone()));
    let test = report.test.unwrap();
    assert!(test.after.mean < 0.05, "{test:?}");
    let names: Vec<&str> = report.placed.stations.iter().map(|station| &station.name[..]).collect();
    assert_eq!(names, ["door", "wall"]);
    assert!(report.parameters.iter().any(|parameter| parameter.name == "e_x0 wall"));
    let (found, map) = identified_machine_and_map(&report, &guess);
    assert_close(left(found, map, unseen.clone()), [test.after.mean, test.after.max], 0.01);

    // Rows of an unknown station are refused.
    let elsewhere = Data { stations: vec!["roof".to_owned(), "wall".to_owned()], ..unseen };
    let refused = job(&guess, measured(&truth, 60, 1), Some(elsewhere.clone())).run(&mut ()).unwrap_err();
    assert!(refused.to_string().contains("there is no station `roof` in the fitted data"), "{refused}");
    let job = Measure { machine: ur5(), map: truth, data: elsewhere, accept: Acceptance::default() };
    let refused = job.run(&mut ()).unwrap_err().to_string();
    for said in ["station `roof`", "the map does not give the pose", "`door`, `wall`", "--station new"] {
        assert!(refused.contains(said), "{said}: {refused}");
    }
}

/// Rows to simulate may name stations; without stations in the map, each is at `F_0`.
#[test]
fn stations_of_rows_are_simulated() {
    let way = one();
    let column = "station = \"setup\"\n";
    let stated = STATION.replace("]]\n", "]]\nname = \"door\"\n");
    let rows = measured(&way.map(column, &format!("{stated}{}", way.mounted)), 8, 5);
    let mut at = Data { stations: vec!["door".to_owned(), "wall".to_owned()], ..rows };
    at.observations.iter_mut().enumerate().for_each(|(i, row)| row.station = i as u32 % 2);
    let simulated = |map: Map| {
        let at = Places::Rows(at.clone());
        Simulate { machine: real(), map, at, noise: Some(0.0), outliers: 0.0, random: false, seed: 1 }
            .run(&mut ())
    };
    let report = simulated(way.map(column, &way.mounted)).unwrap();
    let stations: Vec<u32> = report.observations.iter().map(|row| row.station).collect();
    assert_eq!(stations, [0, 1, 0, 1, 0, 1, 0, 1]);
    let refused = simulated(way.map(column, &format!("{stated}{}", way.mounted))).unwrap_err().to_string();
    for said in ["station `wall`", "the map does not give the pose", "add a [[station]]"] {
        assert!(refused.contains(said), "{said}: {refused}");
    }
}

/// Returns the rank that a plan predicts for a number of samples.
fn planned(map: &Map, samples: usize) -> usize {
    let machine = ur5();
    let text = format!(
        "[plan]\ntitle = \"samples\"\n\n[[set]]\nname = \"samples\"\nworkspace.joints = {{ samples = {samples} }}\n"
    );
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("plan.toml");
    std::fs::write(&file, text).unwrap();
    let choice = Choice::Sets(Sets::find(&file, &machine.spec).unwrap());
    let study = Study::find(None, &machine).unwrap();
    Plan { machine, map: map.clone(), choice, study, model_error: 0.0, seed: None }.run(&mut ()).unwrap().rank
}

/// Weakly determined errors are held and listed, but not written: a reflector at the flange, 0.3 mm
/// off the last axis, determines some errors weakly.
#[test]
fn a_reflector_on_the_last_axis() {
    let way = Method {
        layout: one().layout,
        mounted: "[placement]\ntargets = [[\"0.2 mm\", \"-0.2 mm\", \"0.1 mm\"]]\n".to_owned(),
    };
    let guess = way.map("", "");
    let report = identify(&guess, measured(&way.truth(""), 60, 1), None);
    assert!(report.condition < 1000.0, "{}", report.condition);
    assert!(!report.weakly_determined.is_empty());
    for weak in &report.weakly_determined {
        assert!(weak.standard_deviation > 0.5 * weak.expected, "{weak:?}");
    }
    for parameter in report.parameters.iter().filter(|parameter| parameter.unit == "rad") {
        assert!(parameter.standard_deviation < 0.5 * 0.01, "{parameter:?}");
    }
    // A plan predicts the same rank for the same rows.
    assert_eq!(report.rank, planned(&guess, 60));
    // The identified machine rotates the tool no farther than the real errors do.
    let (found, _) = identified_machine_and_map(&report, &guess);
    let commands = measured(&guess, 40, 3);
    let compensated = |machine: Machine| {
        let (map, data) = (guess.clone(), commands.clone());
        Compensate { machine, map, data, poses: false, tolerance: 1e-3, weight: None }
            .run(&mut ())
            .unwrap()
            .before
    };
    let (own, found) = (compensated(real()), compensated(found));
    assert!(found.angle_max <= 1.2 * own.angle_max, "{found:?} {own:?}");
}

/// An initial placement that is a metre and half a turn off is corrected, even if the map says
/// otherwise.
#[test]
fn a_far_initial_placement_is_corrected() {
    let far = Method {
        mounted: "[placement]\ntargets = [[\"600 mm\", \"-500 mm\", \"700 mm\"]]\n".to_owned(),
        ..one()
    };
    let turned = Method {
        mounted: "[placement]\nposition = [\"300 mm\", \"-200 mm\", \"800 mm\"]\nquaternion = [0.02, 0.9998, 0, 0]\n"
            .to_owned(),
        ..pose()
    };
    for way in [far, turned] {
        // The base counts as known by default, which is wrong here.
        let report = identify(&way.map("", ""), measured(&way.truth(STATION), 150, 1), None);
        assert!(report.fit.after.mean < 0.05, "{:?}", report.fit);
    }
}

/// A simulated machine has one value of each tolerance, and a random error anew in each row:
/// residuals along x are all equal, within ±0.1 mm, and those along y are not.
#[test]
fn a_simulated_machine_has_one_value_of_a_tolerance() {
    let source = |name: &str, class: &str, error: &str| {
        format!(
            "[[source]]\nname = \"{name}\"\nclass = \"{class}\"\ndistribution = \"uniform\"\nframe = \"slide\"\n{error} = \"0.1 mm\"\n"
        )
    };
    let text = format!(
        "[manipulator]\nname = \"slide\"\nlength = \"mm\"\n[[frame]]\nname = \"slide\"\n\
         variable = {{ name = \"d1\", kind = \"prismatic\", limits = [\"0 mm\", \"100 mm\"] }}\n\
         transform = \"Tx(d1)\"\n{}{}",
        source("offset", "tolerance", "e_x"),
        source("play", "random", "e_y")
    );
    let machine = machine("slide.toml", &text);
    let map = "[data]\nuncertainty = \"1 um\"\n[joints]\nd1 = { column = \"d1\", unit = \"mm\" }\n\
               [point]\ncolumns = [\"x\", \"y\", \"z\"]\nunit = \"mm\"\n";
    let mut offsets = Vec::new();
    for seed in 0..8 {
        let map = Map::parse("map.toml", map, &machine.spec).unwrap();
        let (at, noise) = (Places::Samples(20), Some(1e-9));
        let job = Simulate { machine: machine.clone(), map, at, noise, outliers: 0.0, random: true, seed };
        let rows = job.run(&mut ()).unwrap().observations;
        let errors: Vec<[f64; 2]> = rows
            .iter()
            .map(|row| match &row.measured {
                Measurement::Points(points) => {
                    let [x, y, _] = points[0].unwrap();
                    [x - row.q[0], y]
                }
                _ => panic!("points were asked for"),
            })
            .collect();
        let [offset, play] = errors[0];
        assert!(errors.iter().all(|[x, _]| (x - offset).abs() < 1e-6), "{errors:?}");
        assert!(errors.iter().any(|[_, y]| (y - play).abs() > 0.02), "{errors:?}");
        offsets.push(offset);
    }
    assert!(offsets.iter().all(|offset| offset.abs() <= 0.1 + 1e-6));
    assert!(offsets.iter().any(|offset| (offset - offsets[0]).abs() > 0.02), "{offsets:?}");
}

/// Draws of a clearance are within its ball, of which they fill all: a mean square of 3/5 r². As a
/// tolerance it has one value in all rows.
#[test]
fn simulated_clearances_fill_their_ball() {
    let simulated = |class: &str, random: bool| {
        let source = format!(
            "\n[[source]]\nname = \"clearance\"\nclass = \"{class}\"\ndistribution = \"ball\"\nframe = \"elbow\"\n\
             e_x = \"0.1 mm\"\ne_y = \"0.1 mm\"\ne_z = \"0.1 mm\"\n"
        );
        let text: String = ur5().text().unwrap().split("\n[[source]]").next().unwrap().to_owned();
        let machine = machine("real.toml", &format!("{text}{source}"));
        let map = one().truth("");
        let at = Places::Samples(1000);
        let job = Simulate { machine, map, at, noise: Some(0.0), outliers: 0.0, random, seed: 5 };
        let rows = job.run(&mut ()).unwrap().observations;
        let point = |measured: &Measurement| match measured {
            Measurement::Points(points) => points[0].unwrap(),
            _ => panic!("these are points"),
        };
        rows.iter().map(|row| point(&row.measured)).collect::<Vec<_>>()
    };
    for class in ["random", "tolerance"] {
        let (exact, drawn) = (simulated(class, false), simulated(class, true));
        let square = |(a, b): (&[f64; 3], &[f64; 3])| (0..3).map(|k| (a[k] - b[k]).powi(2)).sum::<f64>();
        let squares: Vec<f64> = exact.iter().zip(&drawn).map(square).collect();
        assert!(squares.iter().all(|square| square.sqrt() <= 0.1 + 1e-9));
        let mean = squares.iter().sum::<f64>() / squares.len() as f64;
        match class {
            "random" => assert!((mean / 0.006 - 1.0).abs() < 0.05, "{mean}"),
            _ => assert!(squares.iter().all(|square| (square - mean).abs() < 1e-9 && *square > 0.0)),
        }
    }
}
