//! The 42 numbers of a six-legged platform: six lengths, and three coordinates of each of its
//! twelve joints.

use abbe::analysis::{Configuration, Workspace, compensated, random_joint_samples, sampling};
use abbe::compensator::Status;
use abbe::identify::{Measurement, Model, Observation, Options, Uncertainty, Unknown, fit, identifiable};
use abbe::{Component, Distribution, Manipulator, Orientation, Pose, deviation, displacement};
use abbe_interpreter::Interpreter;
use abbe_metrology::Acceptance;
use abbe_metrology::data::{Data, Map};
use abbe_metrology::identify::{Identify, Settings};
use abbe_spec::Spec;
use abbe_study::Machine;

use crate::closed_machines::{hexapod, some_errors};
use crate::thorough::sample_size;

fn interpreter(errors: &[[f64; 7]; 6]) -> Interpreter {
    Interpreter::new(
        Spec::parse("hexapod.toml", &hexapod(errors, "")).unwrap_or_else(|error| panic!("{error}")),
    )
}

/// Returns poses of the platform with the given errors, exact, at configurations that close.
fn poses(errors: &[[f64; 7]; 6], count: usize) -> Vec<Observation> {
    let real = interpreter(errors);
    let samples = random_joint_samples(&real, &[0, 1, 2, 3, 4, 5], 2 * count, 7).unwrap().reached();
    let closed = samples.into_iter().filter(|at| sampling::closes(&real, &at.q, &at.s)).take(count);
    let row = |(line, at): (u64, Configuration)| {
        let pose = real.real_pose(&at.q, &at.s, &at.u).unwrap();
        Observation::new(line, at.q, at.u, Measurement::Pose(Box::new(pose)))
    };
    (1..).zip(closed).map(row).collect()
}

const UNCERTAINTY: Uncertainty = Uncertainty { length: 0.01, angle: 2e-5 };

/// Without noise, all 42 numbers of the exact machine are found again. The measured poses come from
/// its closed loops with all errors, not from the model of the fit.
#[test]
fn all_numbers_are_found_again() {
    let truth = some_errors();
    let ideal = interpreter(&[[1.0; 7]; 6]);
    assert_eq!(ideal.description().sources.len(), 42);
    let model = Model::ideal(&ideal, vec![[0.0; 3]], UNCERTAINTY);
    let model = model.with((0..42).map(Unknown::Magnitude).collect());
    let data = poses(&truth, 60);
    let found = fit(&model, &data, &Options::default()).unwrap();
    for (found, expected) in found.x.iter().zip(truth.as_flattened()) {
        assert!((found - expected).abs() < 1e-9, "{found} {expected}");
    }
}

/// Checks that with known placements of base and tool, all 42 numbers are identifiable. An unknown
/// base acts as a rigid motion of the six joints on the base, an unknown tool as one of those on
/// the platform: they add no combination, and of the 42, 12 are then placements and 30 belong to
/// the machine.
#[test]
fn identifiable_combinations_are_42() {
    let ideal = interpreter(&[[1.0; 7]; 6]);
    let data = poses(&[[0.0; 7]; 6], 60);
    let plain = Model::ideal(&ideal, vec![[0.0; 3]], UNCERTAINTY);
    let numbers = || (0..42).map(Unknown::Magnitude);
    let base = || Component::ALL.map(|component| Unknown::Base(0, component));
    let tool = || Component::ALL.map(|component| Unknown::Tool(0, component));
    let all = plain.with(base().into_iter().chain(tool()).chain(numbers()).collect());
    for (unknowns, expected) in [
        (numbers().collect::<Vec<_>>(), 42),
        (base().into_iter().chain(numbers()).collect(), 42),
        (all.unknowns.clone(), 42),
    ] {
        let model = plain.with(unknowns);
        let found = identifiable(&model, &data, &vec![0.0; model.unknowns.len()]).unwrap();
        assert_eq!(found.rank, expected);
        assert!(found.gap > 1e6, "{}", found.gap);
    }
    // Base and tool are preferred to the numbers of the machine.
    let found = identifiable(&all, &data, &[0.0; 54]).unwrap();
    assert_eq!(found.kept.iter().filter(|k| **k < 12).count(), 12);
}

/// Checks that with noise, the errors of the fit are as large as their standard deviations: the
/// mean square of their ratio is 1.
#[test]
fn standard_deviations_hold() {
    let truth = some_errors();
    let ideal = interpreter(&[[1.0; 7]; 6]);
    let model = Model::ideal(&ideal, vec![[0.0; 3]], UNCERTAINTY);
    let model = model.with((0..42).map(Unknown::Magnitude).collect());
    let data = poses(&truth, 60);
    let runs = sample_size(100);
    let mut sum = 0.0;
    for run in 0..runs {
        let mut numbers = sampling::stream(11, run);
        let noisy: Vec<Observation> = data.iter().map(|row| with_noise(row, &mut numbers)).collect();
        let found = fit(&model, &noisy, &Options::default()).unwrap();
        let deviations = found.standard_deviations();
        for ((found, expected), deviation) in found.x.iter().zip(truth.as_flattened()).zip(deviations) {
            sum += ((found - expected) / deviation.unwrap()).powi(2);
        }
    }
    // The squares of a run are correlated; the tolerance is four standard deviations of independent
    // ones.
    let count = 42.0 * runs as f64;
    let (mean, tolerance) = (sum / count, 4.0 * (2.0 / count).sqrt());
    assert!((mean - 1.0).abs() < tolerance, "{mean} ± {tolerance}");
}

/// Adds the noise of the instrument to a pose: an independent normal error of each coordinate and
/// angle.
fn with_noise(row: &Observation, numbers: &mut impl rand::Rng) -> Observation {
    let Measurement::Pose(pose) = &row.measured else { unreachable!() };
    let mut normal = |size: f64| size * sampling::draw(Distribution::Normal, numbers);
    let [x, y, z] = [0; 3].map(|_| normal(UNCERTAINTY.length));
    let [a, b, c] = [0; 3].map(|_| normal(UNCERTAINTY.angle));
    let turned = displacement(&[0.0, 0.0, 0.0, a, b, c]);
    let Pose([i, j, k, _]) = turned.then(pose);
    let [u, v, w] = pose.position();
    let pose = Pose([i, j, k, [u + x, v + y, w + z]]);
    Observation { measured: Measurement::Pose(Box::new(pose)), ..row.clone() }
}

/// Corrected commands put the tool of the real machine where the ideal one is.
#[test]
fn compensated_platforms_reach_their_poses() {
    let real = interpreter(&some_errors());
    let samples = random_joint_samples(&real, &[0, 1, 2, 3, 4, 5], 100, 3).unwrap().reached();
    let mut corrected = 0;
    for at in samples.into_iter().filter(|at| sampling::closes(&real, &at.q, &at.s)) {
        let found = compensated(&real, None, &at.q, &at.s, &at.u).unwrap();
        if found.status == Status::OutsideLimits {
            continue;
        }
        let (ideal, reached) =
            (real.pose(&at.q, &at.s).unwrap(), real.real_pose(&found.q, &at.s, &at.u).unwrap());
        let left = deviation(Orientation::RotationVector, &ideal, &reached);
        assert!(left[..3].iter().all(|v| v.abs() < 1e-9), "{left:?}");
        assert!(left[3..].iter().all(|v| v.abs() < 1e-11), "{left:?}");
        corrected += 1;
    }
    assert!(corrected > 80, "{corrected}");
}

/// Returns the text of a spec without its sources.
fn without_sources(text: &str) -> String {
    let tables = text.split("\n\n").filter(|table| !table.starts_with("[[source]]"));
    tables.collect::<Vec<_>>().join("\n\n")
}

/// `identify` finds the lengths of the legs beside the errors of the frames, without any source in
/// the spec: the identified machine has the poses of the real one at rows that were not fitted, and
/// the rank is that of 42 numbers.
#[test]
fn lengths_of_legs_are_identified() {
    let nominal = without_sources(&hexapod(&[[0.0; 7]; 6], ""));
    let machine = Machine::of_spec(Spec::parse("hexapod.toml", &nominal).unwrap(), "hexapod.toml");
    let joints: String =
        (1..=6).map(|i| format!("q{i} = {{ column = \"q{i}\", unit = \"mm\" }}\n")).collect();
    let map = format!(
        "[data]\nuncertainty = \"0.001 mm\"\nangle_uncertainty = \"2 urad\"\nbase = \"unknown\"\n\n[joints]\n{joints}\n\
         [pose]\nposition = [\"x\", \"y\", \"z\"]\nunit = \"mm\"\n\
         quaternion = {{ columns = [\"a\", \"b\", \"c\", \"d\"], order = \"wxyz\" }}\n"
    );
    let map = Map::parse("map.toml", &map, &machine.spec).unwrap();
    let truth = some_errors();
    let mut observations = poses(&truth, 80);
    let test = observations.split_off(60);
    let data = |file: &str, observations| Data { file: file.to_owned(), observations, ..Data::default() };
    let job = Identify {
        machine,
        map,
        data: data("data.csv", observations),
        test: Some(data("test.csv", test)),
        terms: Vec::new(),
        harmonics: Vec::new(),
        settings: Settings::default(),
        accept: Acceptance::default(),
    };
    let report = job.run(&mut ()).unwrap();
    assert_eq!(report.rank, 42);
    let found = report.found.identified_spec(&job.machine.spec, &nominal, "found.toml").unwrap().text;
    assert!(found.contains("joint = \"q1\""), "{found}");
    assert!(Spec::parse("found.toml", &found).is_ok());
    // The identified machine predicts rows that were not fitted.
    let test = report.test.unwrap();
    assert!(test.after.max < 1e-6 && test.before.max > 0.1, "{:?}", test.after);
}
