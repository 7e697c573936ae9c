//! Whether the data are read as they were meant: units, signs, orders.

use abbe::identify::{Measurement, Model, Observation, Options, Station, Uncertainty, fit};
use abbe_codegen::diagnostic::Diagnostics;

use super::reading::{Change, orders, orientations, units};
use super::setup::{Setup, registered};
use crate::data::{Data, Map};
use crate::{mistake, number};

/// The most rows that are looked at; and at which combinations of changes are told apart.
const ROWS: usize = 150;
const FEW: usize = 24;
/// The nominal machine misses no more of its arm: nobody has to ask.
const NEAR: f64 = 2e-3;
/// From here on combinations of changes are tried.
const FAR: f64 = 2e-2;
/// A combination of changes must come as near as this.
const LIKELY: f64 = 1e-2;
/// How many combinations are fitted.
const FITTED: usize = 12;
/// The signs of no more joints are combined.
const SIGNS: usize = 8;

/// Refuses data that the nominal machine misses by far, if they would fit read otherwise. Returns by how much it misses, base
/// and tool fitted: the root mean square of a point; none if no fit is found.
pub(crate) fn check_readings(setup: &Setup, map: &Map, data: &Data) -> Result<Option<f64>, Diagnostics> {
    let rows = some(&data.observations, ROWS);
    let here = missed(setup, &rows);
    if here.is_some_and(|here| here < NEAR * setup.arm) {
        return Ok(here);
    }
    let Some((there, changes)) = better(setup, map, &rows, here.unwrap_or(f64::INFINITY)) else {
        return Ok(here);
    };
    let unit = setup.description.length;
    let there = number::length(there, unit);
    let message = match here {
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
fn better(setup: &Setup, map: &Map, rows: &[Observation], here: f64) -> Option<(f64, Vec<Change>)> {
    let best = |readings: Vec<Vec<Change>>, limit: f64| {
        let fitted = readings.into_iter().filter_map(|changes| {
            let there = missed(setup, &read(rows, &changes, setup, map))?;
            (there < limit).then_some((there, changes))
        });
        // Of several that fit about as well the one with the fewest changes.
        let rank = |(there, changes): &(f64, Vec<Change>)| there * (1.0 + 0.2 * size(changes) as f64);
        fitted.min_by(|a, b| rank(a).total_cmp(&rank(b)))
    };
    let reversed = (0..setup.description.variables.len()).map(|i| Change::Reversed(vec![i]));
    let singles =
        units(setup).into_iter().flatten().chain(reversed).chain(orders(setup)).chain(orientations(map));
    let single = best(singles.map(|change| vec![change]).collect(), here / 5.0);
    if single.as_ref().is_some_and(|(there, _)| *there < LIKELY * setup.arm) || here < FAR * setup.arm {
        return single;
    }
    let combined = best(combinations(setup, map, rows), (here / 5.0).min(LIKELY * setup.arm));
    combined.or(single.filter(|_| here.is_finite()))
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
fn some(rows: &[Observation], count: usize) -> Vec<Observation> {
    rows.iter().step_by(rows.len().div_ceil(count).max(1)).cloned().collect()
}

fn read(rows: &[Observation], changes: &[Change], setup: &Setup, map: &Map) -> Vec<Observation> {
    let read =
        |row: &Observation| changes.iter().fold(row.clone(), |row, change| change.apply(row, setup, map));
    rows.iter().map(read).collect()
}

/// By how much the nominal machine misses the points that were measured, its stations in closed form: root mean square.
fn aligned(setup: &Setup, rows: &[Observation]) -> Option<f64> {
    let mut model = setup.ideal.clone();
    for i in 0..model.stations.len() {
        model.stations[i].pose = registered(&model, rows, i).ok()??;
    }
    model.figures(rows, &[]).ok().map(|figures| figures.rms)
}

/// By how much the nominal machine misses, base and tool fitted: root mean square of a point. None if no fit is found.
fn missed(setup: &Setup, rows: &[Observation]) -> Option<f64> {
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
    model.figures(&rows, &found.x).ok().map(|figures| figures.rms)
}
