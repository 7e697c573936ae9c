//! Simulated arms with six revolute joints whose gears and encoders have errors of up to 48 periods
//! per turn, measured by a tracker.

use core::f64::consts::PI;

use rand::{RngExt, SeedableRng};
use rand_xoshiro::Xoshiro256PlusPlus;

use crate::by_hand::Puma;
use crate::identify::*;
use abbe_core::Component;

/// Standard deviation of a measured coordinate, in m.
const NOISE: f64 = 5e-5;

fn model() -> Model<'static> {
    let model = Model::ideal(&Puma, vec![[0.08, 0.03, 0.12]], Uncertainty { length: NOISE, angle: 1.0 });
    model.with(model.constants(false))
}

/// Joint i turns about z of the frame before it, so that its error is the roll of that frame.
fn joints() -> Vec<ProfileJoint> {
    let error = |joint: usize| match joint {
        0 => Unknown::Base(0, Component::Roll),
        _ => Unknown::Error(joint - 1, Component::Roll),
    };
    (0..6)
        .map(|variable| ProfileJoint {
            variable,
            error: error(variable),
            basis: ProfileBasis::Turn,
            range: [-PI, PI],
            cycles: ProfileBasis::CYCLES,
        })
        .collect()
}

/// Amplitude in rad, periods per turn and phase of the errors of each joint.
type Waves = Vec<Vec<[f64; 3]>>;

/// Draws two to five periodic errors of 0.05 to 0.3 mrad for each joint.
fn drawn_waves(random: &mut Xoshiro256PlusPlus) -> Waves {
    let wave = |random: &mut Xoshiro256PlusPlus| {
        let periods = random.random_range(1..=48);
        [random.random_range(0.5e-4..3e-4), f64::from(periods), random.random_range(0.0..2.0 * PI)]
    };
    let joint = |_| {
        let count = random.random_range(2..=5);
        (0..count).map(|_| wave(random)).collect()
    };
    (0..6).map(joint).collect()
}

fn error_of(waves: &[[f64; 3]], q: f64) -> f64 {
    waves.iter().map(|[amplitude, periods, phase]| amplitude * (periods * q + phase).sin()).sum()
}

/// Measures an arm with constant errors and these periodic ones at random joint values within
/// `range`. Each row has its true tool point beside the measured one.
fn measured(
    waves: &Waves,
    range: f64,
    rows: usize,
    random: &mut Xoshiro256PlusPlus,
    constants: &[f64],
) -> (Vec<Observation>, Vec<[f64; 3]>) {
    let model = model();
    let all: Vec<Unknown> =
        model.unknowns.iter().copied().chain(joints().iter().map(|joint| joint.error)).collect();
    let model = model.with(all);
    let normal = rand_distr::Normal::new(0.0, NOISE).unwrap();
    let row = |line: usize| {
        let q: Vec<f64> = (0..6).map(|_| random.random_range(-range..range)).collect();
        let errors = waves.iter().zip(&q).map(|(waves, q)| error_of(waves, *q));
        let x: Vec<f64> = constants.iter().copied().chain(errors).collect();
        let nothing = Measurement::Points(vec![None].into());
        let planned = Observation::new(line as u64, q, Vec::new(), nothing);
        let truth = model.at(&x).pose(&planned).unwrap().apply(model.targets[0]);
        let point = truth.map(|value| value + random.sample(normal));
        (Observation { measured: Measurement::Points(vec![Some(point)].into()), ..planned }, truth)
    };
    (0..rows).map(row).unzip()
}

/// Draws constant errors of the frames.
fn drawn_constants(random: &mut Xoshiro256PlusPlus) -> Vec<f64> {
    let draw = |unknown: &Unknown| match unknown {
        Unknown::Error(_, component) if component.is_rotation() => random.random_range(-1e-3..1e-3),
        Unknown::Error(..) => random.random_range(-3e-4..3e-4),
        _ => 0.0,
    };
    model().unknowns.iter().map(draw).collect()
}

fn fitted(model: &Model, data: &[Observation]) -> Fit {
    let priors = model.priors(0.01).unwrap();
    fit(model, data, &Options { priors, ..Options::default() }).unwrap()
}

fn profiles(model: &Model, data: &[Observation], fit: &Fit) -> Option<Profiles> {
    fit_profiles(model, data, fit, &joints(), &Folds::new(data, 5), &mut || true).unwrap()
}

/// Root mean square of the position errors, and of error / standard deviation along each axis, at
/// true tool points. The profiles are known errors of a second fit of the constants.
fn unseen(profiles: &Profiles, data: &[Observation], test: &[Observation], truth: &[[f64; 3]]) -> [f64; 2] {
    let model = model();
    let carriers = profiles.profiles.iter().map(|profile| profile.joint.error);
    let extended = model.with(model.unknowns.iter().copied().chain(carriers).collect());
    let known = |row: &Observation| -> Vec<f64> {
        profiles.profiles.iter().map(|one| one.value(row.q[one.joint.variable])).collect()
    };
    // Rows with the effect of the profiles removed: one Gauss-Newton step at such small errors.
    let zero = vec![0.0; model.unknowns.len()];
    let corrected: Vec<Observation> = data
        .iter()
        .map(|row| {
            let at = |x: &[f64]| extended.at(x).pose(row).unwrap().apply(model.targets[0]);
            let with: Vec<f64> = zero.iter().copied().chain(known(row)).collect();
            let without: Vec<f64> = zero.iter().copied().chain(known(row).iter().map(|_| 0.0)).collect();
            let (with, without) = (at(&with), at(&without));
            let Measurement::Points(points) = &row.measured else { unreachable!() };
            let point = points[0].unwrap();
            let point = core::array::from_fn(|i| point[i] - with[i] + without[i]);
            Observation { measured: Measurement::Points(vec![Some(point)].into()), ..row.clone() }
        })
        .collect();
    let mut fit = fitted(&model, &corrected);
    let sigma = profiles.add_uncertainty(&mut fit);
    let kept = &fit.identifiable.kept;
    let (mut squares, mut z) = (0.0, 0.0);
    for (row, truth) in test.iter().zip(truth) {
        let x: Vec<f64> = fit.x.iter().copied().chain(known(row)).collect();
        let at = |k: &usize, axis: usize, rows: &[(f64, Vec<f64>)]| NOISE * rows[axis].1[*k];
        let mut extended = extended.at(&x);
        let rows = extended.linearized(row).unwrap();
        let found = extended.pose(row).unwrap().apply(core::array::from_fn(|i| {
            let target = model.unknowns.iter().position(|one| *one == Unknown::Target(0, i)).unwrap();
            model.targets[0][i] + fit.x[target]
        }));
        for axis in 0..3 {
            let mut variance = 0.0;
            for (i, a) in kept.iter().enumerate() {
                for (j, b) in kept.iter().enumerate() {
                    variance += at(a, axis, &rows) * fit.covariance[(i, j)] * at(b, axis, &rows);
                }
            }
            for (k, profile) in (model.unknowns.len()..).zip(&profiles.profiles) {
                let deviation = sigma * profile.deviation(row.q[profile.joint.variable]);
                variance += (at(&k, axis, &rows) * deviation).powi(2);
            }
            let error = found[axis] - truth[axis];
            squares += error * error;
            z += error * error / variance;
        }
    }
    [(squares / test.len() as f64).sqrt(), (z / (3 * test.len()) as f64).sqrt()]
}

/// Number of machines of a test.
fn machines(few: u64) -> std::ops::Range<u64> {
    0..if std::env::var_os("ABBE_THOROUGH").is_some() { 4 * few } else { few }
}

/// Joint values without rows: 20° of two joints.
fn gap(joint: usize) -> std::ops::Range<f64> {
    match joint {
        1 => 0.6..0.6 + PI / 9.0,
        4 => -1.2..-1.2 + PI / 9.0,
        _ => 0.0..0.0,
    }
}

/// Checks that 2,000 rows recover profiles, those with gaps included: on unseen rows, the error
/// including the noise of the measurement is at most 1.3 times that noise, and the standard
/// deviations of predicted tool points hold.
#[test]
fn two_thousand_rows_recover_profiles() {
    let mut of_all = Vec::new();
    for seed in machines(3) {
        let mut random = Xoshiro256PlusPlus::seed_from_u64(seed);
        let (waves, constants) = (drawn_waves(&mut random), drawn_constants(&mut random));
        let (mut data, _) = measured(&waves, PI, 2000, &mut random, &constants);
        if seed > 0 {
            data.retain(|row| (0..6).all(|joint| !gap(joint).contains(&row.q[joint])));
        }
        let (test, truth) = measured(&waves, PI, 500, &mut random, &constants);
        let model = model();
        let fit = fitted(&model, &data);
        let found = profiles(&model, &data, &fit).expect("there are profiles");
        let [error, z] = unseen(&found, &data, &test, &truth);
        let floor = NOISE * 3f64.sqrt();
        let (with_noise, constant) =
            (error.hypot(floor) / floor, model.figures(&test, &fit.x).unwrap().rms / floor);
        let crossed = found.cross_validated.figures().rms / floor;
        println!(
            "seed {seed}: {} profiles, unseen {with_noise:.3}, cross-validation {crossed:.3}, constants \
             {constant:.2} times the noise, z {z:.3}",
            found.profiles.len()
        );
        assert_eq!(found.profiles.len(), 6);
        assert!(with_noise < 1.3 && constant > 2.0, "{with_noise} {constant}");
        assert!((crossed - with_noise).abs() < 0.1, "{crossed} {with_noise}");
        assert!(found.after < found.before / 2.0, "{} {}", found.after, found.before);
        of_all.push(z * z);
    }
    let z = (of_all.iter().sum::<f64>() / of_all.len() as f64).sqrt();
    assert!((0.8..1.15).contains(&z), "{z}");
}

/// Checks that nothing is claimed from rows of an arm without periodic errors, and that 200 rows of
/// one with such errors do no harm: gears that err by a few numbers of cycles are found.
#[test]
fn few_rows_do_no_harm() {
    let mut random = Xoshiro256PlusPlus::seed_from_u64(9);
    let constants = drawn_constants(&mut random);
    let model = model();
    for rows in [100, 200, 2000] {
        let (data, _) = measured(&vec![Vec::new(); 6], PI, rows, &mut random, &constants);
        assert!(profiles(&model, &data, &fitted(&model, &data)).is_none(), "{rows}");
    }
    for _ in machines(2) {
        let waves = drawn_waves(&mut random);
        let (data, _) = measured(&waves, PI, 200, &mut random, &constants);
        let (test, truth) = measured(&waves, PI, 500, &mut random, &constants);
        let fit = fitted(&model, &data);
        let constant = model.figures(&test, &fit.x).unwrap().rms / (NOISE * 3f64.sqrt());
        let found = profiles(&model, &data, &fit).expect("there are profiles");
        let [error, z] = unseen(&found, &data, &test, &truth);
        let with_noise = (error / NOISE / 3f64.sqrt()).hypot(1.0);
        println!("200 rows: unseen {with_noise:.3}, constants {constant:.3} times the noise, z {z:.3}");
        assert!(with_noise < 1.3 && constant > 2.0 && (0.7..1.3).contains(&z), "{with_noise} {constant} {z}");
    }
}

/// Checks rows that leave gaps of 20° in two joints, with profiles of 40 waves: within a gap, the
/// profiles are more uncertain, as they say.
#[test]
fn profiles_bridge_gaps() {
    let mut squares = [[0.0; 2]; 2];
    for seed in machines(3) {
        let mut random = Xoshiro256PlusPlus::seed_from_u64(20 + seed);
        let (mut waves, constants) = (drawn_waves(&mut random), drawn_constants(&mut random));
        for joint in &mut waves {
            *joint = (5..45).map(|k| [3e-5, f64::from(k), random.random_range(0.0..2.0 * PI)]).collect();
        }
        let (mut data, _) = measured(&waves, PI, 2000, &mut random, &constants);
        data.retain(|row| (0..6).all(|joint| !gap(joint).contains(&row.q[joint])));
        let model = model();
        let found = profiles(&model, &data, &fitted(&model, &data)).expect("there are profiles");
        assert_eq!(found.profiles.len(), 6);
        for profile in found.profiles.iter().filter(|one| !gap(one.joint.variable).is_empty()) {
            let joint = profile.joint.variable;
            let turn: Vec<f64> = (0..720).map(|i| -PI + f64::from(i) * PI / 360.0).collect();
            let (within, beside): (Vec<f64>, Vec<f64>) = turn.iter().partition(|q| gap(joint).contains(q));
            let mean_square = |at: &[f64], value: &dyn Fn(f64) -> f64| {
                at.iter().map(|q| value(*q).powi(2)).sum::<f64>() / at.len() as f64
            };
            for (sums, at) in squares.iter_mut().zip([&within, &beside]) {
                sums[0] += mean_square(at, &|q| profile.value(q) - error_of(&waves[joint], q));
                sums[1] += mean_square(at, &|q| profile.deviation(q) * found.after);
            }
        }
    }
    let [within, beside] = squares.map(|[error, deviation]| (error / deviation).sqrt());
    println!("error / standard deviation {within:.3} in gaps, {beside:.3} beside them");
    assert!(squares[0][1] > 4.0 * squares[1][1], "{squares:?}");
    assert!(within < 2.0 && (0.7..1.3).contains(&beside), "{within} {beside}");
}

/// Checks a third of a turn, where harmonics can imitate the zeros of joints: the standard
/// deviations of the constants stay near those of a fit without profiles.
#[test]
fn profiles_do_not_take_the_place_of_constants() {
    let mut random = Xoshiro256PlusPlus::seed_from_u64(4);
    let (waves, constants) = (drawn_waves(&mut random), drawn_constants(&mut random));
    let (data, _) = measured(&waves, PI / 3.0, 2000, &mut random, &constants);
    let model = model();
    let before = fitted(&model, &data);
    let found = profiles(&model, &data, &before).expect("there are profiles");
    let mut after = before.clone();
    let variance = found.add_uncertainty(&mut after).powi(2);
    let alone = found.information.clone().try_inverse().unwrap();
    let ratio = |i: usize| (after.covariance[(i, i)] / (variance * alone[(i, i)])).sqrt();
    let largest = (0..alone.nrows()).map(ratio).fold(0.0, f64::max);
    println!("standard deviations of constants at most {largest:.3} times those without profiles");
    assert!(largest < 4.0, "{largest}");
}

/// Factors by blocks solve what a matrix of 150 columns says, and refuse one with a negative
/// direction.
#[test]
fn blocks_factorize() {
    use nalgebra::{DMatrix, DVector};
    for size in [1, 64, 65, 150] {
        let value = |i: usize, j: usize| ((i * 7 + j * 13) as f64 * 0.71 + (i * j) as f64 * 1.3).sin();
        let rows = DMatrix::from_fn(2 * size, size, value);
        let mut matrix = rows.tr_mul(&rows) + DMatrix::identity(size, size);
        let x = DVector::from_fn(size, |i, _| (i as f64).cos());
        let found = super::normal::cholesky(matrix.clone()).unwrap().solve(&(&matrix * &x));
        assert!((found - x).amax() < 1e-10, "{size}");
        matrix[(size - 1, size - 1)] *= -1.0;
        assert!(super::normal::cholesky(matrix).is_none());
    }
}
