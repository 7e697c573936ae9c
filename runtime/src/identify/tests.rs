//! The model against differences of itself, the ranks against theory, the statistics against many draws.

use rand::{RngExt, SeedableRng};
use rand_xoshiro::Xoshiro256PlusPlus;

use super::*;
use crate::analysis::by_hand::{Pps, Puma};
use crate::analysis::{Workspace, joint_samples};
use crate::chain::real_pose;
use crate::{Component, Manipulator, Pose};

const EXACT: Uncertainty = Uncertainty { length: 1.0, angle: 1.0 };

fn observation(q: &[f64], points: usize) -> Observation {
    numbered(1, q, points)
}

fn numbered(line: u64, q: &[f64], points: usize) -> Observation {
    let measured = match points {
        0 => Measurement::Pose(Pose::IDENTITY),
        _ => Measurement::Points(vec![Some([0.0; 3]); points]),
    };
    Observation::new(line, q.to_vec(), Vec::new(), measured)
}

/// Samples of the joints that are moved.
fn sampled(robot: &dyn Manipulator, moved: &[usize], count: usize, points: usize) -> Vec<Observation> {
    let samples = joint_samples(robot, moved, count).unwrap().reached();
    samples.iter().zip(1..).map(|(sample, line)| numbered(line, &sample.q, points)).collect()
}

/// A machine with errors everywhere, base, targets and tool included.
fn disturbed(model: &Model) -> Vec<f64> {
    let value = |(k, unknown): (usize, &Unknown)| {
        let size = match unknown {
            Unknown::Base(_, component) | Unknown::Error(_, component) | Unknown::Tool(component) => {
                if component.is_rotation() {
                    0.02
                } else {
                    5.0
                }
            }
            Unknown::Target(..) | Unknown::Zero(_) => 3.0,
            Unknown::Fixture(fixture, _) => match model.fixtures[*fixture].place {
                Place::Point(_) => 20.0,
                Place::Direction(_) => 0.3,
            },
            Unknown::Magnitude(_) => 2.0,
        };
        size * (1.0 + k as f64 * 2.3).sin()
    };
    model.unknowns.iter().enumerate().map(value).collect()
}

fn residuals(model: &Model, seen: &Observation, x: &[f64]) -> (Vec<f64>, Vec<Vec<f64>>) {
    let (mut values, mut rows) = (Vec::new(), Vec::new());
    let take = |residual: f64, derivative: &mut dyn FnMut(usize) -> f64| {
        values.push(residual);
        rows.push((0..x.len()).map(derivative).collect());
    };
    model.residuals(&mut model.room(), seen, x, take).unwrap();
    (values, rows)
}

/// Analytic derivatives against central differences, far from ε = 0.
fn differences(model: &Model, seen: &Observation) {
    let x = disturbed(model);
    let (_, rows) = residuals(model, seen, &x);
    for k in 0..x.len() {
        let step = if x[k].abs() > 0.1 { 1e-3 } else { 1e-5 };
        let at = |sign: f64| {
            let mut x = x.clone();
            x[k] += sign * step;
            residuals(model, seen, &x).0
        };
        let (above, below) = (at(1.0), at(-1.0));
        for (row, (a, b)) in rows.iter().zip(above.iter().zip(&below)) {
            let expected = (a - b) / (2.0 * step);
            let scale = expected.abs().max(1.0);
            assert!(
                (row[k] - expected).abs() < 2e-6 * scale,
                "{}: {} {expected}",
                model.name(model.unknowns[k]),
                row[k]
            );
        }
    }
}

#[test]
fn derivatives_are_those_of_the_exact_chain() {
    let q = [900.0, 120.0, 300.0, 0.7, 0.04, -0.03];
    let targets = vec![[100.0, 20.0, -30.0], [-80.0, 10.0, 50.0], [10.0, 90.0, 5.0]];
    let points = Model::ideal(&Pps, targets, EXACT);
    let sources = points.repeatable().into_iter().map(Unknown::Magnitude);
    let points = points.with(points.constants(false).into_iter().chain(sources).collect());
    differences(&points, &observation(&q, 3));
    let pose = Model::ideal(&Pps, vec![[0.0; 3]], EXACT);
    let pose = pose.with(pose.constants(true));
    // The pose that would be seen is about where it should be, not half a turn away.
    let near = pose.pose(&mut pose.room(), &observation(&q, 0), &vec![0.0; pose.unknowns.len()]).unwrap();
    differences(&pose, &Observation { measured: Measurement::Pose(near), ..observation(&q, 0) });
}

/// One reading of every gauge.
fn every_gauge(robot: &dyn Manipulator) -> Model<'_> {
    let targets = vec![[100.0, 20.0, -30.0], [-80.0, 10.0, 50.0]];
    let gauges = [
        Gauge::Coordinate { target: 1, axis: 2 },
        Gauge::Distance { target: 0, from: 0 },
        Gauge::Apart { target: 1, from: 0, axis: 1 },
        Gauge::Along { target: 0, about: [800.0, -150.0, 300.0], direction: 1 },
        Gauge::Between { targets: [0, 1] },
        Gauge::Lean { mirror: [0.6, 0.0, 0.8], direction: 1 },
    ];
    let fixture = |name: &str, place| Fixture { name: name.to_owned(), place };
    let reading = |(i, gauge)| Reading {
        name: format!("reading{i}"),
        gauge,
        zero: 0.5,
        zero_known: false,
        uncertainty: 1.0,
        touched: false,
        instrument: 0,
    };
    let fixtures = vec![
        fixture("bar", Place::Point([300.0, -200.0, 500.0])),
        fixture("plane", Place::Direction([0.3, -0.5, 0.2])),
    ];
    let base = Pose::IDENTITY
        .then(&real_pose(&[Pose::IDENTITY, Pose::IDENTITY], &[[500.0, -3.0, 800.0, 0.4, -1.9, 2.5]]));
    let readings = gauges.into_iter().enumerate().map(reading).collect();
    Model { fixtures, readings, stations: vec![Station::at(base)], ..Model::ideal(robot, targets, EXACT) }
}

#[test]
fn derivatives_of_readings_are_exact() {
    let q = [900.0, 120.0, 300.0, 0.7, 0.04, -0.03];
    let model = every_gauge(&Pps);
    let sources = model.repeatable().into_iter().map(Unknown::Magnitude);
    let all = model.constants(false).into_iter().chain(sources);
    let model = model.with(all.chain(Component::ALL.map(Unknown::Tool)).collect());
    let seen = Observation { measured: Measurement::Readings(vec![Some(0.0); 6]), ..observation(&q, 1) };
    differences(&model, &seen);
    assert_eq!(seen.count(), 6);
    let hidden = Measurement::Readings(vec![None, Some(1.0), None, None, Some(2.0), None]);
    let part = Observation { measured: hidden, ..seen.clone() };
    let zero = vec![0.0; model.unknowns.len()];
    let (all, rows) = residuals(&model, &seen, &zero);
    let (two, _) = residuals(&model, &part, &zero);
    assert_eq!(two.len(), 2);
    assert!((two[0] - all[1] + 1.0).abs() < 1e-12 && (two[1] - all[4] + 2.0).abs() < 1e-12);
    // Nothing of the base moves a fixture against the machine.
    let base = model.unknowns.iter().enumerate().filter(|(_, unknown)| matches!(unknown, Unknown::Base(..)));
    for (k, _) in base {
        assert!(rows[1..].iter().all(|row| row[k] == 0.0));
    }
}

#[test]
fn the_chain_is_that_of_equation_6() {
    let q = [900.0, 120.0, 300.0, 0.7, 0.04, -0.03];
    let model = Model::ideal(&Pps, vec![[0.0; 3]], EXACT);
    let errors = model.constants(false).into_iter().filter(|unknown| matches!(unknown, Unknown::Error(..)));
    let model = model.with(errors.collect());
    let x = disturbed(&model);
    let errors: Vec<[f64; 6]> = x.chunks_exact(6).map(|e| e.try_into().unwrap()).collect();
    let mut transforms = vec![Pose::IDENTITY; 7];
    Pps.transforms(&q, &model.s, &mut transforms).unwrap();
    let Pose(expected) = real_pose(&transforms, &errors);
    let Pose(found) = model.pose(&mut model.room(), &observation(&q, 1), &x).unwrap();
    for (found, expected) in found.as_flattened().iter().zip(expected.as_flattened()) {
        assert!((found - expected).abs() < 1e-10);
    }
}

const TARGETS: [[f64; 3]; 3] = [[-200.0, 10.0, 150.0], [250.0, 0.0, -100.0], [30.0, 40.0, 300.0]];

/// Rank, and groups by the twists, which must say the same.
fn counted(robot: &dyn Manipulator, moved: &[usize], points: usize, base: bool) -> usize {
    let (targets, pose) = match points {
        0 => (vec![[0.0; 3]], true),
        1 => (vec![[0.0; 3]], false),
        _ => (TARGETS.to_vec(), false),
    };
    let data = sampled(robot, moved, 80, points);
    let model = Model::ideal(robot, targets, Uncertainty { length: 1.0, angle: 1e-3 });
    let kept = |unknown: &Unknown| match unknown {
        Unknown::Error(..) => true,
        Unknown::Base(..) => base,
        _ => false,
    };
    let model = model.with(model.constants(pose).into_iter().filter(kept).collect());
    let zero = vec![0.0; model.unknowns.len()];
    let known = identifiable(&model, &data, &zero).unwrap();
    assert!(known.gap > 1e6, "{}", known.gap);
    let found = groups(&model, &data[0].q, moved, pose).unwrap();
    assert_eq!(known.rank + found.len(), model.unknowns.len());
    // Each group says the truth: its errors move everything as those it names do.
    for group in found {
        let mut x = zero.clone();
        let place = |unknown| model.unknowns.iter().position(|u| *u == unknown).unwrap();
        group.these.iter().for_each(|(unknown, factor)| x[place(*unknown)] += factor);
        group.act_as.iter().for_each(|(unknown, factor)| x[place(*unknown)] -= factor);
        for seen in &data {
            let (_, rows) = residuals(&model, seen, &zero);
            for row in rows {
                let sum: f64 = row.iter().zip(&x).map(|(a, b)| a * b).sum();
                assert!(sum.abs() < 1e-6, "{group:?} {sum}");
            }
        }
    }
    // What is held at zero acts as the kept ones that it names.
    for (k, act_as) in &known.held {
        let (_, rows) = residuals(&model, &data[7], &zero);
        for row in rows {
            let sum: f64 = act_as.iter().map(|(j, factor)| row[*j] * factor).sum();
            assert!((sum - row[*k]).abs() < 1e-5 * row[*k].abs().max(1.0));
        }
    }
    known.rank
}

#[test]
fn counts_are_those_of_theory() {
    let four = &[0, 1, 2, 3][..];
    let six = &[0, 1, 2, 3, 4, 5][..];
    for (moved, points, base, expected) in [
        (six, 0, false, 22),
        (six, 0, true, 24),
        (six, 3, false, 22),
        (six, 3, true, 24),
        (six, 1, false, 19),
        (six, 1, true, 21),
        (four, 0, false, 14),
        (four, 3, true, 16),
        (four, 1, false, 11),
        (four, 1, true, 13),
    ] {
        assert_eq!(counted(&Pps, moved, points, base), expected, "{moved:?} {points} {base}");
    }
    assert_eq!(counted(&Puma, six, 0, false), 26);
    assert_eq!(counted(&Puma, six, 0, true), 30);
}

/// A machine whose errors are drawn, as an instrument with that noise sees it.
fn measured(
    model: &Model,
    x: &[f64],
    list: &[Observation],
    noise: f64,
    random: &mut Xoshiro256PlusPlus,
) -> Vec<Observation> {
    let normal = rand_distr::Normal::new(0.0, noise).unwrap();
    let mut room = model.room();
    let see = |asked: &Observation| {
        let pose = model.pose(&mut room, asked, x).unwrap();
        let point = |target: &[f64; 3]| {
            let at = pose.apply(*target);
            Some(at.map(|coordinate| coordinate + random.sample(normal)))
        };
        Observation {
            measured: Measurement::Points(model.targets.iter().map(point).collect()),
            ..asked.clone()
        }
    };
    list.iter().map(see).collect()
}

/// The paper's two sets with two payloads: 450 rows.
fn planned() -> Vec<Observation> {
    let mut list: Vec<[f64; 4]> = Vec::new();
    for spin in (-3..=3).map(|i| f64::from(i) * 30f64.to_radians()) {
        for corner in 0..8 {
            let at = |bit: usize, low: f64, high: f64| if corner >> bit & 1 == 0 { low } else { high };
            let (x, y, z) = (at(0, -250.0, 250.0), at(1, -100.0, 300.0), at(2, 600.0, 1100.0));
            let (s, c) = spin.sin_cos();
            list.push([1128.0 - (x * c + z * s), 380.0 - y, 1128.0 - (z * c - x * s), spin]);
        }
    }
    let axis = |list: &mut Vec<[f64; 4]>, i: usize, values: &mut dyn Iterator<Item = f64>| {
        for value in values {
            let mut q = [1128.0, 280.0, 0.0, 0.0];
            q[i] = value;
            list.push(q);
        }
    };
    axis(&mut list, 0, &mut (-22..=22).map(|i| 1128.0 + 50.0 * f64::from(i)));
    axis(&mut list, 1, &mut (0..=28).map(|i| 20.0 * f64::from(i)));
    axis(&mut list, 2, &mut (1..=58).map(|i| 25.0 * f64::from(i)));
    axis(&mut list, 3, &mut (-18..=18).map(|i| (5.0 * f64::from(i)).to_radians()));
    let list = list.iter().chain(&list).map(|q| [q[0], q[1], q[2], q[3], 0.0, 0.0]);
    list.zip(1..).map(|(q, line)| numbered(line, &q, 3)).collect()
}

/// Over 200 machines: what can be known is found to within its standard deviations.
#[test]
fn stated_deviations_are_true() {
    let list = planned();
    assert_eq!(list.len(), 450);
    let model = Model::ideal(&Pps, TARGETS.to_vec(), Uncertainty { length: 0.04, angle: 1.0 });
    let errors = model.constants(false).into_iter().filter(|unknown| !matches!(unknown, Unknown::Target(..)));
    let model = model.with(errors.collect());
    let (mut within, mut all, mut three) = (0, 0, 0);
    for seed in 0..200 {
        let mut random = Xoshiro256PlusPlus::seed_from_u64(seed);
        let draw = |unknown: &Unknown| match unknown {
            Unknown::Error(_, component) if component.is_rotation() => random.random_range(-1e-4..1e-4),
            Unknown::Error(..) => random.random_range(-0.1..0.1),
            _ => 0.0,
        };
        let truth: Vec<f64> = model.unknowns.iter().map(draw).collect();
        let data = measured(&model, &truth, &list, 0.04, &mut random);
        let found = fit(&model, &data, &Options::default()).unwrap();
        assert_eq!(found.identifiable.rank, 16);
        // All 36 are wrong; what the kept ones must be is what all of them act as.
        let mut expected = truth.clone();
        for (k, act_as) in &found.identifiable.held {
            act_as.iter().for_each(|(j, factor)| expected[*j] += factor * truth[*k]);
        }
        for (k, deviation) in found.standard_deviations().iter().enumerate() {
            let Some(deviation) = deviation else { continue };
            let off = (found.x[k] - expected[k]).abs() / deviation;
            all += 1;
            within += usize::from(off <= 1.0);
            three += usize::from(off <= 3.0);
        }
    }
    let share = |count: usize| count as f64 / f64::from(all);
    println!("within one: {:.4}, within three: {:.4} of {all}", share(within), share(three));
    assert!((share(within) - 0.68).abs() <= 0.04);
    assert!(share(three) >= 0.99);
}

#[test]
fn gross_errors_are_rejected_and_named() {
    let model = Model::ideal(&Pps, vec![[0.0; 3]], Uncertainty { length: 0.04, angle: 1.0 });
    let model = model.with(model.constants(false));
    let mut random = Xoshiro256PlusPlus::seed_from_u64(7);
    let list = sampled(&Pps, &[0, 1, 2, 3, 4, 5], 400, 1);
    let truth: Vec<f64> = disturbed(&model).iter().map(|x| x * 0.05).collect();
    let mut data = measured(&model, &truth, &list, 0.04, &mut random);
    let wrong: Vec<usize> = (0..400).filter(|i| i % 10 == 3).collect();
    for i in &wrong {
        let Measurement::Points(points) = &mut data[*i].measured else { unreachable!() };
        points[0].as_mut().unwrap()[i % 3] += 5.0 + *i as f64;
    }
    for loss in [Loss::Tukey, Loss::Huber] {
        let options = Options { loss, priors: model.priors(0.01).unwrap(), ..Options::default() };
        let found = fit(&model, &data, &options).unwrap();
        if loss == Loss::Tukey {
            let rejected: Vec<u64> = found.rejected(&data).map(|row| row.line).collect();
            assert_eq!(rejected, wrong.iter().map(|i| *i as u64 + 1).collect::<Vec<_>>());
        }
        assert!((0.8..1.25).contains(&found.sigma), "{loss:?} {}", found.sigma);
    }
}

/// More rows than one block of them, some of them wrong: on one thread, two and five.
#[cfg(feature = "parallel")]
#[test]
fn results_do_not_depend_on_the_number_of_threads() {
    let model = Model::ideal(&Pps, vec![[100.0, 0.0, 20.0], [0.0, 90.0, 5.0]], EXACT);
    let richer = model.with(model.constants(false));
    let mut random = Xoshiro256PlusPlus::seed_from_u64(11);
    let list = sampled(&Pps, &[0, 1, 2, 3, 4, 5], 1300, 2);
    let truth: Vec<f64> = disturbed(&richer).iter().map(|x| x * 0.05).collect();
    let mut data = measured(&richer, &truth, &list, 0.04, &mut random);
    for row in data.iter_mut().step_by(50) {
        let Measurement::Points(points) = &mut row.measured else { unreachable!() };
        points[0].as_mut().unwrap()[1] += 7.0;
    }
    let on = |threads: usize, loss: Loss| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| {
            let found = fit(&richer, &data, &Options { loss, ..Options::default() }).unwrap();
            let crossed = cross_validate(&richer, &data, &found, 10).unwrap();
            (richer.figures(&data, &found.x).unwrap(), found, crossed)
        })
    };
    for loss in [Loss::Squares, Loss::Tukey] {
        let alone = on(1, loss);
        assert!([2, 5].iter().all(|threads| on(*threads, loss) == alone));
    }
}

#[test]
fn too_little_is_said() {
    let model = Model::ideal(&Pps, vec![[0.0; 3]], EXACT);
    let model = model.with(model.constants(false));
    let data = sampled(&Pps, &[0, 1, 2, 3, 4, 5], 7, 1);
    assert!(matches!(fit(&model, &data, &Options::default()), Err(Failure::TooFew { numbers: 21, .. })));
    assert!(matches!(
        fit(&model, &[], &Options::default()),
        Err(Failure::TooFew { numbers: 0, rank: 0, .. })
    ));
}

#[test]
fn registration_undoes_a_motion() {
    let motion = real_pose(&[Pose::IDENTITY, Pose::IDENTITY], &[[5.0, -3.0, 800.0, 0.4, -1.9, 2.5]]);
    let moved: Vec<[f64; 3]> = TARGETS.iter().map(|p| motion.apply(*p)).collect();
    let found = register(&TARGETS, &moved).unwrap();
    for (a, b) in found.pose.0.as_flattened().iter().zip(motion.0.as_flattened()) {
        assert!((a - b).abs() < 1e-10);
    }
    assert!(found.rms < 1e-10 && found.breadth > 0.1);
    let line = [[0.0; 3], [1.0, 1.0, 1.0], [3.0, 3.0, 3.0]];
    assert!(register(&line, &line).unwrap().breadth < 1e-6);
    assert!(register(&line[..2], &line[..2]).is_none());
}

/// Choices by the library and by trying all of them.
fn brute_force(criterion: Criterion, model_error: f64, targets: Vec<[f64; 3]>) {
    let points = targets.len();
    let model = Model::ideal(&Puma, targets, Uncertainty { length: 1e-4, angle: 1e-3 });
    let unknowns = [
        (1, Component::Roll),
        (2, Component::X),
        (3, Component::Spin),
        (4, Component::Pitch),
        (0, Component::X),
    ];
    let model = model.with(unknowns.map(|(frame, component)| Unknown::Error(frame, component)).to_vec());
    let used = sampled(&Puma, &[0, 1, 2, 3, 4, 5], 20, points);
    let used = model.tool_points(&used).unwrap();
    let objective = Objective { criterion, used: &used, model_error };
    let list = sampled(&Puma, &[1, 2, 3, 4], 13, points);
    let known = identifiable(&model, &list, &[0.0; 5]).unwrap();
    assert_eq!(known.rank, 5);
    let value = |design: &Design| match criterion {
        Criterion::Determinant => -design.log_det,
        Criterion::Variance => design.variance,
    };
    let mut best = f64::INFINITY;
    for set in 0..1_u32 << 13 {
        if set.count_ones() == 4 {
            let part: Vec<Observation> =
                (0..13).filter(|i| set >> i & 1 == 1).map(|i| list[i].clone()).collect();
            if let Some(design) = whole(&model, &part, &known, &objective).unwrap() {
                // Columns are scaled by the list: to those of the whole one.
                best = best.min(match criterion {
                    Criterion::Determinant => -by_hand(&model, &part, &known, model_error),
                    Criterion::Variance => value(&design),
                });
            }
        }
    }
    let found = optimal(&model, &list, &known, 4, &objective, &mut |_, _| {}).unwrap().unwrap();
    let chosen: Vec<Observation> = found.chosen.iter().map(|i| list[*i].clone()).collect();
    let reached = match criterion {
        Criterion::Determinant => -by_hand(&model, &chosen, &known, model_error),
        Criterion::Variance => value(&found),
    };
    assert!(reached <= best + 1e-9 * best.abs(), "{criterion:?} {reached} but {best} can be had");
}

/// `ln det M` from the covariance of what is seen, inverted as it stands.
fn by_hand(model: &Model, part: &[Observation], known: &Identifiable, model_error: f64) -> f64 {
    let p = known.kept.len();
    let Uncertainty { length, angle } = model.uncertainty;
    let arm = crate::analysis::sampling::arm_length(&Puma, &model.s).unwrap();
    let mut information = nalgebra::DMatrix::zeros(p, p);
    for seen in part {
        let seen = model.nominally_seen(&mut model.room(), seen).unwrap();
        let (_, rows) = residuals(model, &seen, &vec![0.0; model.unknowns.len()]);
        let n = rows.len();
        let pose = matches!(seen.measured, Measurement::Pose(_));
        let sigma = |i: usize| if pose && i >= 3 { angle } else { length };
        let jacobian = nalgebra::DMatrix::from_fn(n, p, |i, j| rows[i][known.kept[j]] * sigma(i));
        let covariance = nalgebra::DMatrix::from_fn(n, n, |i, j| {
            let common = if pose && i >= 3 { model_error / arm } else { model_error };
            let noise = if i == j { sigma(i).powi(2) } else { 0.0 };
            let together = if pose { i == j } else { i % 3 == j % 3 };
            noise + if together { common.powi(2) } else { 0.0 }
        });
        information += jacobian.transpose() * covariance.try_inverse().unwrap() * &jacobian;
    }
    information.determinant().ln()
}

#[test]
fn small_designs_are_the_best_of_all() {
    for criterion in [Criterion::Variance, Criterion::Determinant] {
        brute_force(criterion, 0.0, vec![[0.0; 3]]);
        brute_force(criterion, 3e-4, vec![[0.0; 3], [0.1, 0.0, 0.05], [0.0, 0.08, 0.0]]);
        brute_force(criterion, 3e-4, Vec::new());
    }
}

/// Measured, identified and asked for the tool point again and again: the predicted σ is that of the errors. Poses too, whose
/// orientations are anywhere.
#[test]
fn the_predicted_deviation_is_found() {
    for points in [1, 0] {
        let model = Model::ideal(&Puma, vec![[0.0; 3]], Uncertainty { length: 1e-4, angle: 2e-4 });
        let model = model.with(model.constants(points == 0));
        let list = sampled(&Puma, &[0, 1, 2, 3, 4, 5], 200, points);
        let zero = vec![0.0; model.unknowns.len()];
        let expect = |list: &[Observation]| -> Vec<Observation> {
            list.iter().map(|seen| model.nominally_seen(&mut model.room(), seen).unwrap()).collect()
        };
        let list = expect(&list);
        let known = identifiable(&model, &list, &zero).unwrap();
        let places: Vec<Observation> = list.iter().skip(3).step_by(20).cloned().collect();
        let used = model.tool_points(&places).unwrap();
        let objective = Objective { criterion: Criterion::Variance, used: &used, model_error: 0.0 };
        let found = optimal(&model, &list, &known, 25, &objective, &mut |_, _| {}).unwrap().unwrap();
        let chosen: Vec<Observation> = found.chosen.iter().map(|i| list[*i].clone()).collect();
        let deviations = used.deviations(&known, &found.covariance);
        let mean_square = deviations.iter().map(|d| d * d).sum::<f64>() / deviations.len() as f64;
        assert!((mean_square / found.variance - 1.0).abs() < 1e-6);
        let mut square = 0.0;
        let runs = 60;
        for run in 0..runs {
            let noise = model.uncertainty;
            let chance = Chance { noise, outliers: 0.0, gross: 0.0, random_sources: false, seed: run };
            let data = simulate(&model.with(Vec::new()), &chosen, &chance).unwrap();
            let fit = fit(&model, &data, &Options::default()).unwrap();
            for place in &places {
                let (mut at, mut is) = (model.room(), model.room());
                let wanted = model.pose(&mut at, place, &zero).unwrap().position();
                let pose = model.pose(&mut is, place, &fit.x).unwrap();
                // Of a single target, what is unknown of its place belongs to the tool point.
                let target = |axis: usize| {
                    let at = |unknown: &Unknown| *unknown == Unknown::Target(0, axis);
                    model.unknowns.iter().position(at).map_or(0.0, |k| fit.x[k])
                };
                let found = pose.apply([target(0), target(1), target(2)]);
                square += (0..3).map(|k| (found[k] - wanted[k]).powi(2)).sum::<f64>() / places.len() as f64;
            }
        }
        // Some 30 unknowns, 60 times: a standard error of about 2 % of σ.
        let ratio = (square / runs as f64 / found.variance).sqrt();
        assert!((ratio - 1.0).abs() < 0.1, "{points}: {ratio}");
    }
}

/// Many at once, then one by one: hardly worse than one by one alone, from a list where both can be had; and better than chance.
#[test]
fn exchange_beats_an_even_spread() {
    let model = Model::ideal(&Puma, vec![[0.0; 3]], Uncertainty { length: 1e-4, angle: 1.0 });
    let model = model.with(model.constants(false));
    let list = sampled(&Puma, &[0, 1, 2, 3, 4, 5], 2001, 1);
    let known = identifiable(&model, &list, &vec![0.0; model.unknowns.len()]).unwrap();
    let used = model.tool_points(&list[..200]).unwrap();
    for criterion in [Criterion::Variance, Criterion::Determinant] {
        let objective = Objective { criterion, used: &used, model_error: 0.0 };
        let found = optimal(&model, &list, &known, 40, &objective, &mut |_, _| {}).unwrap().unwrap();
        assert!(found.chosen.len() == 40 && found.chosen.windows(2).all(|pair| pair[0] < pair[1]));
        let even: Vec<Observation> = (0..40).map(|i| list[50 * i].clone()).collect();
        let even = whole(&model, &even, &known, &objective).unwrap().unwrap();
        assert!(found.variance < 0.8 * even.variance, "{} {}", found.variance, even.variance);
        assert!(optimal(&model, &list, &known, 3, &objective, &mut |_, _| {}).unwrap().is_none());
        assert!(optimal(&model, &list[..9], &known, 10, &objective, &mut |_, _| {}).unwrap().is_none());
    }
}

/// What rows cannot tell, but moves the tool point where it is used, is named; what acts alike everywhere is not.
#[test]
fn what_a_list_cannot_see_is_named() {
    let model = Model::ideal(&Puma, vec![[0.0; 3]], Uncertainty { length: 1e-4, angle: 1.0 });
    let model = model.with(model.constants(false));
    let everywhere = sampled(&Puma, &[0, 1, 2, 3, 4, 5], 60, 1);
    let used = model.tool_points(&everywhere).unwrap();
    let zero = vec![0.0; model.unknowns.len()];
    let unseen = |list: &[Observation]| used.unseen(&identifiable(&model, list, &zero).unwrap(), |_| 1.0);
    assert_eq!(unseen(&everywhere), []);
    // The elbow is not moved: its error, at home a shift of what is behind it, is one that turns elsewhere.
    let still = sampled(&Puma, &[0, 1, 3, 4, 5], 60, 1);
    assert!(!unseen(&still).is_empty());
}
