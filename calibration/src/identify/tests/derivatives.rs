//! Analytic derivatives against finite differences of the exact chain.

use super::*;
use crate::by_hand::Pps;
use abbe_core::real_pose;
use abbe_core::{Component, Manipulator, Pose};

/// Compares analytic derivatives with central differences, far from ε = 0.
fn differences(model: &Model, row: &Observation) {
    let x = disturbed(model);
    let (_, rows) = residuals(model, row, &x);
    for k in 0..x.len() {
        let step = if x[k].abs() > 0.1 { 1e-3 } else { 1e-5 };
        let at = |sign: f64| {
            let mut x = x.clone();
            x[k] += sign * step;
            residuals(model, row, &x).0
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
    // A measured pose near the model's keeps the rotation vector away from half a turn.
    let near = pose.at(&vec![0.0; pose.unknowns.len()]).pose(&observation(&q, 0)).unwrap();
    differences(&pose, &Observation { measured: Measurement::Pose(Box::new(near)), ..observation(&q, 0) });
}

/// Derivatives are exact with a placement of the targets, and of the measured frame, at each
/// station.
#[test]
fn placements_belong_to_their_station() {
    let q = [900.0, 120.0, 300.0, 0.7, 0.04, -0.03];
    let stations = [0, 1].map(|placement| Station { placement, ..Station::at(Pose::IDENTITY) }).to_vec();
    let targets = vec![[100.0, 20.0, -30.0], [-80.0, 10.0, 50.0], [10.0, 90.0, 5.0], [0.0, 30.0, 60.0]];
    let mounted = real_pose(&[Pose::IDENTITY, Pose::IDENTITY], &[[50.0, -3.0, 80.0, 0.4, -0.9, 0.5]]);
    let model = Model { stations, mountings: vec![Pose::IDENTITY; 2], ..Model::ideal(&Pps, targets, EXACT) };
    let points = model.with(model.constants(false));
    let poses = Model { mountings: vec![Pose::IDENTITY, mounted], targets: Vec::new(), ..model };
    let poses = poses.with(poses.constants(true));
    for station in [0, 1] {
        let row = Observation { station, ..observation(&q, 2) };
        differences(&points, &row);
        let (_, rows) = residuals(&points, &row, &disturbed(&points));
        let is_seen = |unknown| {
            rows.iter().any(|row| row[points.unknowns.iter().position(|one| *one == unknown).unwrap()] != 0.0)
        };
        let seen = [0, 1, 2, 3].map(|target| is_seen(Unknown::Target(target, 0)));
        assert_eq!(seen, [station == 0, station == 0, station == 1, station == 1]);
        let near = poses.at(&vec![0.0; poses.unknowns.len()]).pose(&row).unwrap();
        differences(&poses, &Observation { measured: Measurement::Pose(Box::new(near)), ..row });
    }
}

const CAMERA_IN_ROOM: Camera = Camera {
    intrinsics: [800.0, 790.0, 320.0, 240.0, -0.02, 0.01, 1e-3, -2e-3, 0.003],
    image: [640.0, 480.0],
    is_known: false,
    is_on_tool: false,
};

/// Returns a model with all observables of every instrument.
fn every_instrument(robot: &dyn Manipulator) -> Model<'_> {
    let targets = vec![[100.0, 20.0, -30.0], [-80.0, 10.0, 50.0]];
    let fixture = |name: &str, geometry| Fixture { name: name.to_owned(), geometry };
    let fixtures = vec![
        fixture("bar", FixtureGeometry::Point([300.0, -200.0, 500.0])),
        fixture("plane", FixtureGeometry::Direction([0.3, -0.5, 0.2])),
    ];
    let observables = INSTRUMENTS.iter().enumerate().flat_map(|(instrument, kind)| {
        (0..kind.numbers).map(move |axis| Observable {
            name: format!("{}{axis}", kind.name),
            kind,
            instrument,
            axis,
            targets: if instrument % 2 == 0 { [1, 0] } else { [0, 1] },
            fixture: if kind.has("direction") { Some(1) } else { kind.has("at").then_some(0) },
            at: [800.0, -150.0, 300.0],
            mirror: [0.6, 0.0, 0.8],
            corner: [40.0, -25.0, 0.0],
            zero: 0.5,
            zero_known: false,
            uncertainty: 1.0,
        })
    });
    let base = Pose::IDENTITY
        .then(&real_pose(&[Pose::IDENTITY, Pose::IDENTITY], &[[500.0, -3.0, 800.0, 0.4, -1.9, 2.5]]));
    Model {
        observables: observables.collect(),
        fixtures,
        stations: vec![Station::at(base)],
        camera: Some(CAMERA_IN_ROOM),
        ..Model::ideal(robot, targets, EXACT)
    }
}

#[test]
fn derivatives_of_observables_are_exact() {
    let q = [900.0, 120.0, 300.0, 0.7, 0.04, -0.03];
    let model = every_instrument(&Pps);
    let sources = model.repeatable().into_iter().map(Unknown::Magnitude);
    let all = model.constants(false).into_iter().chain(sources);
    let model = model.with(all.chain(Component::ALL.map(|c| Unknown::Tool(0, c))).collect());
    let from = Some(Box::new(observation(&[700.0, 100.0, 350.0, -0.4, 0.02, 0.05], 0)));
    let count = model.observables.len();
    let measured = Measurement::Readings(vec![Some(0.0); count]);
    let row =
        Observation { measured, ..observation(&q, 1) }.approached(Approach { from, ..Approach::default() });
    differences(&model, &row);
    assert_eq!(row.count(), count);
    let mut readings = vec![None; count];
    (readings[1], readings[4]) = (Some(1.0), Some(2.0));
    let part = Observation { measured: Measurement::Readings(readings), ..row.clone() };
    let zero = vec![0.0; model.unknowns.len()];
    let (all, rows) = residuals(&model, &row, &zero);
    let (two, _) = residuals(&model, &part, &zero);
    assert_eq!(two.len(), 2);
    assert!((two[0] - all[1] + 1.0).abs() < 1e-12 && (two[1] - all[4] + 2.0).abs() < 1e-12);
    // An error of the base moves fixtures and machine alike.
    let base = model.unknowns.iter().enumerate().filter(|(_, unknown)| matches!(unknown, Unknown::Base(..)));
    for (k, _) in base {
        let moved = rows.iter().zip(&model.observables).filter(|(_, observable)| !observable.kind.sees_base);
        moved.for_each(|(row, _)| assert_eq!(row[k], 0.0));
    }
}

/// The pixels of a camera on the tool, and of one in the room: derivatives with respect to the
/// placement of both, the errors of the machine and the intrinsic parameters.
#[test]
fn derivatives_of_pixels_are_exact_on_tool_and_in_room() {
    let q = [900.0, 120.0, 300.0, 0.7, 0.04, -0.03];
    for is_on_tool in [true, false] {
        let model = every_instrument(&Pps);
        let observables: Vec<Observable> =
            model.observables.iter().filter(|one| one.kind.name == "camera").cloned().collect();
        assert_eq!(observables.len(), 2);
        let camera = Some(Camera { is_on_tool, ..CAMERA_IN_ROOM });
        let model = Model { observables, fixtures: Vec::new(), camera, ..model };
        let all = model.constants(true).into_iter();
        let model = model.with(all.chain(model.repeatable().into_iter().map(Unknown::Magnitude)).collect());
        assert_eq!(
            model.unknowns.iter().filter(|one| matches!(one, Unknown::Intrinsic(_))).count(),
            INTRINSICS
        );
        let measured = Measurement::Readings(vec![Some(300.0), Some(200.0)]);
        differences(&model, &Observation { measured, ..observation(&q, 1) });
    }
}

/// Readings that are blind to size count in proportion to a length of the machine: their
/// derivatives are exact, and a machine that is smaller by the same share everywhere fits no
/// better.
#[test]
fn blind_readings_are_relative_to_a_length() {
    let q = [900.0, 120.0, 300.0, 0.7, 0.04, -0.03];
    let mut model = every_instrument(&Pps);
    model.observables.retain(Observable::is_blind_to_size);
    assert_eq!(model.observables.len(), 3 + 1 + 1, "contact, plane, sphere");
    model.reference_length = Some(ReferenceLength { error: Unknown::Error(3, Component::Z), length: -730.0 });
    let model = model.with(model.constants(false));
    let count = model.observables.len();
    let row = Observation { measured: Measurement::Readings(vec![Some(0.0); count]), ..observation(&q, 1) };
    differences(&model, &row);
    let k = model.unknowns.iter().position(|one| *one == Unknown::Error(3, Component::Z)).unwrap();
    let mut x = vec![0.0; model.unknowns.len()];
    let (nominal, _) = residuals(&model, &row, &x);
    x[k] = -730.0;
    let absolute = Model { reference_length: None, ..model.clone() };
    let ((relative, _), (absolute, _)) = (residuals(&model, &row, &x), residuals(&absolute, &row, &x));
    assert!(nominal.iter().any(|residual| residual.abs() > 1.0));
    for (relative, absolute) in relative.iter().zip(&absolute) {
        assert!((relative - absolute / 2.0).abs() < 1e-12 * absolute.abs());
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
    let Pose(found) = model.at(&x).pose(&observation(&q, 1)).unwrap();
    for (found, expected) in found.as_flattened().iter().zip(expected.as_flattened()) {
        assert!((found - expected).abs() < 1e-10);
    }
}
