//! Instruments that are read one by one: what they determine of a machine with known errors, and
//! what they cannot.

mod mill;

use std::collections::BTreeMap;

use abbe_metrology::Acceptance;
use abbe_metrology::data::{Data, Map};
use abbe_metrology::identify::{Family, Identify, Prior, Report, Settings};
use abbe_metrology::measure::Measure;
use abbe_metrology::plan::{Choice, Plan};
use abbe_metrology::simulate::{Places, Simulate};
use abbe_spec::Spec;
use abbe_spec::diagnostic::Diagnostics;
use abbe_study::{Machine, Study};

use super::simulated_ur5::{joints, ur5, ur5_with};
use crate::thorough::sample_size;

/// Errors of the simulated UR5 by name, in mm and rad.
const TRUTH: [(&str, f64); 6] =
    [("e_x2", 0.6), ("e_s2", 0.8e-3), ("e_y3", -0.5), ("e_p3", -1.1e-3), ("e_z4", 0.4), ("e_r5", 0.7e-3)];

const FRAMES: [&str; 6] = ["base", "shoulder", "elbow", "wrist 1", "wrist 2", "wrist 3"];

fn real() -> Machine {
    real_with("")
}

/// Returns the machine with further sources.
fn real_with(sources: &str) -> Machine {
    let mut text = "\n[[source]]\nname = \"truth\"\nclass = \"repeatable\"\n".to_owned();
    for (name, value) in TRUTH {
        let (component, frame) = name.split_at(3);
        let unit = if ["e_x", "e_y", "e_z"].contains(&component) { "mm" } else { "rad" };
        let frame = FRAMES[frame.parse::<usize>().unwrap() - 1];
        text += &format!("[[source.effect]]\nframe = \"{frame}\"\n{component} = \"{value} {unit}\"\n");
    }
    ur5_with(&format!("{text}{sources}"))
}

/// Returns a map with a ball beside the last axis and the given instruments.
fn map(instruments: &str) -> Map {
    let joints = joints();
    let ball = "[[target]]\nname = \"ball\"\nposition = [\"60 mm\", \"20 mm\", \"50 mm\"]\n";
    let text = format!("[data]\nsetup = \"setup\"\n[joints]\n{joints}\n{ball}{instruments}");
    Map::parse("map.toml", &text, &ur5().spec).unwrap_or_else(|mistake| panic!("{mistake}"))
}

/// Returns one instrument per setup.
fn in_setups(kind: &str, rest: &[&str]) -> String {
    let one = |(i, rest): (usize, &&str)| {
        let n = i + 1;
        format!("[[instrument]]\nname = \"{kind}{n}\"\nkind = \"{kind}\"\nsetup = {n}\n{rest}\n")
    };
    rest.iter().enumerate().map(one).collect()
}

const PLACES: [&str; 4] = [
    "at = [\"400 mm\", \"200 mm\", \"300 mm\"]",
    "at = [\"-350 mm\", \"250 mm\", \"200 mm\"]",
    "at = [\"100 mm\", \"-450 mm\", \"400 mm\"]",
    "at = [\"-200 mm\", \"-350 mm\", \"150 mm\"]",
];

fn contacts() -> Map {
    let rest = PLACES.map(|at| format!("{at}\nuncertainty = \"0.01 mm\""));
    map(&in_setups("contact", &rest.each_ref().map(String::as_str)))
}

fn planes() -> Map {
    let directions = ["[0, 0, 1]", "[1, 0, 0.2]", "[0.1, 1, 0]"];
    let rest: Vec<String> = directions
        .iter()
        .zip(PLACES)
        .map(|(n, at)| format!("{at}\ndirection = {n}\nuncertainty = \"0.01 mm\""))
        .collect();
    map(&in_setups("plane", &rest.iter().map(String::as_str).collect::<Vec<_>>()))
}

fn indicators() -> Map {
    let directions = ["[0, 0, 1]", "[1, 0, 0]", "[0, 1, 0]"];
    let places = PLACES.iter().flat_map(|at| directions.map(|n| (at, n)));
    let rest: Vec<String> = places
        .map(|(at, n)| {
            format!("column = \"dial\"\nunit = \"mm\"\n{at}\ndirection = {n}\nrange = [\"-4 mm\", \"4 mm\"]\nuncertainty = \"0.01 mm\"")
        })
        .collect();
    let rest: Vec<&str> = rest.iter().map(String::as_str).collect();
    map(&in_setups("indicator", &rest))
}

fn sphere(radius: &str) -> Map {
    let at = PLACES[0];
    map(&format!(
        "[[instrument]]\nname = \"sphere\"\nkind = \"sphere\"\n{at}\nradius = {radius}\nuncertainty = \"0.01 mm\"\n"
    ))
}

fn distance(zero: &str, range: &str) -> Map {
    let at = PLACES[0];
    map(&format!(
        "[[instrument]]\nname = \"bar\"\nkind = \"distance\"\ncolumn = \"length\"\nunit = \"mm\"\n{at}\nzero = {zero}\n{range}\nuncertainty = \"0.01 mm\"\n"
    ))
}

/// A dial has few digits: equal readings at one configuration are no copies.
#[test]
fn equal_readings_are_kept() {
    let row = "10,-80,70,20,40,0,1,312.25\n";
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("bar.csv");
    std::fs::write(&file, format!("j1,j2,j3,j4,j5,j6,setup,length\n{row}{row}{row}")).unwrap();
    let data = Data::read(&*file, &distance("\"unknown\"", "")).unwrap();
    assert_eq!((data.observations.len(), data.unusable.len()), (3, 0));
}

fn simulated(map: &Map, samples: usize, seed: u64) -> Data {
    simulated_by(real(), map, samples, seed)
}

fn simulated_by(machine: Machine, map: &Map, samples: usize, seed: u64) -> Data {
    let job = Simulate {
        machine,
        map: map.clone(),
        at: Places::Samples(samples),
        noise: None,
        outliers: 0.0,
        random: false,
        seed,
    };
    let report = job.run(&mut ()).unwrap_or_else(|mistake| panic!("{mistake}"));
    // The data go through a file, as real measurements do.
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("data.csv");
    std::fs::write(&path, report.table.csv()).unwrap();
    Data::read(&path, map).unwrap_or_else(|mistake| panic!("{mistake}"))
}

fn identified(map: &Map, data: Data, prior: f64) -> Report {
    identified_with(map, data, None, prior)
}

fn identified_with(map: &Map, data: Data, test: Option<Data>, prior: f64) -> Report {
    identification(map, data, test, prior).unwrap_or_else(|mistake| panic!("{mistake}"))
}

fn identification(map: &Map, data: Data, test: Option<Data>, prior: f64) -> Result<Report, Diagnostics> {
    identification_by(&[], map, data, test, prior)
}

fn identification_by(
    terms: &[Family],
    map: &Map,
    data: Data,
    test: Option<Data>,
    prior: f64,
) -> Result<Report, Diagnostics> {
    let settings = Settings {
        loss: abbe::identify::Loss::Squares,
        prior: Prior::Share(prior),
        folds: 5,
        time: None,
        points: false,
        only_placement: false,
    };
    let job = Identify {
        machine: ur5(),
        map: map.clone(),
        data,
        test,
        terms: terms.to_vec(),
        harmonics: Vec::new(),
        settings,
        accept: Acceptance::default(),
    };
    job.run(&mut ())
}

/// Returns identified minus true value in standard deviations. True errors that are held at zero
/// contribute to the kept ones they are equivalent to.
fn z_scores(report: &Report) -> Vec<(String, f64)> {
    let mut expected: BTreeMap<&str, f64> = TRUTH.into_iter().collect();
    for held in &report.redundant {
        let truth = TRUTH.iter().find(|(name, _)| *name == held.name).map_or(0.0, |(_, value)| *value);
        for (name, factor) in &held.acts_as {
            *expected.entry(name).or_default() += factor * truth;
        }
    }
    let z = |parameter: &abbe_metrology::identify::Parameter| {
        let expected = expected.get(parameter.name.as_str()).copied().unwrap_or_default();
        (parameter.name.clone(), (parameter.value - expected) / parameter.standard_deviation)
    };
    report.parameters.iter().map(z).collect()
}

/// Every kind of instrument identifies the machine within four of the stated standard deviations.
#[test]
fn every_kind_identifies_the_machine() {
    let angle = "[[instrument]]\nname = \"tracker\"\nkind = \"point\"\ncolumns = [\"x\", \"y\", \"z\"]\nunit = \"mm\"\nuncertainty = \"0.02 mm\"\n\
                 [[instrument]]\nname = \"mirror\"\nkind = \"angle\"\ncolumn = \"lean\"\nunit = \"mrad\"\ndirection = [0.2, 1, 0]\nmirror = [1, 0, 0]\nuncertainty = \"0.02 mrad\"\n";
    let rotation = "[[instrument]]\nname = \"tracker\"\nkind = \"point\"\ncolumns = [\"x\", \"y\", \"z\"]\nunit = \"mm\"\nuncertainty = \"0.02 mm\"\n\
                    [[instrument]]\nname = \"calibrator\"\nkind = \"rotation\"\ncolumn = \"turned\"\nunit = \"deg\"\nuncertainty = \"5 urad\"\n";
    for (name, map) in [
        ("wire", distance("\"unknown\"", "")),
        ("bar", distance("0", "range = [\"299 mm\", \"301 mm\"]")),
        ("contacts", contacts()),
        ("planes", planes()),
        ("sphere", sphere("\"200 mm\"")),
        ("indicators", indicators()),
        ("tracker and mirror", map(angle)),
        ("tracker and rotary-axis calibrator", map(rotation)),
        ("rotary-axis calibrator", map(&rotation[rotation.rfind("[[").unwrap()..])),
    ] {
        let report = identified(&map, simulated(&map, 240, 3), 0.002);
        let z = z_scores(&report);
        let rms = (z.iter().map(|(_, z)| z * z).sum::<f64>() / z.len() as f64).sqrt();
        println!("{name}: rank {}, σ factor {:.3}, z rms {rms:.2}", report.rank, report.uncertainty_factor);
        let far: Vec<_> = z.iter().filter(|(_, z)| z.abs() > 4.0).collect();
        assert!(far.is_empty(), "{name}: {far:?}");
        assert!((0.8..1.2).contains(&report.uncertainty_factor), "{name}: {}", report.uncertainty_factor);
    }
}

/// Sockets at unknown positions, `contact` without `at`, give the errors that sockets at stated
/// positions give; a simulation needs the positions.
#[test]
fn contacts_need_no_position() {
    let unplaced = ["uncertainty = \"0.01 mm\""; 4];
    let unplaced = map(&in_setups("contact", &unplaced));
    let placed = contacts();
    let rows = simulated(&placed, 240, 3);
    let [found, expected] = [&unplaced, &placed].map(|map| identified(map, rows.clone(), 0.002));
    assert_eq!(found.rank, expected.rank);
    // The displacements of the sockets are relative to different positions.
    let errors = found.parameters.iter().zip(&expected.parameters);
    for (found, expected) in errors.filter(|(found, _)| !found.name.starts_with("contact")) {
        let off = (found.value - expected.value) / expected.standard_deviation;
        assert!(off.abs() < 0.01, "{}: {} and {}", found.name, found.value, expected.value);
    }
    let job = Simulate {
        machine: real(),
        map: unplaced,
        at: Places::Samples(10),
        noise: None,
        outliers: 0.0,
        random: false,
        seed: 1,
    };
    let mistake = job.run(&mut ()).err().unwrap().to_string();
    assert!(mistake.contains("the position of the contact \"contact1\" is unknown"), "{mistake}");
    assert!(mistake.contains("add `at`"), "{mistake}");
}

/// Distance of the first two places, in mm.
const APART: f64 = 758.287_544_405_155;

/// Returns sockets at unknown positions, the first two at a known distance, `off` mm wrong.
fn sockets_apart(off: f64) -> Map {
    let sockets = in_setups("contact", &["uncertainty = \"0.01 mm\""; 4]);
    map(&format!(
        "{sockets}[[distance]]\nbetween = [\"contact1\", \"contact2\"]\nvalue = \"{} mm\"\nuncertainty = \"0.005 mm\"\n",
        APART + off
    ))
}

/// A known distance between two sockets at unknown positions gives the machine its scale: one more
/// combination is identifiable, and the length to which the others were relative is found. A wrong
/// distance scales the machine.
#[test]
fn a_distance_between_sockets_gives_the_scale() {
    let rows = simulated(&contacts(), 240, 3);
    let without = map(&in_setups("contact", &["uncertainty = \"0.01 mm\""; 4]));
    let [without, with, wrong] =
        [&without, &sockets_apart(0.0), &sockets_apart(0.8)].map(|map| identified(map, rows.clone(), 0.002));
    assert_eq!(with.rank, without.rank + 1);
    // The displacements of the sockets are relative to where the nominal machine has them.
    let mut far = z_scores(&with);
    far.retain(|(name, z)| !name.starts_with("contact") && z.abs() > 4.0);
    assert!(far.is_empty(), "{far:?}");
    assert!(without.notes.iter().any(|note| note.contains("do not determine the scale")));
    assert!(with.notes.iter().any(|note| note.contains("determine the scale of the machine to 0.0066 mm")));
    let [known] = &with.known_distances[..] else { panic!("one distance") };
    assert_eq!(known.between, ["contact1", "contact2"]);
    assert!((known.found - APART - 0.005 * known.residual).abs() < 1e-9, "{known:?}");
    assert!(known.residual.abs() < 4.0, "{known:?}");
    let length = |report: &Report| {
        let found = report.parameters.iter().find(|one| one.name == "e_x2").unwrap();
        (found.value, found.standard_deviation)
    };
    // 0.8 of 758 mm lengthen the upper arm of -425 mm.
    let ((found, deviation), (wrong, _)) = (length(&with), length(&wrong));
    assert!((found - 0.6).abs() < 4.0 * deviation && deviation < 0.05, "{found} {deviation}");
    assert!((wrong - found + 425.0 * 0.8 / APART).abs() < 0.05, "{wrong} {found}");
}

/// Terms are found beside a known distance, without which the scale of the machine is undetermined.
#[test]
fn terms_are_found_beside_known_distances() {
    let gear = "[[source]]\nname = \"gear\"\nclass = \"repeatable\"\njoint = \"q2\"\n\
                error = \"0.5 mrad * sin(2*q2)\"\n";
    let rows = simulated_by(real_with(gear), &contacts(), 240, 3);
    let report = identification_by(&[Family::Joint], &sockets_apart(0.0), rows, None, 0.002).unwrap();
    let names: Vec<&str> = report.terms.iter().map(|term| &term.name[..]).collect();
    assert_eq!(names, ["q2: twice per turn of q2, joint error"]);
}

/// The standard deviation of the length holds over simulated data and distances.
#[test]
fn a_distance_is_as_uncertain_as_stated() {
    use rand::{RngExt, SeedableRng};
    let mut random = rand_xoshiro::Xoshiro256PlusPlus::seed_from_u64(7);
    // Uniform within √3 standard deviations.
    let mut off = || (random.random::<f64>() - 0.5) * 0.005 * 12.0_f64.sqrt();
    let z = |seed: usize| {
        let report = identified(&sockets_apart(off()), simulated(&contacts(), 160, seed as u64), 0.002);
        let all = z_scores(&report);
        all.iter().find(|(name, _)| name == "e_x2").unwrap().1
    };
    let z: Vec<f64> = (0..sample_size(60)).map(z).collect();
    let square = z.iter().map(|z| z * z).sum::<f64>() / z.len() as f64;
    println!("{} machines: mean square {square:.2}", z.len());
    let spread = 4.0 * (2.0 / z.len() as f64).sqrt();
    assert!((square - 1.0).abs() < spread, "{square} {spread}");
}

/// A distance to an instrument that no row reads is refused while its position is unknown; once it
/// is found, other sockets can be measured alone.
#[test]
fn a_distance_needs_rows_at_both_ends() {
    let rows = simulated(&contacts(), 240, 3);
    let found = identified(&sockets_apart(0.0), rows.clone(), 0.002).found;
    let observations = rows.observations.iter().filter(|row| {
        matches!(&row.measured, abbe::identify::Measurement::Readings(readings) if readings[3].is_none())
    });
    let rows = Data { observations: observations.cloned().collect(), ..rows.clone() };
    let refused = identification(&sockets_apart(0.0), rows.clone(), None, 0.002).unwrap_err().to_string();
    assert!(refused.contains("no row reads the instrument `contact2`"), "{refused}");
    assert!(refused.contains("remove its [[distance]]"), "{refused}");
    let nominal = ur5();
    let spec = found.identified_spec(&nominal.spec, &nominal.text().unwrap(), "found.toml").unwrap();
    let machine = Machine::of_spec(Spec::parse("found.toml", &spec.text).unwrap(), "found.toml");
    let text = found.identified_map(&sockets_apart(0.0), &nominal.spec, "found.map.toml").unwrap();
    assert!(text.contains("[[distance]]"), "{text}");
    let map = Map::parse("found.map.toml", &text, &machine.spec).unwrap();
    let measured = Measure { machine, map, data: rows, accept: Acceptance::default() }.run(&mut ()).unwrap();
    let noise = 0.01 * 3f64.sqrt();
    assert!((measured.explained.left_rms / noise - 1.0).abs() < 0.2, "{:?}", measured.explained);
}

/// Six axes and a point at an unknown place on the tool have 4 · 6 + 3 = 27 identifiable
/// combinations, of which 6 are the pose of the machine.
#[test]
fn ranks_agree_with_theory() {
    let tracker = "[[instrument]]\nname = \"tracker\"\nkind = \"point\"\ncolumns = [\"x\", \"y\", \"z\"]\nunit = \"mm\"\nuncertainty = \"0.02 mm\"\n";
    for (name, map, expected) in [
        ("tracker", map(tracker), 27),
        // Three coordinates of the bar's end replace six of the base; its length is known.
        ("bar", distance("0", "range = [\"299 mm\", \"301 mm\"]"), 24),
        // The unknown zero adds one; different lengths determine it.
        ("wire", distance("\"unknown\"", ""), 25),
        ("sphere", sphere("\"200 mm\""), 24),
        // The unknown radius adds one, and the unknown scale removes one.
        ("sphere of unknown radius", sphere("\"unknown\"\nnominal_radius = \"200 mm\""), 24),
        // Four fixtures add twelve coordinates; the base (six) and the scale remain undetermined.
        ("contacts", contacts(), 27 - 6 + 12 - 1),
        ("planes", planes(), 27 - 6 + 9 - 1),
        // Twelve zeros; readings near zero determine the directions less well than the prior.
        ("indicators", indicators(), 27 - 6 + 12),
    ] {
        let machine = ur5();
        let study = Study::find(None, &machine).unwrap();
        let choice = Choice::Optimal {
            criterion: abbe::identify::Criterion::Determinant,
            count: 100,
            candidates: 240,
        };
        let report = Plan { machine, map, choice, study, model_error: 0.0, seed: None }
            .run(&mut ())
            .unwrap_or_else(|mistake| panic!("{name}: {mistake}"));
        println!("{name}: {} (theory {expected}), condition {:.0}", report.rank, report.condition);
        assert_eq!(report.rank, expected, "{name}");
    }
}

/// Uncertainties of two instruments that state none are estimated from the data.
#[test]
fn uncertainties_are_estimated() {
    let both = "[[instrument]]\nname = \"tracker\"\nkind = \"point\"\ncolumns = [\"x\", \"y\", \"z\"]\nunit = \"mm\"\nuncertainty = UNCERTAIN1\n\
                [[instrument]]\nname = \"wire\"\nkind = \"distance\"\ncolumn = \"length\"\nunit = \"mm\"\nat = [\"400 mm\", \"200 mm\", \"300 mm\"]\nzero = \"unknown\"\nuncertainty = UNCERTAIN2\n";
    let with = |a: &str, b: &str| map(&both.replace("UNCERTAIN1", a).replace("UNCERTAIN2", b));
    let data = simulated(&with("\"0.06 mm\"", "\"0.008 mm\""), 150, 11);
    let report = identified(&with("\"unknown\"", "\"unknown\""), data, 0.01);
    let uncertainties: Vec<f64> =
        report.instruments.iter().map(|instrument| instrument.uncertainty).collect();
    // 450 and 150 values minus the unknowns: standard deviations of the estimates of 3.5 % and 7 %.
    assert!(
        (uncertainties[0] / 0.06 - 1.0).abs() < 0.12 && (uncertainties[1] / 0.008 - 1.0).abs() < 0.25,
        "{uncertainties:?}"
    );
    assert!(
        report
            .instruments
            .iter()
            .all(|instrument| instrument.estimated && (instrument.factor - 1.0).abs() < 0.01)
    );
}

/// Readings in inches or metres in a map that says mm are refused with the unit that explains them;
/// the fit would take them for another size of the machine. The right unit passes.
#[test]
fn readings_in_another_unit_are_refused() {
    for (name, map) in
        [("wire", distance("\"unknown\"", "")), ("bar", distance("0", "range = [\"299 mm\", \"301 mm\"]"))]
    {
        let data = simulated(&map, 120, 3);
        for (unit, factor) in [("inch", 1.0 / 25.4), ("m", 1e-3), ("um", 1e3)] {
            let mut data = data.clone();
            for row in &mut data.observations {
                let abbe::identify::Measurement::Readings(readings) = &mut row.measured else {
                    unreachable!()
                };
                readings.iter_mut().flatten().for_each(|reading| *reading *= factor);
            }
            let refused = identification(&map, data, None, 0.01).unwrap_err().to_string();
            assert!(refused.contains(&format!("are they in {unit}, not mm?")), "{name} {unit}: {refused}");
        }
        assert!(identification(&map, data, None, 0.01).is_ok(), "{name}");
    }
}

/// A note says how well the readings determine the scale of the machine.
#[test]
fn the_scale_is_reported() {
    let said = |map: Map| identified(&map, simulated(&map, 120, 5), 0.002).notes.join("\n");
    assert!(said(contacts()).contains("do not determine the scale of the machine"));
    assert!(said(distance("0", "range = [\"299 mm\", \"301 mm\"]")).contains("mm per metre at best"));
}

/// Round trip of machine and fixtures: `measure` reports the accuracy for test rows that `identify`
/// reported, in the unit of every instrument.
#[test]
fn identified_fixtures_survive_a_round_trip() {
    let wire_in_um = distance("\"unknown\"", "").text().replace("unit = \"mm\"\nat", "unit = \"um\"\nat");
    let wire_in_um = Map::parse("map.toml", &wire_in_um, &ur5().spec).unwrap();
    let lean = "[[instrument]]\nname = \"tracker\"\nkind = \"point\"\ncolumns = [\"x\", \"y\", \"z\"]\nunit = \"mm\"\nuncertainty = \"0.02 mm\"\n\
                [[instrument]]\nname = \"mirror\"\nkind = \"angle\"\ncolumn = \"lean\"\nunit = \"mrad\"\ndirection = [0.2, 1, 0]\nmirror = [1, 0, 0]\nuncertainty = \"0.02 mrad\"\n";
    // Three coordinates have √3 times the noise, a single value has it once; the rest is the error
    // of identification from 240 rows.
    for (name, map, noise) in [
        ("wire", wire_in_um, vec![10.0]),
        ("contacts", contacts(), vec![0.01 * 3f64.sqrt(); 4]),
        ("planes", planes(), vec![0.01; 3]),
        ("sphere", sphere("\"200 mm\""), vec![0.01]),
        ("indicators", indicators(), vec![0.01; 12]),
        ("tracker and mirror", self::map(lean), vec![0.02 * 3f64.sqrt(), 0.02]),
    ] {
        let unseen = simulated(&map, 120, 5);
        let report = identified_with(&map, simulated(&map, 240, 3), Some(unseen.clone()), 0.002);
        let test = report.test.unwrap();
        let nominal = ur5();
        let spec =
            report.found.identified_spec(&nominal.spec, &nominal.text().unwrap(), "found.toml").unwrap();
        let machine = Machine::of_spec(Spec::parse("found.toml", &spec.text).unwrap(), "found.toml");
        let text = report.found.identified_map(&map, &nominal.spec, "found.map.toml").unwrap();
        let found =
            Map::parse("found.map.toml", &text, &machine.spec).unwrap_or_else(|m| panic!("{name}: {m}"));
        let measure = |map: Map| {
            let job = Measure {
                machine: machine.clone(),
                map,
                data: unseen.clone(),
                accept: Acceptance::default(),
            };
            job.run(&mut ()).unwrap_or_else(|mistake| panic!("{name}: {mistake}"))
        };
        let measured = measure(found.clone());
        let left = measured.explained.left_mean;
        assert!(!measured.base_fitted, "{name}");
        assert!((left - test.after.mean).abs() <= 0.01 * test.after.mean, "{name}: {left} {test:?}");
        assert_eq!(measured.instruments.len(), noise.len(), "{name}");
        let (mut squares, mut count) = (0.0, 0.0);
        for (one, noise) in measured.instruments.iter().zip(noise) {
            assert!(one.ideal.rms > 3.0 * one.left.rms, "{name}: {one:?}");
            assert!(one.left.standard_error.unwrap() < 0.5 * noise, "{name}: {one:?}");
            squares += one.count as f64 * (one.left.rms / noise).powi(2);
            count += one.count as f64;
        }
        // With at least 120 values the root mean square is within 13 % at two standard deviations.
        let share = f64::sqrt(squares / count);
        println!("{name}: {share:.3}");
        assert!((0.87..1.2).contains(&share), "{name}: {share} {:?}", measured.instruments);
        // At a new station, the fixtures are fitted to the identified machine; the fit must not
        // lose accuracy.
        let anew = measure(found.newly_stationed());
        assert!(anew.base_fitted && anew.explained.left_rms < 1.1 * measured.explained.left_rms, "{name}");
    }
}

/// A laser that measures displacements between separate pairs of poses identifies all errors that
/// move points relative to each other.
#[test]
fn displacements_between_pairs_of_poses_identify_the_machine() {
    let laser = "[[instrument]]\nname = \"laser\"\nkind = \"displacement\"\ncolumn = \"travelled\"\nunit = \"um\"\nuncertainty = \"10 um\"\n";
    let map = map(laser);
    let job = |samples, seed| Simulate {
        machine: real(),
        map: map.clone(),
        at: Places::Samples(samples),
        noise: None,
        outliers: 0.0,
        random: false,
        seed,
    };
    // Every second cell is empty: such rows are starting points.
    let read = |samples, seed| {
        let mut table = job(samples, seed).run(&mut ()).unwrap_or_else(|mistake| panic!("{mistake}")).table;
        let column = table.heading.iter().position(|name| name == "travelled").unwrap();
        assert!(table.rows[0][column].is_none() && table.rows[1][column].is_some());
        table.rows.iter_mut().step_by(2).for_each(|row| row[column] = None);
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("data.csv");
        std::fs::write(&path, table.csv()).unwrap();
        Data::read(&path, &map).unwrap_or_else(|mistake| panic!("{mistake}"))
    };
    let (data, unseen) = (read(480, 3), read(200, 5));
    assert_eq!((data.observations.len(), data.unusable.len()), (240, 0));
    let report = identified_with(&map, data, Some(unseen.clone()), 0.002);
    // A tracker determines 27 combinations, of which six are its pose.
    assert_eq!(report.rank, 21);
    let far: Vec<_> = z_scores(&report).into_iter().filter(|(_, z)| z.abs() > 4.0).collect();
    assert!(far.is_empty(), "{far:?}");
    assert!((0.8..1.2).contains(&report.uncertainty_factor), "{}", report.uncertainty_factor);
    let test = report.test.unwrap();
    assert!(test.before.rms > 10.0 * test.after.rms && test.after.rms < 0.013, "{test:?}");
    let measured = Measure { machine: real(), map: map.clone(), data: unseen, accept: Acceptance::default() };
    let laser = &measured.run(&mut ()).unwrap().instruments[0];
    assert!(laser.unit == "um" && (8.5..11.5).contains(&laser.left.rms), "{laser:?}");
    // A displacement in the first row has no starting point.
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("data.csv");
    let heading = "setup,j1,j2,j3,j4,j5,j6,travelled";
    std::fs::write(&path, format!("{heading}\n1,0,0,0,0,0,0,5\n1,10,0,0,0,0,0,5\n")).unwrap();
    let data = Data::read(&path, &map).unwrap();
    assert_eq!(data.observations.len(), 1);
    assert!(data.unusable[0].reason.contains("no row before it"), "{:?}", data.unusable);
}

/// A sphere that the fitted rows never touch has no identified place, and its readings in test rows
/// do not count: they would be compared with its nominal place.
#[test]
fn instruments_that_were_never_read_have_no_place() {
    let kinds = [("first", 1, PLACES[0]), ("second", 2, PLACES[1])];
    let of = |moved: &str| {
        let one = |(name, setup, at): &(&str, i32, &str)| {
            let at = if *name == "second" { at.replace("-350 mm", moved) } else { (*at).to_owned() };
            format!(
                "[[instrument]]\nname = \"{name}\"\nkind = \"distance\"\ncolumn = \"length\"\nunit = \"mm\"\n{at}\nzero = \"0 mm\"\nuncertainty = \"0.01 mm\"\nsetup = {setup}\n"
            )
        };
        map(&kinds.iter().map(one).collect::<String>())
    };
    // The second bar stands 5 mm beside its nominal place.
    let data = simulated(&of("-345 mm"), 200, 3);
    let map = of("-350 mm");
    let in_setup = |data: &Data, setup: usize| {
        let mut data = data.clone();
        let is_read = |row: &abbe::identify::Observation| match &row.measured {
            abbe::identify::Measurement::Readings(readings) => readings[setup - 1].is_some(),
            _ => false,
        };
        data.observations.retain(is_read);
        data
    };
    let first = in_setup(&data, 1);
    assert!(first.observations.len() > 50 && in_setup(&data, 2).observations.len() > 50);
    let nominal = ur5();
    let report = identified_with(&map, first.clone(), Some(simulated(&of("-345 mm"), 100, 5)), 0.002);
    let text = report.found.identified_map(&map, &nominal.spec, "found.map.toml").unwrap();
    assert_eq!(text.matches("[[place]]").count(), 1, "{text}");
    assert!(report.test.unwrap().after.rms < 0.05, "{:?}", report.test);
}
