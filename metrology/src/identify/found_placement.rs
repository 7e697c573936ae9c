//! Identified placement of the machine and of what is mounted on its tool.

use abbe::analysis::sampling::vectors::unit;
use abbe::identify::{Fit, FixtureGeometry, INTRINSICS, Model, Observation, Station, Unknown};
use abbe::{Component, Pose};
use serde::Serialize;

use super::fitted::{
    fitted_fixture, fitted_intrinsics, fitted_mountings, fitted_stations, fitted_targets, fitted_zero,
};
use super::unread::read;

/// Identified placement of stations, tool and instruments.
#[derive(Clone, Debug, Default, Serialize)]
pub struct FoundPlacement {
    /// Poses of the machine, one per station.
    pub stations: Vec<FoundStation>,
    /// Positions of the targets in the tool frame, in the length unit; empty if whole poses were
    /// measured, or if each station has its own.
    pub targets: Vec<[f64; 3]>,
    /// Pose of the measured frame in the tool frame, as rows of a homogeneous matrix; none if
    /// points were measured, or if each station has its own.
    pub mounting: Option<[[f64; 4]; 4]>,
    /// Placements on the tool if each station has its own; absent otherwise.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub at_stations: Vec<PlacementAtStation>,
    /// Fixtures and zeros of the instruments.
    pub instruments: Vec<FoundInstrument>,
    /// Covariance of all coordinates of the targets, target by target, or of the six errors of the
    /// mounting, in products of the units; empty if each station has its own.
    pub covariance: Vec<Vec<f64>>,
    /// Is true if the map states the placement on the tool exactly.
    #[serde(skip)]
    pub(super) exact: bool,
}

/// Identified placement on the tool at one station.
#[derive(Clone, Debug, Serialize)]
pub struct PlacementAtStation {
    /// Name of the station.
    pub station: String,
    /// Positions of the targets in the tool frame, in the length unit; empty if whole poses were
    /// measured.
    pub targets: Vec<[f64; 3]>,
    /// Pose of the measured frame in the tool frame, as rows of a homogeneous matrix; none if
    /// points were measured.
    pub mounting: Option<[[f64; 4]; 4]>,
    /// Covariance of all coordinates of the targets, target by target, or of the six errors of the
    /// mounting, in products of the units.
    pub covariance: Vec<Vec<f64>>,
}

/// Identified fixture and zero of an instrument.
#[derive(Clone, Debug, Serialize)]
pub struct FoundInstrument {
    /// Name of the instrument.
    pub name: String,
    /// Position of its fixture in `F_0`, in the length unit; none if the fixture is a direction, or
    /// if there is none.
    pub position: Option<[f64; 3]>,
    /// Unit vector of its direction in `F_0`; none if the fixture is a point, or if there is none.
    pub direction: Option<[f64; 3]>,
    /// Offset of its readings, in the length unit or rad; for a sphere, minus its radius. None if
    /// it was known.
    pub zero: Option<f64>,
    /// Fitted intrinsic parameters `fx fy cx cy k1 k2 p1 p2 k3` of a camera, in pixels and 1; none
    /// if they were known.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub intrinsics: Option<[f64; 9]>,
    /// Is true if the readings are angles.
    pub is_angle: bool,
    /// Covariance of x, y, z of the position or of the two tilts of the direction, followed by the
    /// zero, or of the intrinsic parameters, in products of the units.
    pub covariance: Vec<Vec<f64>>,
}

/// Identified station.
#[derive(Clone, Debug, Serialize)]
pub struct FoundStation {
    /// Name; empty for the only station.
    pub name: String,
    /// Pose of `F_0` in the frame of the instrument, as rows of a homogeneous matrix.
    pub pose: [[f64; 4]; 4],
    /// Covariance of its six errors `e_x e_y e_z e_s e_r e_p` in the axes of `F_0`, in the length
    /// unit and rad.
    pub covariance: [[f64; 6]; 6],
}

impl FoundPlacement {
    /// Collects the placement from a fit of these rows. `pose` is true if whole poses were
    /// measured. Instruments that were never read are left out.
    pub(super) fn new(model: &Model, fit: &Fit, rows: &[Observation], pose: bool) -> Self {
        let read = read(model, rows);
        let among = |unknown: Unknown| {
            let k = model.unknowns.iter().position(|u| *u == unknown)?;
            fit.identifiable.kept.iter().position(|kept| *kept == k)
        };
        // Places that the rows do not show stay as stated.
        let stated = |unknown: Unknown| {
            let k = model.unknowns.iter().position(|one| *one == unknown)?;
            let acts_as_others = fit.identifiable.redundant.iter().any(|(other, _)| *other == k);
            fit.priors.get(k).copied().flatten().filter(|_| !acts_as_others)
        };
        let covariance = |a: Unknown, b: Unknown| match (among(a), among(b)) {
            (Some(a), Some(b)) => fit.covariance[(a, b)],
            (None, None) if a == b => stated(a).map_or(0.0, |deviation| deviation * deviation),
            _ => 0.0,
        };
        let rows = |pose: Pose| pose.rows().map(|row| row.map(|entry| entry + 0.0));
        let stations = fitted_stations(model, &fit.x).into_iter().enumerate().map(|(i, station)| {
            let base = |component| Unknown::Base(i, component);
            let of = |a| Component::ALL.map(|b| covariance(base(a), base(b)));
            FoundStation { name: station.name, pose: rows(station.pose), covariance: Component::ALL.map(of) }
        });
        let matrix = |unknowns: &[Unknown]| -> Vec<Vec<f64>> {
            let of = |a: &Unknown| unknowns.iter().map(|b| covariance(*a, *b)).collect();
            unknowns.iter().map(of).collect()
        };
        let (targets, mountings) = (fitted_targets(model, &fit.x), fitted_mountings(model, &fit.x));
        let placed = |i: usize, station: &str| {
            let own = model.targets_of(i);
            let unknowns: Vec<Unknown> = match pose {
                true => Component::ALL.map(|component| Unknown::Tool(i, component)).to_vec(),
                false => own.clone().flat_map(|j| [0, 1, 2].map(|axis| Unknown::Target(j, axis))).collect(),
            };
            PlacementAtStation {
                station: station.to_owned(),
                targets: if pose { Vec::new() } else { targets[own].to_vec() },
                mounting: pose.then(|| rows(mountings[i])),
                covariance: matrix(&unknowns),
            }
        };
        let instrument = |i: usize| {
            let reading = &model.observables[i];
            let place = reading.fixture.map(|fixture| (fixture, fitted_fixture(model, &fit.x, fixture)));
            let zero = (!reading.zero_known).then(|| fitted_zero(model, &fit.x, i));
            let of_place = place.iter().flat_map(|(fixture, place)| {
                (0..place.unknowns()).map(|coordinate| Unknown::Fixture(*fixture, coordinate))
            });
            let intrinsics = fitted_intrinsics(model, &fit.x);
            let of_camera = intrinsics.into_iter().flat_map(|_| (0..INTRINSICS).map(Unknown::Intrinsic));
            let unknowns = of_place.chain(zero.map(|_| Unknown::Zero(i))).chain(of_camera);
            let unknowns: Vec<Unknown> = unknowns.collect();
            let (position, direction) = match place {
                Some((_, FixtureGeometry::Point(point))) => (Some(point), None),
                Some((_, FixtureGeometry::Direction(direction))) => (None, Some(unit(direction))),
                None => (None, None),
            };
            FoundInstrument {
                name: reading.name.clone(),
                position,
                direction,
                zero,
                intrinsics,
                is_angle: reading.kind.is_angle,
                covariance: matrix(&unknowns),
            }
        };
        // First reading of every instrument with a fixture or with an unknown zero.
        let first = |i: &usize| {
            let reading = &model.observables[*i];
            let is_first = *i == 0 || model.observables[i - 1].instrument != reading.instrument;
            let is_fitted = model.camera.is_some_and(|camera| !camera.is_known);
            is_first && read[*i] && (reading.fixture.is_some() || !reading.zero_known || is_fitted)
        };
        let instruments = (0..model.observables.len()).filter(first).map(instrument).collect();
        let exact = !model.unknowns.iter().any(|unknown| unknown.is_tool());
        let found = Self { stations: stations.collect(), instruments, exact, ..Self::default() };
        if model.mountings.len() > 1 {
            let at = |station: &Station| placed(station.placement, &station.name);
            return Self { at_stations: model.stations.iter().map(at).collect(), ..found };
        }
        let PlacementAtStation { targets, mounting, covariance, .. } = placed(0, "");
        Self { targets, mounting, covariance, ..found }
    }

    /// Returns the placements on the tool: that of each station, or the common one.
    pub fn placements(&self) -> Vec<PlacementAtStation> {
        if !self.at_stations.is_empty() {
            return self.at_stations.clone();
        }
        let (targets, covariance) = (self.targets.clone(), self.covariance.clone());
        vec![PlacementAtStation { station: String::new(), targets, mounting: self.mounting, covariance }]
    }
}
