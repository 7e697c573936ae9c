//! Derivatives against differences of the exact chain.

use super::*;
use crate::by_hand::Pps;
use abbe_core::real_pose;
use abbe_core::{Component, Manipulator, Pose};

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
    differences(&pose, &Observation { measured: Measurement::Pose(Box::new(near)), ..observation(&q, 0) });
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
        Gauge::Moved { target: 1 },
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
    let from = Some(Box::new(observation(&[700.0, 100.0, 350.0, -0.4, 0.02, 0.05], 0)));
    let measured = Measurement::Readings(vec![Some(0.0); 7]);
    let seen =
        Observation { measured, ..observation(&q, 1) }.approached(Approach { from, ..Approach::default() });
    differences(&model, &seen);
    assert_eq!(seen.count(), 7);
    let hidden = Measurement::Readings(vec![None, Some(1.0), None, None, Some(2.0), None, None]);
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
