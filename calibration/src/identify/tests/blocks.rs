//! Uncertainty of a fit to rows whose neighbours share errors.

use rand::{RngExt, SeedableRng};
use rand_distr::Normal;
use rand_xoshiro::Xoshiro256PlusPlus;

use super::*;
use crate::by_hand::Puma;

/// Noise of a coordinate, in m.
const NOISE: f64 = 3e-5;

/// Number of rows, and of neighbours that share an error.
const ROWS: usize = 160;
const NEIGHBOURS: usize = 20;

/// Simulates rows of a machine whose neighbours share an error of `shared` times the noise. Returns
/// the errors of all kept unknowns in standard deviations of independent rows and in those between
/// runs of rows, with the latter.
fn machine(shared: f64, seed: u64) -> ([Vec<f64>; 2], BetweenBlocks) {
    let mut random = Xoshiro256PlusPlus::seed_from_u64(seed);
    let normal = Normal::new(0.0, 1.0).unwrap();
    let uncertainty = Uncertainty { length: NOISE, angle: 1.0 };
    let model = Model::ideal(&Puma, vec![[0.06, 0.02, 0.05]], uncertainty);
    let station = Station { exact: true, ..Station::at(Pose::IDENTITY) };
    let model = Model { stations: vec![station], ..model };
    let errors = model.constants(false).into_iter().filter(|unknown| matches!(unknown, Unknown::Error(..)));
    let model = model.with(errors.collect());
    let mut list = sampled(&Puma, &[0, 1, 2, 3, 4, 5], ROWS, 1);
    list.sort_by(|a, b| a.q[0].total_cmp(&b.q[0]));
    let truth: Vec<f64> = model.unknowns.iter().map(|_| 3e-4 * random.sample(normal)).collect();
    let mut data = measured(&model, &truth, &list, NOISE, &mut random);
    for rows in data.chunks_mut(NEIGHBOURS) {
        let shift = [0; 3].map(|_| shared * NOISE * random.sample(normal));
        for row in rows {
            let Measurement::Points(points) = &mut row.measured else { continue };
            let moved = points.iter().map(|point| point.map(|at| std::array::from_fn(|i| at[i] + shift[i])));
            row.measured = Measurement::Points(moved.collect());
        }
    }
    let found = fit(&model, &data, &Options::default()).unwrap();
    let between = between_blocks(&model, &data, &found, &Folds::by_order(&data, 8)).unwrap().unwrap();
    // The kept unknowns stand for those that act like them.
    let kept = &found.identifiable.kept;
    let mut stands_for = vec![0.0; kept.len()];
    for (k, value) in truth.iter().enumerate() {
        let coordinates = found.identifiable.kept_coordinates(k);
        stands_for.iter_mut().zip(coordinates).for_each(|(sum, factor)| *sum += factor * value);
    }
    let z = |covariance: &nalgebra::DMatrix<f64>| -> Vec<f64> {
        let one = |(i, k): (usize, &usize)| (found.x[*k] - stands_for[i]) / covariance[(i, i)].sqrt();
        kept.iter().enumerate().map(one).collect()
    };
    ([z(&found.covariance), z(&between.covariance)], between)
}

fn rms(values: &[f64]) -> f64 {
    (values.iter().map(|value| value * value).sum::<f64>() / values.len() as f64).sqrt()
}

/// Checks that unknowns are as far from the truth as the variance between runs of rows says where
/// neighbours share an error, and that independent rows are called dependent in 1 % of the cases.
#[test]
fn neighbours_that_share_errors_make_fits_less_certain() {
    let count = 40;
    let all = |shared: f64| -> Vec<_> { (0..count).map(|seed| machine(shared, seed)).collect() };
    let square = |found: &[([Vec<f64>; 2], BetweenBlocks)]| {
        found.iter().map(|(_, between)| between.factor.powi(2)).sum::<f64>() / found.len() as f64
    };
    let independent = all(0.0);
    let called = independent.iter().filter(|(_, between)| between.p < 0.01).count();
    println!("independent: square of the factor {:.3}, {called} of {count} called", square(&independent));
    assert!((0.9..1.1).contains(&square(&independent)) && called <= 2);
    let dependent = all(1.5);
    let [alone, between] =
        [0, 1].map(|i| rms(&dependent.iter().flat_map(|(z, _)| z[i].iter().copied()).collect::<Vec<_>>()));
    println!(
        "dependent: z {alone:.2} of independent rows, {between:.2} between runs, {:.2}",
        square(&dependent)
    );
    assert!(alone > 1.4 && (0.75..1.25).contains(&between), "{alone} {between}");
    assert!(dependent.iter().all(|(_, between)| between.p < 0.01));
}
