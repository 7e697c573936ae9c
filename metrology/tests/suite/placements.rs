//! Placements on the tool: another at each station, and targets at unknown places.

use abbe_metrology::data::{Data, Map};
use abbe_metrology::identify::Report;
use abbe_metrology::simulate::{Places, Simulate};

use super::round_trips::{
    Method, STATION, assert_close, identified_machine_and_map, identify, job, left, measured, one, pose, real,
};
use crate::thorough::sample_size;

/// Stations with their names.
fn stations() -> String {
    let second = STATION.replace("1200 mm", "-700 mm").replace("0.9659258263", "-0.9659258263");
    let named = |station: &str, name: &str| station.replace("]]\n", &format!("]]\nname = {name:?}\n"));
    format!("{}{}", named(STATION, "morning"), named(&second, "noon"))
}

/// Returns the tables of two placements.
fn placements(first: &str, second: &str) -> String {
    let table = |station: &str, keys: &str| format!("[[placement]]\nstation = {station:?}\n{keys}\n");
    format!("{}{}", table("morning", first), table("noon", second))
}

/// Positions of the reflector before and after it was moved on the flange.
const REFLECTORS: [[f64; 3]; 2] = [[90.0, -35.0, 60.0], [-40.0, 80.0, 130.0]];

fn reflectors() -> String {
    let [a, b] = REFLECTORS.map(|at| format!("targets = [{:?}]", at.map(|v| format!("{v} mm"))));
    placements(&a, &b)
}

/// Poses of the measured frame before and after the tool was changed.
fn tools() -> String {
    placements(
        "position = [\"3 mm\", \"-2 mm\", \"5 mm\"]\nquaternion = [0.99995, 0.005, -0.007, 0.005]",
        "position = [\"30 mm\", \"12 mm\", \"95 mm\"]\nquaternion = [0.8, 0.6, 0, 0]",
    )
}

const COLUMN: &str = "station = \"setup\"\nplacement = \"per station\"\n";

/// Returns the true map, and the one of somebody who knows nothing of stations and placements.
fn maps(way: &Method, placed: &str) -> [Map; 2] {
    let truth = way.map(COLUMN, &format!("{}{placed}", stations()));
    [truth, way.map(&format!("{COLUMN}base = \"unknown\"\n"), "")]
}

/// Returns found minus true position of each reflector along each axis, in standard deviations.
fn deviations(report: &Report) -> Vec<f64> {
    let stations = report.placed.at_stations.iter().zip(REFLECTORS);
    stations
        .flat_map(|(found, truth)| {
            let deviation =
                |axis: usize| (found.targets[0][axis] - truth[axis]) / found.covariance[axis][axis].sqrt();
            [0, 1, 2].map(deviation)
        })
        .collect()
}

/// A reflector that was moved on the flange between two stations is found at both of its places,
/// and rows of both stations identify one machine: it predicts unseen rows as well as the
/// instrument measures. With one placement for both stations the machine is not found.
#[test]
fn a_reflector_moved_between_stations() {
    let way = one();
    let [truth, guess] = maps(&way, &reflectors());
    let (data, unseen) = (measured(&truth, 200, 1), measured(&truth, 100, 2));
    let report = identify(&guess, data.clone(), Some(unseen.clone()));
    let test = report.test.unwrap();
    assert!(test.after.mean < 0.05, "{test:?}");
    let z = deviations(&report);
    assert!(z.len() == 6 && z.iter().all(|z| z.abs() < 4.0), "{z:?}");
    let names = ["tool_x morning", "tool_z noon"];
    assert!(names.iter().all(|name| report.parameters.iter().any(|one| one.name == *name)));
    // The found spec and map give the same figures in `measure`.
    let (found, map) = identified_machine_and_map(&report, &guess);
    assert!(map.text().contains("[[placement]]\nstation = \"noon\""), "{}", map.text());
    assert_close(left(found, map, unseen.clone()), [test.after.mean, test.after.max], 0.01);
    let common = way.map("station = \"setup\"\nbase = \"unknown\"\n", "");
    let common = identify(&common, data, Some(unseen)).test.unwrap();
    assert!(common.after.mean > 1.0, "{common:?}");
}

/// A tool that was changed between two stations is found likewise, where whole poses are measured.
#[test]
fn a_tool_changed_between_stations() {
    let way = pose();
    let [truth, guess] = maps(&way, &tools());
    let unseen = measured(&truth, 100, 2);
    let report = identify(&guess, measured(&truth, 120, 1), Some(unseen.clone()));
    let test = report.test.unwrap();
    assert!(test.after.mean < 0.05, "{test:?}");
    let (found, map) = identified_machine_and_map(&report, &guess);
    assert_close(left(found, map, unseen), [test.after.mean, test.after.max], 0.01);
}

/// `measure` finds the placement at a station that the map does not know from the rows of that
/// station, as it finds the station.
#[test]
fn a_new_station_has_a_new_placement() {
    for (way, placed) in [(one(), reflectors()), (pose(), tools())] {
        let [truth, guess] = maps(&way, &placed);
        let report = identify(&guess, measured(&truth, 200, 1), None);
        let (found, map) = identified_machine_and_map(&report, &guess);
        let data = measured(&truth, 100, 2);
        let renamed = Data { stations: vec!["evening".to_owned(), "night".to_owned()], ..data.clone() };
        let [known, new] = [(map.clone(), data), (map.newly_stationed(), renamed)]
            .map(|(map, data)| left(found.clone(), map, data));
        assert!((new[0] - known[0]).abs() <= 0.1 * known[0], "{new:?} {known:?}");
    }
}

/// One station with its own placement is a single `[[placement]]`.
#[test]
fn a_single_station_has_one_placement() {
    let [truth, guess] = maps(&one(), &reflectors());
    let mut data = measured(&truth, 200, 1);
    data.observations.retain(|row| row.station == 0);
    data.stations.truncate(1);
    let report = identify(&guess, data.clone(), None);
    let (found, map) = identified_machine_and_map(&report, &guess);
    assert!(left(found, map, data)[0] < 0.05);
}

/// Instruments name their targets, so another reflector in each setup needs no more: both of its
/// places are found, and the rows of both identify one machine.
#[test]
fn instruments_name_the_target_of_each_setup() {
    let map = |positions: [[f64; 3]; 2]| {
        let tables = positions.into_iter().zip(["first", "second"]).zip([1, 2]).map(|((at, name), setup)| {
            format!(
                "[[target]]\nname = {name:?}\nposition = {:?}\n[[instrument]]\nname = \"tracker on {name}\"\n\
                 kind = \"point\"\ncolumns = [\"x\", \"y\", \"z\"]\nunit = \"mm\"\ntarget = {name:?}\nsetup = {setup}\n",
                at.map(|v| format!("{v} mm"))
            )
        });
        let way = Method { layout: tables.collect(), mounted: String::new() };
        way.map("setup = \"setup\"\n", "")
    };
    let truth = map(REFLECTORS);
    let guess = map(REFLECTORS.map(|at| at.map(|v| v + 8.0)));
    let report = identify(&guess, measured(&truth, 200, 1), Some(measured(&truth, 100, 2)));
    let test = report.test.unwrap();
    assert!(test.after.mean < 0.05, "{test:?}");
    for (found, truth) in report.placed.targets.iter().zip(REFLECTORS) {
        assert!(found.iter().zip(truth).all(|(a, b)| (a - b).abs() < 0.1), "{found:?} {truth:?}");
    }
}

/// The stated standard deviations of the places hold over simulated data: the mean square of found
/// minus true values in standard deviations is 1 within four of its standard deviations.
#[test]
fn places_at_stations_are_within_their_standard_deviations() {
    let [truth, guess] = maps(&one(), &reflectors());
    check_deviations(&truth, &guess, deviations);
}

/// Checks the deviations of the places found from simulated data.
fn check_deviations(truth: &Map, guess: &Map, deviations: impl Fn(&Report) -> Vec<f64>) {
    let seeds = sample_size(40) as u64;
    let report = |seed: u64| job(guess, measured(truth, 120, 10 + seed), None).run(&mut ()).unwrap();
    let z: Vec<f64> = (0..seeds).flat_map(|seed| deviations(&report(seed))).collect();
    let square = z.iter().map(|z| z * z).sum::<f64>() / z.len() as f64;
    let inside = z.iter().filter(|z| z.abs() < 1.96).count() as f64 / z.len() as f64;
    println!("{seeds} machines: mean square {square:.2}, within 1.96 standard deviations {inside:.3}");
    // The coordinates of one place are correlated: a third of them count.
    let spread = 4.0 * (2.0 / (z.len() as f64 / 3.0)).sqrt();
    assert!((square - 1.0).abs() < spread, "{square} {spread}");
}

/// Returns a method with three targets of which the first `unknown` are at unknown places, and
/// their true positions, up to 300 mm from the tool point.
fn unknown_targets(unknown: usize) -> (Method, [[f64; 3]; 3]) {
    let places = [[60.0, 10.0, 40.0], [-50.0, 220.0, 160.0], [0.0, -270.0, 130.0]];
    let lengths = |at: [f64; 3]| format!("{:?}", at.map(|v| format!("{v} mm")));
    let target = |(i, at): (usize, [f64; 3])| {
        let position = if i < unknown { "\"unknown\"".to_owned() } else { lengths(at.map(|v| v + 0.4)) };
        format!(
            "[[target]]\ncolumns = [\"x{i}\", \"y{i}\", \"z{i}\"]\nunit = \"mm\"\nposition = {position}\n"
        )
    };
    let mounted = format!("[placement]\ntargets = [{}]\n", places.map(lengths).join(", "));
    (Method { layout: places.into_iter().enumerate().map(target).collect(), mounted }, places)
}

/// Returns found minus true position of each target along each axis, in standard deviations.
fn deviations_of_targets(report: &Report, truth: [[f64; 3]; 3]) -> Vec<f64> {
    let placed = &report.placed;
    let found = placed.targets.as_flattened().iter().zip(truth.as_flattened()).enumerate();
    found.map(|(i, (found, truth))| (found - truth) / placed.covariance[i][i].sqrt()).collect()
}

/// Targets at unknown places are found with the machine, with the station known or unknown; the
/// found spec and map give the same figures in `measure`, and `measure` finds the places from rows
/// if no map states them.
#[test]
fn targets_at_unknown_places() {
    for (unknown, stands, base) in [(2, "", ""), (3, "", ""), (3, STATION, "base = \"unknown\"\n")] {
        let (way, places) = unknown_targets(unknown);
        let (truth, guess) = (way.truth(stands), way.map(base, ""));
        let unseen = measured(&truth, 100, 2);
        let report = identify(&guess, measured(&truth, 120, 1), Some(unseen.clone()));
        let test = report.test.unwrap();
        assert!(test.after.mean < 0.05 && test.before.mean < 30.0, "{unknown}: {test:?}");
        let z = deviations_of_targets(&report, places);
        assert!(z.len() == 9 && z.iter().all(|z| z.abs() < 4.0), "{unknown}: {z:?}");
        let (found, map) = identified_machine_and_map(&report, &guess);
        assert_close(left(found.clone(), map, unseen.clone()), [test.after.mean, test.after.max], 0.01);
        // A stated place counts as designed: 0.7 mm off.
        let [mean, _] = if unknown == 3 { left(found, guess, unseen) } else { [test.after.mean; 2] };
        assert!((mean - test.after.mean).abs() <= 0.1 * test.after.mean, "{unknown}: {mean} {test:?}");
    }
}

/// A simulation needs the places of all targets.
#[test]
fn a_simulation_needs_the_places_of_targets() {
    let (way, _) = unknown_targets(2);
    let map = way.map("", "");
    let (machine, at) = (real(), Places::Samples(10));
    let job = Simulate { machine, map, at, noise: None, outliers: 0.0, random: false, seed: 1 };
    let mistake = job.run(&mut ()).err().unwrap().to_string();
    for said in
        ["the position of target 1 on the tool is unknown", "as its `position`", "`abbe identify --out`"]
    {
        assert!(mistake.contains(said), "{said}: {mistake}");
    }
}

/// The stated standard deviations of unknown places hold over simulated data.
#[test]
fn unknown_places_are_within_their_standard_deviations() {
    let (way, places) = unknown_targets(3);
    let (truth, guess) = (way.truth(STATION), way.map("base = \"unknown\"\n", ""));
    check_deviations(&truth, &guess, |report| deviations_of_targets(report, places));
}
