//! Where the machine stands and what is mounted on its tool, as found: beside the machine, not in it.

use abbe::identify::{Fit, Model, Place, Unknown};
use abbe::{Component, Pose};
use serde::Serialize;

use super::setup::{displaced, found_place, found_stations, found_zero};

/// What was found of stations and tool.
#[derive(Clone, Debug, Default, Serialize)]
pub struct Placed {
    /// Where the machine stands.
    pub stations: Vec<PlacedStation>,
    /// Where the targets are in the frame of the tool; none where whole poses were measured.
    pub targets: Vec<[f64; 3]>,
    /// From the frame that is seen to that of the tool, as rows of a homogeneous matrix, where whole poses were measured.
    pub mounting: Option<[[f64; 4]; 4]>,
    /// What the instruments look at, and their zeros.
    pub instruments: Vec<PlacedInstrument>,
    /// Covariance of all coordinates of the targets, or of the six errors of the mounting.
    pub covariance: Vec<Vec<f64>>,
    /// Whether nothing of it was unknown.
    #[serde(skip)]
    pub(super) exact: bool,
}

/// What an instrument looks at, as found.
#[derive(Clone, Debug, Serialize)]
pub struct PlacedInstrument {
    /// What the instrument is called.
    pub name: String,
    /// Where the point is that it looks at, in `F_0`; none if it is a direction, or nothing.
    pub position: Option<[f64; 3]>,
    /// Where it points, in `F_0`, of length 1.
    pub direction: Option<[f64; 3]>,
    /// What it reads more than it is: the length unit, or rad; of a sphere minus its radius. None if it was known.
    pub zero: Option<f64>,
    /// Whether that is an angle.
    pub is_angle: bool,
    /// Covariance of x, y, z of the position or of the two tilts of the direction, and of the zero.
    pub covariance: Vec<Vec<f64>>,
}

/// A station that was found.
#[derive(Clone, Debug, Serialize)]
pub struct PlacedStation {
    /// What it is called; empty if it is the only one.
    pub name: String,
    /// From `F_0` to the frame of the instrument: rows of a homogeneous matrix.
    pub pose: [[f64; 4]; 4],
    /// Covariance of its six errors `e_x e_y e_z e_s e_r e_p`, in the axes of `F_0`: length unit and rad.
    pub covariance: [[f64; 6]; 6],
}

impl Placed {
    /// What a fit found.
    pub(super) fn new(model: &Model, fit: &Fit, pose: bool) -> Self {
        let among = |unknown: Unknown| {
            let k = model.unknowns.iter().position(|u| *u == unknown)?;
            fit.identifiable.kept.iter().position(|kept| *kept == k)
        };
        let covariance = |a: Unknown, b: Unknown| match (among(a), among(b)) {
            (Some(a), Some(b)) => fit.covariance[(a, b)],
            _ => 0.0,
        };
        let rows = |pose: Pose| pose.rows().map(|row| row.map(|entry| entry + 0.0));
        let stations = found_stations(model, &fit.x).into_iter().enumerate().map(|(i, station)| {
            let base = |component| Unknown::Base(i, component);
            let of = |a| Component::ALL.map(|b| covariance(base(a), base(b)));
            PlacedStation { name: station.name, pose: rows(station.pose), covariance: Component::ALL.map(of) }
        });
        let value =
            |unknown: Unknown| model.unknowns.iter().position(|u| *u == unknown).map_or(0.0, |k| fit.x[k]);
        let targets = model.targets.iter().enumerate();
        let targets: Vec<[f64; 3]> = targets
            .map(|(j, target)| std::array::from_fn(|axis| target[axis] + value(Unknown::Target(j, axis))))
            .collect();
        let unknowns: Vec<Unknown> = match pose {
            true => Component::ALL.map(Unknown::Tool).to_vec(),
            false => {
                (0..targets.len()).flat_map(|j| [0, 1, 2].map(|axis| Unknown::Target(j, axis))).collect()
            }
        };
        let matrix = |unknowns: &[Unknown]| -> Vec<Vec<f64>> {
            let of = |a: &Unknown| unknowns.iter().map(|b| covariance(*a, *b)).collect();
            unknowns.iter().map(of).collect()
        };
        let instrument = |i: usize| {
            let reading = &model.readings[i];
            let place = reading.gauge.fixture().map(|fixture| (fixture, found_place(model, &fit.x, fixture)));
            let zero = (!reading.zero_known).then(|| found_zero(model, &fit.x, i));
            let of_place = place.iter().flat_map(|(fixture, place)| {
                (0..place.unknowns()).map(|coordinate| Unknown::Fixture(*fixture, coordinate))
            });
            let unknowns: Vec<Unknown> = of_place.chain(zero.map(|_| Unknown::Zero(i))).collect();
            let (position, direction) = match place {
                Some((_, Place::Point(point))) => (Some(point), None),
                Some((_, Place::Direction(direction))) => (None, Some(unit(direction))),
                None => (None, None),
            };
            PlacedInstrument {
                name: reading.name.clone(),
                position,
                direction,
                zero,
                is_angle: reading.gauge.is_angle(),
                covariance: matrix(&unknowns),
            }
        };
        // The first reading of every instrument that looks at something, or has a zero to find.
        let first = |i: &usize| {
            let reading = &model.readings[*i];
            let is_first = *i == 0 || model.readings[i - 1].instrument != reading.instrument;
            is_first && (reading.gauge.fixture().is_some() || !reading.zero_known)
        };
        Self {
            stations: stations.collect(),
            covariance: matrix(&unknowns),
            instruments: (0..model.readings.len()).filter(first).map(instrument).collect(),
            exact: !model.unknowns.iter().any(|unknown| unknown.is_tool()),
            mounting: pose.then(|| rows(model.mounting.then(&displaced(model, &fit.x, Unknown::Tool)))),
            targets: if pose { Vec::new() } else { targets },
        }
    }
}

fn unit(v: [f64; 3]) -> [f64; 3] {
    let length = v.iter().map(|x| x * x).sum::<f64>().sqrt();
    v.map(|x| x / length)
}
