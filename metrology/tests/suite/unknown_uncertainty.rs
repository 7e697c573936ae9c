//! Instruments without a stated uncertainty: what identification estimates, and what it refuses.

use abbe_metrology::Acceptance;
use abbe_metrology::data::{Data, Map};
use abbe_metrology::identify::{Identify, Kind, Prior, Report, Settings};
use abbe_metrology::measure::Measure;
use abbe_metrology::plan::{Choice, Plan};
use abbe_metrology::simulate::{Places, Simulate};
use abbe_spec::diagnostic::Diagnostics;
use abbe_study::{Machine, Study};

use super::simulated_ur5::{ERRORS, joints, ur5, ur5_with};
use crate::thorough::sample_size;

fn real() -> Machine {
    ur5_with(ERRORS)
}

fn map(head: &str, layout: &str) -> Map {
    let text = format!("[data]\n{head}\n[joints]\n{}\n{layout}", joints());
    Map::parse("map.toml", &text, &ur5().spec).unwrap_or_else(|mistake| panic!("{mistake}"))
}

/// Returns a map with a ball that is held in sockets at four places.
fn sockets(uncertainty: &str) -> Map {
    let ball = "[[target]]\nname = \"ball\"\nposition = [\"60 mm\", \"20 mm\", \"50 mm\"]\n";
    let places = [[400, 200, 300], [-350, 250, 200], [100, -450, 400], [-200, -350, 150]];
    let socket = |(i, [x, y, z]): (usize, &[i32; 3])| {
        let n = i + 1;
        format!(
            "[[instrument]]\nname = \"socket{n}\"\nkind = \"contact\"\nsetup = {n}\nat = [\"{x} mm\", \"{y} mm\", \"{z} mm\"]\nuncertainty = {uncertainty}\n"
        )
    };
    let sockets: String = places.iter().enumerate().map(socket).collect();
    map("setup = \"setup\"\n", &format!("{ball}{sockets}"))
}

/// Returns a map of measured poses.
fn poses(length: &str, angle: &str) -> Map {
    let pose = "[pose]\nposition = [\"x\", \"y\", \"z\"]\nunit = \"mm\"\n\
                quaternion = { columns = [\"a\", \"b\", \"c\", \"d\"], order = \"wxyz\" }\n";
    map(&format!("uncertainty = {length}\nangle_uncertainty = {angle}\nbase = \"unknown\"\n"), pose)
}

fn simulated(map: &Map, samples: usize, seed: u64) -> Data {
    let at = Places::Samples(samples);
    let job =
        Simulate { machine: real(), map: map.clone(), at, noise: None, outliers: 0.0, random: false, seed };
    let report = job.run(&mut ()).unwrap_or_else(|mistake| panic!("{mistake}"));
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("data.csv");
    std::fs::write(&path, report.table.csv()).unwrap();
    Data::read(&path, map).unwrap_or_else(|mistake| panic!("{mistake}"))
}

fn job(map: &Map, data: Data) -> Identify {
    Identify {
        machine: ur5(),
        map: map.clone(),
        data,
        test: None,
        terms: Vec::new(),
        harmonics: Vec::new(),
        settings: Settings { folds: 5, ..Settings::default() },
        accept: Acceptance::default(),
    }
}

fn identify(map: &Map, data: Data) -> Result<Report, Diagnostics> {
    job(map, data).run(&mut ())
}

fn identified(map: &Map, data: Data) -> Report {
    identify(map, data).unwrap_or_else(|mistake| panic!("{mistake}"))
}

/// Changes the commands of rows by periodic errors of the joints, which constant errors cannot
/// explain.
fn with_periodic_errors(mut data: Data, size: f64) -> Data {
    for row in &mut data.observations {
        let q = row.q.to_vec();
        row.q = q.iter().map(|q| q + size * (3.0 * q).sin()).collect::<Vec<f64>>().into();
    }
    data
}

/// The size of a machine that is only held at points is free. With an unknown uncertainty, least
/// squares would fit a smaller machine with smaller residuals; lengths keep their ratio to the
/// largest one instead, and the uncertainty is that of the residuals.
#[test]
fn contacts_of_unknown_uncertainty_do_not_shrink_the_machine() {
    let data = with_periodic_errors(simulated(&sockets("\"0.05 mm\""), 240, 3), 5e-4);
    let report = identified(&sockets("\"unknown\""), data);
    let sigma: Vec<f64> = report.instruments.iter().map(|instrument| instrument.uncertainty).collect();
    assert!(sigma.iter().all(|sigma| (0.05..0.6).contains(sigma)), "{sigma:?}");
    let lengths = report.parameters.iter().filter(|one| one.kind == Kind::Machine && one.unit == "mm");
    let far: Vec<_> = lengths.filter(|one| one.value.abs() > 5.0).map(|one| (&one.name, one.value)).collect();
    assert!(far.is_empty(), "{far:?}");
    let note = report.notes.iter().find(|note| note.contains("do not determine the scale")).unwrap();
    assert!(note.contains("so the nominal one counts"), "{note}");
}

/// Too few values for an estimate are refused with their number; what is estimated has degrees of
/// freedom.
#[test]
fn an_uncertainty_needs_degrees_of_freedom() {
    let wire = |uncertainty: &str| {
        let wire = format!(
            "[[instrument]]\nname = \"wire\"\nkind = \"distance\"\ncolumn = \"length\"\nunit = \"mm\"\nat = [\"400 mm\", \"200 mm\", \"300 mm\"]\nzero = \"unknown\"\nuncertainty = {uncertainty}\n"
        );
        map("", &wire)
    };
    let of_rows = |rows: usize| identify(&wire("\"unknown\""), simulated(&wire("\"0.01 mm\""), rows, 3));
    let refused = of_rows(26).unwrap_err().to_string();
    let reason = "the uncertainty of `wire` cannot be estimated: 26 values leave 3.1 degrees of freedom";
    assert!(refused.contains(reason) && refused.contains("measure at more configurations"), "{refused}");
    let freedom = of_rows(29).unwrap_or_else(|mistake| panic!("{mistake}")).instruments[0].freedom;
    assert!((freedom - 6.0).abs() < 0.1, "{freedom}");
}

/// A target whose position on the tool the rows hardly determine is named with its standard
/// deviation; with the wrist moving over its range there is no such note.
#[test]
fn a_vague_position_on_the_tool_is_named() {
    let map = map(
        "uncertainty = \"0.05 mm\"\nbase = \"unknown\"\n",
        "[point]\ncolumns = [\"x\", \"y\", \"z\"]\nunit = \"mm\"\n",
    );
    let with_wrist = |share: f64| {
        let mut data = simulated(&map, 80, 7);
        data.observations.iter_mut().for_each(|row| row.q[3..].iter_mut().for_each(|q| *q *= share));
        let (machine, map, at) = (real(), map.clone(), Places::Rows(data));
        let job = Simulate { machine, map, at, noise: None, outliers: 0.0, random: false, seed: 5 };
        let observations = job.run(&mut ()).unwrap().observations;
        Data { file: "simulated".to_owned(), observations, stations: vec![String::new()], ..Data::default() }
    };
    let vague = |share: f64| {
        let mut job = job(&map, with_wrist(share));
        job.settings.prior = Prior::Share(0.01);
        let report = job.run(&mut ()).unwrap();
        report.notes.iter().any(|note| note.contains("on the tool is determined poorly"))
    };
    assert!(!vague(1.0));
    assert!(vague(0.002));
}

/// Positions and rotations have variance components of their own: both are estimated to a tenth,
/// for ratios far from that of the initial values. The estimates stand in the identified map.
#[test]
fn positions_and_rotations_have_their_own_uncertainty() {
    for (length, angle) in [(0.05, 2e-3), (0.5, 5e-5)] {
        let data = simulated(&poses(&format!("\"{length} mm\""), &format!("\"{angle} rad\"")), 120, 7);
        let unknown = poses("\"unknown\"", "\"unknown\"");
        let report = identified(&unknown, data);
        let [positions, rotations] = &report.coordinates[..] else { panic!("{:?}", report.coordinates) };
        assert!((positions.uncertainty / length - 1.0).abs() < 0.12, "{positions:?}");
        assert!((rotations.uncertainty / angle - 1.0).abs() < 0.12, "{rotations:?}");
        let text = report.found.identified_map(&unknown, &ur5().spec, "found.map.toml").unwrap();
        assert!(!text.contains("uncertainty = \"unknown\""), "{text}");
    }
}

/// The identified positions are better with the estimated ratio of the uncertainties than with a
/// wrong `angle_uncertainty`, of which a note warns; a right one has no note.
#[test]
fn a_wrong_angle_uncertainty_is_noted() {
    let of = |angle: &str| poses("\"0.05 mm\"", angle);
    let data = simulated(&of("\"2 mrad\""), 120, 7);
    let deviation = |report: &Report| {
        let trace: f64 = (0..3).map(|i| report.placed.stations[0].covariance[i][i]).sum();
        trace.sqrt()
    };
    let noted = |report: &Report| report.notes.iter().any(|note| note.contains("`angle_uncertainty`"));
    let (right, wrong) =
        (identified(&of("\"2 mrad\""), data.clone()), identified(&of("\"0.02 mrad\""), data.clone()));
    assert!(noted(&wrong) && !noted(&right), "{:?} {:?}", wrong.notes, right.notes);
    let estimated = identified(&poses("\"unknown\"", "\"unknown\""), data);
    assert!(!noted(&estimated));
    let [right, wrong, estimated] = [right, wrong, estimated].map(|report| deviation(&report));
    println!("{right} {wrong} {estimated}");
    assert!(estimated < 1.1 * right && wrong > 1.5 * estimated, "{right} {wrong} {estimated}");
}

/// A plan and a simulation would claim an uncertainty that nobody stated.
#[test]
fn plans_and_simulations_need_a_stated_uncertainty() {
    for map in [poses("\"0.05 mm\"", "\"unknown\""), sockets("\"unknown\"")] {
        let machine = ur5();
        let study = Study::find(None, &machine).unwrap();
        let choice =
            Choice::Optimal { criterion: abbe::identify::Criterion::Determinant, count: 30, candidates: 60 };
        let plan = Plan { machine, map: map.clone(), choice, study, model_error: 0.0, seed: None };
        let at = Places::Samples(10);
        let simulate =
            Simulate { machine: real(), map, at, noise: None, outliers: 0.0, random: false, seed: 1 };
        for refused in [plan.run(&mut ()).err().unwrap(), simulate.run(&mut ()).err().unwrap()] {
            assert!(refused.to_string().contains("which this map calls unknown"), "{refused}");
        }
    }
}

fn measure(map: &Map, data: Data) -> abbe_metrology::measure::Report {
    let job = Measure { machine: real(), map: map.clone(), data, accept: Acceptance::default() };
    job.run(&mut ()).unwrap_or_else(|mistake| panic!("{mistake}"))
}

/// `measure` judges residuals by the test of `identify`: 5 % of machines as specified have p below
/// 0.05, at a stated or a fitted station, and a wrong uncertainty is found in points, poses and
/// readings. Without a stated uncertainty there is no verdict.
#[test]
fn residuals_are_judged_as_in_an_identification() {
    let point = |head: &str| map(head, "[point]\ncolumns = [\"x\", \"y\", \"z\"]\nunit = \"mm\"\n");
    let maps = |sigma: &str| {
        [
            point(&format!("uncertainty = {sigma}\n")),
            point(&format!("uncertainty = {sigma}\nbase = \"unknown\"\n")),
            poses(sigma, "\"0.1 mrad\""),
            sockets(sigma),
        ]
    };
    let count = sample_size(200).min(40) as u64;
    for (right, (half, unknown)) in
        maps("\"0.05 mm\"").iter().zip(maps("\"0.025 mm\"").iter().zip(&maps("\"unknown\"")))
    {
        let mut rare = 0;
        for seed in 0..count {
            let data = simulated(right, 30, seed);
            let test = measure(right, data.clone()).residual_test.unwrap();
            rare += u64::from(test.p < 0.05);
            if seed == 0 {
                let test = measure(half, data.clone()).residual_test.unwrap();
                assert!((1.4..2.6).contains(&test.factor) && test.p < 0.01, "{test:?}");
                assert!(measure(unknown, data).residual_test.is_none());
            }
        }
        println!("{rare} of {count} below 5 %");
        // Binomial: 5 % of 20 is at most 4 with 99.7 %, of 40 at most 7 with 99.7 %.
        assert!(rare <= if count > 20 { 7 } else { 4 }, "{rare} of {count}");
    }
}
