//! Whether the data are read as they were meant: units, signs, orders.

use std::collections::BTreeMap;

use abbe::identify::{Measurement, Model, Observation, Options, Station, Uncertainty, fit};
use abbe_spec::diagnostic::Diagnostics;

use super::reading::{Change, orders, orientations, units};
use super::setup::{Setup, registered, seen};
use crate::data::{Data, Map};
use crate::{mistake, number};

/// The most rows that are looked at; and at which combinations of changes are told apart.
pub(super) const ROWS: usize = 150;
const FEW: usize = 24;
/// The nominal machine misses no more of its arm: nobody has to ask.
const NEAR: f64 = 2e-3;
/// From here on combinations of changes are tried.
const FAR: f64 = 2e-2;
/// A combination of changes must come as near as this.
const LIKELY: f64 = 1e-2;
/// A reading that leaves more than this share of the spread of what was measured explains nothing.
const SHARE: f64 = 0.1;
/// How many combinations are fitted.
const FITTED: usize = 12;
/// The signs of no more joints are combined.
const SIGNS: usize = 8;

/// Refuses data that the nominal machine misses by far, if they would fit read otherwise. Returns by how much it misses, base
/// and tool fitted: the root mean square of a point; none if no fit is found.
pub(crate) fn check_readings(setup: &Setup, map: &Map, data: &Data) -> Result<Option<f64>, Diagnostics> {
    let rows = some(&data.observations, ROWS);
    let here = missed(setup, &rows);
    let rms = here.map(|here| here.rms);
    if rms.is_some_and(|rms| rms < NEAR * setup.arm) {
        return Ok(rms);
    }
    let Some((there, changes)) = better(setup, map, &rows, here) else { return Ok(rms) };
    let unit = setup.description.length;
    let there = number::length(there.rms, unit);
    let message = match rms {
        Some(here) => format!(
            "read as the map says, the machine misses these data by {} (root mean square), base and tool fitted; read \
             otherwise, by {there}",
            number::length(here, unit),
        ),
        None => format!(
            "read as the map says, no place of base and tool brings the machine near these data; read otherwise, it misses \
             them by {there} (root mean square)"
        ),
    };
    let questions = changes.iter().map(|change| change.question(setup)).collect::<Vec<_>>();
    Err(mistake::with_help(&data.file, message, questions.join("; ")))
}

/// The reading that fits best, if one fits far better than the map's: a single change, or else a combination of units,
/// reversed joints, swapped columns and orders of the orientation.
fn better(
    setup: &Setup,
    map: &Map,
    rows: &[Observation],
    here: Option<Missed>,
) -> Option<(Missed, Vec<Change>)> {
    let limit = here.map_or(SHARE, |here| SHARE.min(here.share / 5.0));
    let best = |readings: Vec<Vec<Change>>, far: f64| {
        let fitted = readings.into_iter().filter_map(|changes| {
            let there = missed(setup, &read(rows, &changes, setup, map))?;
            (there.share < limit && there.rms < far).then_some((there, changes))
        });
        // Of several that fit about as well the one with the fewest changes.
        let rank =
            |(there, changes): &(Missed, Vec<Change>)| there.share * (1.0 + 0.2 * size(changes) as f64);
        fitted.min_by(|a, b| rank(a).total_cmp(&rank(b)))
    };
    let reversed = (0..setup.description.variables.len()).map(|i| Change::Reversed(vec![i]));
    let singles =
        units(setup).into_iter().flatten().chain(reversed).chain(orders(setup)).chain(orientations(map));
    let single = best(singles.map(|change| vec![change]).collect(), f64::INFINITY);
    let is_near = |here: Missed| here.rms < FAR * setup.arm && here.share < SHARE;
    if single.as_ref().is_some_and(|(there, _)| there.rms < LIKELY * setup.arm) || here.is_some_and(is_near) {
        return single;
    }
    let combined = best(combinations(setup, map, rows), LIKELY * setup.arm);
    combined.or(single.filter(|_| here.is_some()))
}

/// Combinations of changes by which the machine comes nearest the positions, its tool where the map says; each with every
/// order of the orientation.
fn combinations(setup: &Setup, map: &Map, rows: &[Observation]) -> Vec<Vec<Change>> {
    let few = some(rows, FEW);
    let moved = setup.moved(rows);
    let signs = 1_usize << moved.len().min(SIGNS);
    let reversed = |signs: usize| {
        let joints: Vec<usize> =
            moved.iter().enumerate().filter(|(k, _)| signs >> k & 1 == 1).map(|(_, i)| *i).collect();
        (!joints.is_empty()).then_some(Change::Reversed(joints))
    };
    let others = units(setup).into_iter().chain(orders(setup).into_iter().map(|order| vec![order]));
    let all =
        others.flat_map(|others| (0..signs).map(move |signs| (others.clone(), signs)).collect::<Vec<_>>());
    let mut ranked = all
        .filter_map(|(mut changes, signs)| {
            changes.extend(reversed(signs));
            Some((aligned(setup, &read(&few, &changes, setup, map))?, changes))
        })
        .collect::<Vec<_>>();
    ranked.sort_by(|a, b| a.0.total_cmp(&b.0));
    ranked.truncate(FITTED);
    let orientations = orientations(map).into_iter().map(|change| vec![change]);
    let orientations: Vec<Vec<Change>> = std::iter::once(Vec::new()).chain(orientations).collect();
    let with = |(_, changes): (f64, Vec<Change>)| {
        orientations.iter().map(move |turned| [&changes[..], &turned[..]].concat()).collect::<Vec<_>>()
    };
    ranked.into_iter().flat_map(with).collect()
}

/// How many things are changed.
fn size(changes: &[Change]) -> usize {
    let one = |change: &Change| if let Change::Reversed(joints) = change { joints.len() } else { 1 };
    changes.iter().map(one).sum()
}

/// No more rows than these, from everywhere.
pub(super) fn some(rows: &[Observation], count: usize) -> Vec<Observation> {
    rows.iter().step_by(rows.len().div_ceil(count).max(1)).cloned().collect()
}

fn read(rows: &[Observation], changes: &[Change], setup: &Setup, map: &Map) -> Vec<Observation> {
    let read =
        |row: &Observation| changes.iter().fold(row.clone(), |row, change| change.apply(row, setup, map));
    rows.iter().map(read).collect()
}

/// By how much a machine misses what was measured.
#[derive(Clone, Copy)]
struct Missed {
    /// The root mean square of a point: the length unit.
    rms: f64,
    /// The same as a share of how far the points are spread: what a unit brings together to one point, any chain comes near.
    share: f64,
}

impl Missed {
    fn new(model: &Model, rows: &[Observation], x: &[f64]) -> Option<Self> {
        let rms = model.figures(rows, x).ok()?.rms;
        Some(Self { rms, share: rms / spread(model, rows) }).filter(|missed| missed.share.is_finite())
    }
}

/// How far the points that were measured are from their mean, those of each target and station: root mean square.
fn spread(model: &Model, rows: &[Observation]) -> f64 {
    let mut all: BTreeMap<(u32, Option<usize>), Vec<[f64; 3]>> = BTreeMap::new();
    for row in rows {
        seen(model, row, |target, point| all.entry((row.station, target)).or_default().push(point));
    }
    let about_mean = |points: &Vec<[f64; 3]>| {
        let square = |axis: usize| {
            let mean = points.iter().map(|point| point[axis]).sum::<f64>() / points.len() as f64;
            points.iter().map(|point| (point[axis] - mean).powi(2)).sum::<f64>()
        };
        square(0) + square(1) + square(2)
    };
    let count = all.values().map(Vec::len).sum::<usize>();
    (all.values().map(about_mean).sum::<f64>() / count as f64).sqrt()
}

/// How far the nominal machine is from the points that were measured, its stations in closed form: as a share of their spread.
fn aligned(setup: &Setup, rows: &[Observation]) -> Option<f64> {
    let mut model = setup.ideal.clone();
    for i in 0..model.stations.len() {
        model.stations[i].pose = registered(&model, rows, i).ok()??;
    }
    Missed::new(&model, rows, &[]).map(|missed| missed.share)
}

/// By how much the nominal machine misses, base and tool fitted. None if no fit is found.
fn missed(setup: &Setup, rows: &[Observation]) -> Option<Missed> {
    // Poses as four points: one number says how well position and orientation fit.
    let reach = setup.arm / 4.0;
    let corners = [[0.0; 3], [reach, 0.0, 0.0], [0.0, reach, 0.0], [0.0, 0.0, reach]];
    let points = |row: &Observation| match &row.measured {
        Measurement::Pose(pose) => {
            let measured =
                Measurement::Points(corners.iter().map(|corner| Some(pose.apply(*corner))).collect());
            Observation { measured, ..row.clone() }
        }
        Measurement::Points(_) | Measurement::Readings(_) => row.clone(),
    };
    let rows: Vec<Observation> = rows.iter().map(points).collect();
    let mut model = Model { uncertainty: Uncertainty { length: 1.0, angle: 1.0 }, ..setup.ideal.clone() };
    if setup.pose {
        model.targets = corners.to_vec();
    }
    for i in 0..model.stations.len() {
        // Of few rows at a station nothing is told.
        let pose = registered(&model, &rows, i).ok()??;
        model.stations[i] = Station { pose, exact: false, ..model.stations[i].clone() };
    }
    let model = model.with(model.base_and_tool(false));
    let found = fit(&model, &rows, &Options::default()).ok()?;
    Missed::new(&model, &rows, &found.x)
}
