//! The 42 numbers of a six-legged platform: six lengths, and three coordinates of each of its
//! twelve joints.

use abbe::analysis::{Configuration, Goal, Workspace, compensated, random_joint_samples, sampling};
use abbe::compensator::Status;
use abbe::identify::{Measurement, Model, Observation, Options, Uncertainty, Unknown, fit, identifiable};
use abbe::{Component, Distribution, Manipulator, Orientation, Pose, deviation, displacement};
use abbe_interpreter::Interpreter;
use abbe_metrology::Acceptance;
use abbe_metrology::data::{Data, Map};
use abbe_metrology::identify::{Family, Identify, Settings};
use abbe_metrology::measure::Measure;
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
        let found = compensated(&real, Goal::default(), &at.q, &at.s, &at.u).unwrap();
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

/// Returns a job that identifies a platform without sources, from poses or from points alone.
fn job(observations: Vec<Observation>, is_pose: bool, uncertainty: [&str; 2]) -> Identify {
    let nominal = without_sources(&hexapod(&[[0.0; 7]; 6], ""));
    let machine = Machine::of_spec(Spec::parse("hexapod.toml", &nominal).unwrap(), "hexapod.toml");
    let joints: String =
        (1..=6).map(|i| format!("q{i} = {{ column = \"q{i}\", unit = \"mm\" }}\n")).collect();
    let [length, angle] = uncertainty;
    let measured = match is_pose {
        true => {
            "[pose]\nposition = [\"x\", \"y\", \"z\"]\nunit = \"mm\"\n\
                 quaternion = { columns = [\"a\", \"b\", \"c\", \"d\"], order = \"wxyz\" }\n"
        }
        false => "[point]\ncolumns = [\"x\", \"y\", \"z\"]\nunit = \"mm\"\n",
    };
    let angle = if is_pose { format!("angle_uncertainty = \"{angle}\"\n") } else { String::new() };
    let map = format!(
        "[data]\nuncertainty = \"{length}\"\n{angle}base = \"unknown\"\n\n[joints]\n{joints}\n{measured}"
    );
    let map = Map::parse("map.toml", &map, &machine.spec).unwrap();
    Identify {
        machine,
        map,
        data: data("data.csv", observations),
        test: None,
        terms: Vec::new(),
        harmonics: Vec::new(),
        settings: Settings::default(),
        accept: Acceptance::default(),
    }
}

fn data(file: &str, observations: Vec<Observation>) -> Data {
    Data { file: file.to_owned(), observations, ..Data::default() }
}

/// `identify` finds the lengths of the legs beside the errors of the frames, without any source in
/// the spec: the identified machine has the poses of the real one at rows that were not fitted, and
/// the rank is that of 42 numbers.
#[test]
fn lengths_of_legs_are_identified() {
    let truth = some_errors();
    let mut observations = poses(&truth, 80);
    let test = observations.split_off(60);
    let nominal = without_sources(&hexapod(&[[0.0; 7]; 6], ""));
    let job =
        Identify { test: Some(data("test.csv", test)), ..job(observations, true, ["0.0001 mm", "0.2 urad"]) };
    let report = job.run(&mut ()).unwrap();
    assert_eq!(report.rank, 42);
    let found = report.found.identified_spec(&job.machine.spec, &nominal, "found.toml").unwrap().text;
    assert!(found.contains("joint = \"q1\""), "{found}");
    assert!(Spec::parse("found.toml", &found).is_ok());
    // The identified machine predicts rows that were not fitted.
    let test = report.test.unwrap();
    assert!(test.after.max < 1e-6 && test.before.max > 0.1, "{:?}", test.after);
}

/// Rows at which the loops do not close are listed with their loop, and change nothing else:
/// neither for `identify` nor for `measure`.
#[test]
fn rows_that_do_not_close_are_listed() {
    let observations = poses(&some_errors(), 60);
    let with = |line: u64| {
        let mut observations = observations.clone();
        let mut open = observations[0].clone();
        (open.line, open.q[2]) = (line, 3000.0);
        observations.insert(10, open);
        job(observations, true, ["0.01 mm", "20 urad"])
    };
    let identified = with(99).run(&mut ()).unwrap();
    let without = job(observations.clone(), true, ["0.01 mm", "20 urad"]).run(&mut ()).unwrap();
    assert_eq!((identified.rank, identified.fit.after.rms), (without.rank, without.fit.after.rms));
    let Identify { machine, map, data, accept, .. } = with(99);
    let measured = Measure { machine, map, data, accept }.run(&mut ()).unwrap();
    assert_eq!((measured.rows, measured.unusable), (60, 1));
    let [listed] = &measured.file.unusable[..] else { panic!("{:?}", measured.file.unusable) };
    assert_eq!(listed.line, 99);
    assert!(listed.reason.contains("do not close: loop \"leg") && listed.reason.contains("mm"), "{listed:?}");
}

/// The iterations converge with noise, from poses and from points alone, whose base and tool are
/// unknown: a long valley of the cost is shortened by a smaller prior.
#[test]
fn noisy_platforms_are_identified() {
    for (is_pose, count) in [(true, 30), (true, 150), (false, 30), (false, 150)] {
        let exact = poses(&some_errors(), count);
        for run in 0..sample_size(20).max(2) {
            let mut numbers = sampling::stream(17, run);
            let noisy = |row: &Observation| {
                let noisy = with_noise(row, &mut numbers);
                match (&noisy.measured, is_pose) {
                    (Measurement::Pose(pose), false) => Observation {
                        measured: Measurement::Points(vec![Some(pose.position())].into()),
                        ..noisy
                    },
                    _ => noisy,
                }
            };
            let report = job(exact.iter().map(noisy).collect(), is_pose, ["0.01 mm", "20 urad"]).run(&mut ());
            let report = report.unwrap_or_else(|mistakes| panic!("{count} {run}: {mistakes}"));
            // Four standard deviations of a root mean square.
            let most = 0.01 * 3_f64.sqrt() * (1.0 + 4.0 / (6.0 * count as f64).sqrt());
            let left = report.fit.after.rms;
            assert!(left < most, "{count} {run}: {left} {most}");
        }
    }
}

/// The scale of one leg is selected from poses, and leaves no more than the noise.
#[test]
fn the_scale_of_a_leg_is_selected() {
    let scale = "[[source]]\nname = \"scale\"\nclass = \"repeatable\"\njoint = \"q2\"\nerror = \"1e-3*q2\"\n";
    let text = without_sources(&hexapod(&[[0.0; 7]; 6], "")) + scale;
    let real = Interpreter::new(Spec::parse("real.toml", &text).unwrap());
    let mut numbers = sampling::stream(23, 0);
    let rows: Vec<Observation> = poses(&[[0.0; 7]; 6], 80)
        .into_iter()
        .map(|row| {
            let pose = real.real_pose(&row.q, &[], &[]).unwrap();
            with_noise(&Observation { measured: Measurement::Pose(Box::new(pose)), ..row }, &mut numbers)
        })
        .collect();
    let plain = job(rows, true, ["0.01 mm", "20 urad"]);
    let report = Identify { terms: vec![Family::Joint], ..plain }.run(&mut ()).unwrap();
    let names: Vec<&str> = report.terms.iter().map(|term| &term.name[..]).collect();
    assert!(names.iter().any(|name| name.contains("q2")), "{names:?}");
    let most = 0.01 * 3_f64.sqrt() * (1.0 + 4.0 / (6.0 * 80_f64).sqrt());
    assert!(report.fit.after.rms < most, "{} {most}", report.fit.after.rms);
}
