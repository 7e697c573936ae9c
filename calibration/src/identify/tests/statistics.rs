//! Coverage, outliers and independence of the number of threads, over many machines.

use rand::{RngExt, SeedableRng};
use rand_xoshiro::Xoshiro256PlusPlus;

use super::*;
use crate::by_hand::Pps;

/// Returns the paper's two sets with two payloads: 450 rows.
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

/// The errors of 200 machines are found to within their standard deviations.
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
        // All 36 errors are nonzero; the kept ones take on their equivalents.
        let mut expected = truth.clone();
        for (k, act_as) in &found.identifiable.redundant {
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

/// A subset provides the start for this many rows.
#[test]
fn gross_errors_among_many_rows_are_named() {
    let model = Model::ideal(&Pps, vec![[0.0; 3]], Uncertainty { length: 0.04, angle: 1.0 });
    let model = model.with(model.constants(false));
    let mut random = Xoshiro256PlusPlus::seed_from_u64(5);
    let list = sampled(&Pps, &[0, 1, 2, 3, 4, 5], 9000, 1);
    let truth: Vec<f64> = disturbed(&model).iter().map(|x| x * 0.05).collect();
    let mut data = measured(&model, &truth, &list, 0.04, &mut random);
    let wrong: Vec<u64> = data.iter().map(|row| row.line).filter(|line| line % 30 == 7).collect();
    for row in data.iter_mut().filter(|row| wrong.contains(&row.line)) {
        let Measurement::Points(points) = &mut row.measured else { unreachable!() };
        points[0].as_mut().unwrap()[2] -= 3.0;
    }
    let options = Options { loss: Loss::Tukey, priors: model.priors(0.01).unwrap(), ..Options::default() };
    let found = fit(&model, &data, &options).unwrap();
    assert!(found.rejected(&data).map(|row| row.line).eq(wrong));
    assert!((0.97..1.03).contains(&found.sigma), "{}", found.sigma);
}

/// More rows than one block, with outliers: on one thread, two and five.
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
            let crossed = cross_validate(&richer, &data, &found, &Folds::new(&data, 10)).unwrap();
            (richer.figures(&data, &found.x).unwrap(), found, crossed)
        })
    };
    for loss in [Loss::Squares, Loss::Tukey] {
        let alone = on(1, loss);
        assert!([2, 5].iter().all(|threads| on(*threads, loss) == alone));
    }
}
