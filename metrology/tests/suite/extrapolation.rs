//! Uncertainty of an identified machine outside the fitted ranges, compared with the scatter of
//! many identifications.

use std::sync::Arc;

use abbe::identify::Loss;
use abbe::{Class, Manipulator};
use abbe_interpreter::Interpreter;
use abbe_metrology::Acceptance;
use abbe_metrology::compensate::Compensate;
use abbe_metrology::data::{Data, Map};
use abbe_metrology::identify::{Identify, Prior, Report, Settings};
use abbe_metrology::measure::Measure;
use abbe_metrology::simulate::{Places, Simulate};
use abbe_study::{Machine, Notes};

use super::simulated_ur5::{joints, machine, ur5, ur5_with};

/// Share of the joint limits within which the machine is measured.
const SHARE: f64 = 0.15;

const ERRORS: &str = "\n[[source]]\nname = \"truth\"\nclass = \"repeatable\"\nframe = \"shoulder\"\ne_x = \"0.6 mm\"\ne_s = \"0.8 mrad\"\n";

/// Returns a map with exactly known base and target.
fn map() -> Map {
    map_of("\"90 mm\", \"-35 mm\", \"60 mm\"")
}

fn map_of(target: &str) -> Map {
    let joints = joints();
    let text = format!(
        "[data]\nuncertainty = \"0.02 mm\"\nbase = \"exact\"\nplacement = \"exact\"\n\n[joints]\n{joints}\n[point]\n\
         columns = [\"x\", \"y\", \"z\"]\nunit = \"mm\"\n[placement]\ntargets = [[{target}]]\n"
    );
    Map::parse("map.toml", &text, &ur5().spec).unwrap()
}

fn simulated(at: Places, seed: u64) -> Data {
    simulated_with(ERRORS, at, seed)
}

fn simulated_with(errors: &str, at: Places, seed: u64) -> Data {
    let job = Simulate {
        machine: ur5_with(errors),
        map: map(),
        at,
        noise: None,
        outliers: 0.0,
        random: false,
        seed,
    };
    let observations = job.run(&mut ()).unwrap().observations;
    Data { file: "simulated".to_owned(), observations, stations: vec![String::new()], ..Data::default() }
}

/// Simulates measurements over the whole workspace or near home; `seed` determines the noise.
fn measured(samples: usize, near: bool, seed: u64) -> Data {
    let mut data = simulated(Places::Samples(samples), 7);
    if near {
        data.observations.iter_mut().for_each(|row| row.q.iter_mut().for_each(|q| *q *= SHARE));
    }
    simulated(Places::Rows(data), seed)
}

/// Identifies the machine near home; returns the report and the machine of the written spec.
fn identified(seed: u64, test: Option<Data>) -> (Report, Machine) {
    identified_from(measured(80, true, seed), test)
}

fn identified_from(data: Data, test: Option<Data>) -> (Report, Machine) {
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
        map: map(),
        data,
        test,
        terms: Vec::new(),
        harmonics: Vec::new(),
        settings,
        accept: Acceptance::default(),
    };
    let report = job.run(&mut ()).unwrap();
    let nominal = ur5();
    let written = report.found.identified_spec(&nominal.spec, &nominal.text().unwrap(), "found.toml");
    let written = machine("found.toml", &written.unwrap().text);
    (report, written)
}

/// Returns the machine of the written spec without its random sources, which do not change between
/// identifications.
fn found(seed: u64) -> Machine {
    let mut machine = identified(seed, None).1;
    let sources = Arc::make_mut(&mut machine.spec).sources.iter_mut();
    sources.filter(|source| source.class != Class::Repeatable).for_each(|source| source.enabled = false);
    machine
}

/// Holds that `identify` states the same deviations of test rows outside the fitted ranges as
/// `measure` with the written spec.
#[test]
fn identify_and_measure_state_the_same_deviations() {
    let far = measured(40, false, 100);
    let (report, written) = identified(0, Some(far.clone()));
    let job = Measure { machine: written, map: map(), data: far, accept: Acceptance::default() };
    let measured = job.run(&mut ()).unwrap().extrapolated.unwrap();
    let (stated, known) = (report.extrapolated.unwrap(), measured.standard_deviation.unwrap());
    println!("{stated:?} {known:?}");
    assert_eq!(stated.count, measured.count);
    let stated = stated.standard_deviation.unwrap();
    for (stated, known) in [(stated.extrapolated, known.extrapolated), (stated.within, known.within)] {
        assert!((stated / known - 1.0).abs() < 1e-9, "{stated:?} {known}");
    }
}

/// Warnings of a job.
#[derive(Default)]
struct RecordedNotes(Vec<String>);

impl Notes for RecordedNotes {
    fn warn(&mut self, line: &str) {
        self.0.push(line.to_owned());
    }
}

/// Computes the scatter of the measured points of several machines: root mean square over
/// configurations, all directions together, in mm.
fn scatter(machines: &[Machine], data: &Data) -> f64 {
    let s: Vec<f64> = machines[0].spec.parameters.iter().map(|parameter| parameter.value).collect();
    let interpreters: Vec<Interpreter> =
        machines.iter().map(|machine| Interpreter::new(machine.spec.clone())).collect();
    let mut squares = 0.0;
    for row in &data.observations {
        let points: Vec<[f64; 3]> = interpreters
            .iter()
            .map(|one| {
                let magnitudes = vec![1.0; one.description().sources.len()];
                one.drawn_pose(&row.q, &s, &row.u, &magnitudes).unwrap().unwrap().apply([90.0, -35.0, 60.0])
            })
            .collect();
        for axis in 0..3 {
            let mean = points.iter().map(|point| point[axis]).sum::<f64>() / points.len() as f64;
            let sum = points.iter().map(|point| (point[axis] - mean).powi(2)).sum::<f64>();
            squares += sum / (points.len() - 1) as f64;
        }
    }
    (squares / data.observations.len() as f64).sqrt()
}

/// The uncertainty stated by one identification agrees with the scatter of twenty, inside the
/// fitted ranges and outside.
#[test]
fn stated_uncertainty_agrees_with_the_scatter_outside_the_ranges() {
    let machines: Vec<Machine> = (0..20).map(found).collect();
    let (far, near) = (measured(40, false, 100), measured(40, true, 100));
    let measure = |data: &Data, heard: &mut RecordedNotes| {
        let (machine, map, data) = (machines[0].clone(), map(), data.clone());
        Measure { machine, map, data, accept: Acceptance::default() }.run(heard).unwrap().extrapolated
    };
    let mut heard = RecordedNotes::default();
    let said = measure(&far, &mut heard).unwrap();
    assert_eq!((said.count, said.all), (40, 40));
    let known = said.standard_deviation.unwrap();
    let (within, outside) = (scatter(&machines, &near), scatter(&machines, &far));
    println!(
        "within {within:.4} (said {:.4}), outside {outside:.4} (said {:.4})",
        known.within, known.extrapolated
    );
    // With 20 machines and a few dominant directions, the standard deviation of the scatter is
    // about 10 %.
    assert!((0.75..1.33).contains(&(known.within / within)), "{known:?} {within}");
    assert!((0.75..1.33).contains(&(known.extrapolated / outside)), "{known:?} {outside}");
    assert!(
        known.extrapolated > 1.5 * known.within && known.extrapolated_max > known.extrapolated,
        "{known:?}"
    );
    assert!(
        heard.0[0].contains("times the") && heard.0[0].contains("extrapolations"),
        "{heard:?}",
        heard = heard.0
    );
    // What `compensate` says of corrected commands is the same for the origin of the tool.
    let (machine, data) = (machines[0].clone(), far.clone());
    let (map, accept) = (map_of("0, 0, 0"), Acceptance::default());
    let job = Measure { machine: machine.clone(), map: map.clone(), data: data.clone(), accept };
    let measured = job.run(&mut ()).unwrap().extrapolated.unwrap().standard_deviation.unwrap();
    let job = Compensate { machine, map, data, poses: false, tolerance: 1e-3, weight: None };
    assert_eq!(job.run(&mut ()).unwrap().deviation, Some(measured.extrapolated));
    let mut quiet = RecordedNotes::default();
    assert!(measure(&near, &mut quiet).is_none() && quiet.0.is_empty(), "{:?}", quiet.0);
}

/// Holds that the stated deviation of the tool point within the ranges is what unseen rows show,
/// although the model lacks the errors of all gears.
#[test]
fn stated_uncertainty_within_the_ranges_agrees_with_unseen_rows() {
    for phase in 0..4 {
        let gear = |j: i32| {
            let error =
                format!("0.2 mrad * sin({}*q{j} + {}) + 0.1 mrad * sin(11*q{j})", 2 + j % 3, j * phase);
            format!(
                "\n[[source]]\nname = \"gear {j}\"\nclass = \"repeatable\"\njoint = \"q{j}\"\nerror = \"{error}\"\n"
            )
        };
        let errors = ERRORS.to_owned() + &(1..=6).map(gear).collect::<String>();
        let part = |samples: usize, share: f64| {
            let mut data = simulated(Places::Samples(samples), 7);
            data.observations.iter_mut().for_each(|row| row.q.iter_mut().for_each(|q| *q *= share));
            simulated_with(&errors, Places::Rows(data), 11 + samples as u64)
        };
        // The last row is outside the ranges.
        let (mut unseen, beyond) = (part(131, 0.29), part(2, 0.6));
        unseen.observations.extend(beyond.observations.into_iter().take(1));
        let (report, _) = identified_from(part(100, 0.3), Some(unseen));
        let stated = report.extrapolated.unwrap().standard_deviation.unwrap().within;
        let seen = report.test.unwrap().after.rms;
        println!("{phase}: {stated:.4} stated, {seen:.4} seen");
        assert!((0.7..1.3).contains(&(stated / seen)), "{stated} {seen}");
    }
}
