//! Tests of `drift.rs`.

use rand::{RngExt, SeedableRng};
use rand_xoshiro::Xoshiro256PlusPlus;

use super::{Drift, Timed, test_drift};
use crate::identify::{Measurement, Observation};

/// Returns rows of a machine with two joints, with the error as a function of time (0 to 1) and
/// joints.
fn rows(seed: u64, count: usize, visits: usize, error: impl Fn(f64, &[f64]) -> [f64; 3]) -> Option<Drift> {
    let mut random = Xoshiro256PlusPlus::seed_from_u64(seed);
    let places: Vec<[f64; 2]> =
        (0..count / visits).map(|_| [(); 2].map(|()| random.random_range(-1.0..1.0))).collect();
    let row = |i: usize| {
        let configuration = i % places.len();
        let row =
            Observation::new(i as u64, places[configuration], Vec::new(), Measurement::Points(vec![].into()));
        Observation { configuration: configuration as u32, ..row }
    };
    let rows: Vec<Observation> = (0..count).map(row).collect();
    let normal = rand_distr::Normal::new(0.0, 1.0).unwrap();
    let errors = rows
        .iter()
        .enumerate()
        .map(|(i, row)| error(i as f64 / count as f64, &row.q).map(|e| e + random.sample(normal)));
    let errors: Vec<[f64; 3]> = errors.collect();
    let errors = |take: &mut dyn FnMut([f64; 3])| {
        errors.iter().for_each(|error| take(*error));
        Ok(())
    };
    test_drift(&Timed { count, row: &|i| &rows[i], time: &|i| i as f64, errors: &errors }).unwrap()
}

/// Returns the drift test of noise of variance 1 in rows where one joint is nearly time.
fn along_a_path(seed: u64, count: usize) -> Drift {
    let mut random = Xoshiro256PlusPlus::seed_from_u64(seed);
    let normal = rand_distr::Normal::new(0.0, 1.0).unwrap();
    let row = |i: usize, shake: f64| {
        let time = i as f64 / count as f64;
        let q = vec![time + 0.01 * shake, shake];
        Observation::new(i as u64, q, Vec::new(), Measurement::Points(vec![].into()))
    };
    let rows: Vec<Observation> = (0..count).map(|i| row(i, random.random_range(-1.0..1.0))).collect();
    let errors: Vec<[f64; 3]> = rows.iter().map(|_| [(); 3].map(|()| random.sample(normal))).collect();
    let errors = |take: &mut dyn FnMut([f64; 3])| {
        errors.iter().for_each(|error| take(*error));
        Ok(())
    };
    let timed = Timed { count, row: &|i| &rows[i], time: &|i| i as f64, errors: &errors };
    test_drift(&timed).unwrap().unwrap()
}

/// 1 % of orders without drift raise an alarm: 3 ± 1.7 of 300.
#[test]
fn false_alarms_are_as_rare_as_stated() {
    for visits in [1, 5] {
        let alarms =
            |seed| rows(seed, 60, visits, |_, q| [3.0 * q[0], 0.0, 2.0 * q[1] * q[1]]).unwrap().p <= 0.01;
        let alarms = (0..300).filter(|seed| alarms(*seed)).count();
        assert!(alarms <= 8, "{visits}: {alarms} of 300");
    }
}

#[test]
fn warming_and_drifting_are_told() {
    let warming = rows(1, 300, 1, |t, _| [0.0, 3.0 * (-t / 0.1).exp(), 0.0]).unwrap();
    assert!(warming.p <= 0.01 && warming.follows == "y", "{warming:?}");
    assert!(warming.settling == Some(0.1) && (warming.change + 3.0).abs() < 1.2, "{warming:?}");
    let drifting = rows(2, 300, 10, |t, q| [5.0 * q[0], 0.0, 2.0 * t]).unwrap();
    assert!(drifting.p <= 0.01 && drifting.follows == "z", "{drifting:?}");
    assert!((drifting.change - 2.0).abs() < 0.8);
    assert!(rows(3, 15, 1, |_, _| [0.0; 3]).is_none());
}

/// A joint that follows time takes part of a drift: the change is that of the residuals, no
/// multiple of them by extrapolation along the joint.
#[test]
fn the_change_is_no_larger_than_the_residuals() {
    for seed in 0..20 {
        let drift = along_a_path(seed, 200);
        assert!(drift.change.abs() < 4.0, "{seed}: {drift:?}");
    }
}

/// A swing of variance 4.5 in noise of variance 1: neighbours correlate by about 0.8, reduced
/// by the regression on joints.
#[test]
fn neighbours_tell_what_no_line_and_no_settling_does() {
    let swinging = rows(4, 300, 1, |t, _| [3.0 * (6.0 * t).sin(); 3]).unwrap();
    assert!(swinging.lag_1 > 0.5 && swinging.p_of_lag_1 <= 0.01, "{swinging:?}");
    let still = rows(4, 300, 1, |_, _| [0.0; 3]).unwrap();
    assert!(still.lag_1.abs() < 0.2, "{still:?}");
}
