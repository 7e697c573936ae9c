//! Placement and instruments at the solution of a fit: nominal values with their unknowns.

use abbe::identify::{FixtureGeometry, INTRINSICS, Model, Station, Unknown};
use abbe::{Component, Pose, real_pose};

/// Returns the stations of a model with their identified poses.
pub(super) fn fitted_stations(model: &Model, x: &[f64]) -> Vec<Station> {
    let mut stations = model.stations.clone();
    for (i, station) in stations.iter_mut().enumerate() {
        let of = |component| Unknown::Base(i, component);
        station.pose = station.pose.then(&error_pose(model, x, of));
    }
    stations
}

/// Returns the identified place of a fixture.
pub(super) fn fitted_fixture(model: &Model, x: &[f64], fixture: usize) -> FixtureGeometry {
    let by = |coordinate| value(model, x, Unknown::Fixture(fixture, coordinate));
    model.fixtures[fixture].geometry.displaced(&[by(0), by(1), by(2)])
}

/// Returns the identified zero of a reading.
pub(super) fn fitted_zero(model: &Model, x: &[f64], reading: usize) -> f64 {
    model.observables[reading].zero + value(model, x, Unknown::Zero(reading))
}

/// Returns the identified intrinsic parameters of the camera, if it has unknown ones.
pub(super) fn fitted_intrinsics(model: &Model, x: &[f64]) -> Option<[f64; INTRINSICS]> {
    let camera = model.camera.filter(|camera| !camera.is_known)?;
    Some(std::array::from_fn(|i| camera.intrinsics[i] + value(model, x, Unknown::Intrinsic(i))))
}

/// Returns the identified positions of the targets in the frame of the tool.
pub(super) fn fitted_targets(model: &Model, x: &[f64]) -> Vec<[f64; 3]> {
    let targets = model.targets.iter().enumerate();
    targets
        .map(|(j, target)| {
            std::array::from_fn(|axis| target[axis] + value(model, x, Unknown::Target(j, axis)))
        })
        .collect()
}

/// Returns the identified transform from the measured frame to that of the tool of each placement.
pub(super) fn fitted_mountings(model: &Model, x: &[f64]) -> Vec<Pose> {
    let mountings = model.mountings.iter().enumerate();
    mountings
        .map(|(i, mounting)| mounting.then(&error_pose(model, x, |component| Unknown::Tool(i, component))))
        .collect()
}

/// Returns the value of an unknown; 0 if the model does not have it.
fn value(model: &Model, x: &[f64], unknown: Unknown) -> f64 {
    model.unknowns.iter().position(|one| *one == unknown).map_or(0.0, |k| x[k])
}

/// Returns the rigid motion given by six unknown errors.
fn error_pose(model: &Model, x: &[f64], of: impl Fn(Component) -> Unknown) -> Pose {
    let errors = Component::ALL.map(|component| value(model, x, of(component)));
    real_pose(&[Pose::IDENTITY, Pose::IDENTITY], &[errors])
}
