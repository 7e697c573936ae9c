//! Are the data read as they are meant? The [search](crate::interpretations) for other units, signs, orders and formats than the map
//! states, base and tool fitted.

use std::cmp::Reverse;
use std::collections::BTreeMap;

use abbe::identify::{Measurement, Model, Observation, Options, Station, Uncertainty, fit};
use abbe::{Error, Pose, VariableKind};
use abbe_spec::diagnostic::Diagnostics;

use super::setup::{Setup, registered, seen};
use super::stated::Stated;
use crate::data::{Data, Map};
use crate::interpretations::{
    Chain, Change, Interpretation, MOST, Observed, Parts, Ranked, Search, Tolerance, Trial, ranked, words,
};
use crate::{mistake, number};

/// The largest number of rows that are fitted, and that are searched.
pub(super) const ROWS: usize = 150;
const SEARCHED: usize = 40;
/// A share of the arm up to which the nominal machine is near the data, and they are read as they are meant.
const NEAR: f64 = 2e-3;
/// A share of the arm from which on several joints are changed at once.
const FAR: f64 = 2e-2;
/// A share of the arm up to which an interpretation with several differences is likely.
const LIKELY: f64 = 1e-2;
/// A share of the spread of the points at which the search ends.
const ENOUGH: f64 = 0.02;
/// Another interpretation must be better by this factor.
const BETTER: f64 = 5.0;
/// The largest number of joints whose signs are combined.
const SIGNS: usize = 8;

/// Refuses data that the nominal machine misses by far, if another interpretation fits. Returns by how much it misses, base and tool
/// fitted: the root mean square of a point; none if no fit is found.
pub(crate) fn check_interpretation(
    setup: &Setup,
    map: &Map,
    data: &Data,
) -> Result<Option<f64>, Diagnostics> {
    let rows = some(&data.observations, ROWS);
    let here = Miss::fitted(setup, &rows);
    let rms = here.map(|here| here.rms);
    if rms.is_some_and(|rms| rms < NEAR * setup.arm) {
        return Ok(rms);
    }
    let Some((there, questions)) = better(setup, map, &rows, here) else { return Ok(rms) };
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
    Err(mistake::with_help(&data.file, message, questions.join("; ")))
}

/// The interpretation with the fewest differences among those that fit far better than the map's, as questions.
fn better(setup: &Setup, map: &Map, rows: &[Observation], here: Option<Miss>) -> Option<(Miss, Vec<String>)> {
    let share = here.map_or(MOST, |here| MOST.min(here.share / BETTER));
    let tolerance = Tolerance { within: None, share, enough: (ENOUGH / share).min(1.0) };
    let stated = Stated::new(setup, map)?;
    let searched = searched(setup, rows);
    let joints: Vec<Vec<f64>> = searched.iter().map(|(row, _)| stated.joints(&row.q)).collect();
    let numbers: Vec<Vec<f64>> = searched.iter().map(|(_, pose)| stated.numbers(pose)).collect();
    let (metres, chain) = (setup.description.length.in_metres(), Nominal::new(&setup.ideal));
    let observed = Observed::all(&numbers, &stated.layouts(), &stated.lengths(), &stated.changes(), metres);
    let search = Search::new(&chain, &joints, &stated.travels(), observed, tolerance);
    let is_near = here.is_some_and(|here| here.rms < FAR * setup.arm && here.share < MOST);
    let stages = if is_near { 1 } else { 2 };
    let candidates = search.run(stages_of(setup, rows).take(stages), &mut ()).ok()?;
    let Ranked { found, .. } = ranked(candidates, &tolerance, Some(&stated.interpretation));
    let names: Vec<&str> = setup.description.variables.iter().map(|variable| &*variable.name).collect();
    let judged = |found: &Interpretation| {
        let questions = words::questions(found, &stated.interpretation, &names);
        let most = if questions.len() > 1 { LIKELY * setup.arm } else { f64::INFINITY };
        let rows: Vec<Observation> = rows.iter().map(|row| stated.reread(row, found)).collect();
        let there = Miss::fitted(setup, &rows)?;
        (!questions.is_empty() && there.share < share && there.rms < most).then_some((there, questions))
    };
    found.first().and_then(|first| judged(&first.interpretation))
}

/// Rows with a pose or the point of one target, all from one station: the target and the station of which there are most.
fn searched<'r>(setup: &Setup, rows: &'r [Observation]) -> Vec<(&'r Observation, Pose)> {
    type Seen<'r> = Vec<(&'r Observation, Pose)>;
    let mut groups: BTreeMap<(u32, Option<usize>), Seen<'_>> = BTreeMap::new();
    for row in rows {
        seen(&setup.ideal, row, |target, point| {
            let pose = match &row.measured {
                Measurement::Pose(pose) => **pose,
                _ => {
                    let [x, y, z, _] = Pose::IDENTITY.0;
                    Pose([x, y, z, point])
                }
            };
            groups.entry((row.station, target)).or_default().push((row, pose));
        });
    }
    let largest = groups.into_values().min_by_key(|group| Reverse(group.len()));
    some(&largest.unwrap_or_default(), SEARCHED)
}

/// Signs and exchanged columns of joints: one at a time, then all signs, and each with two columns exchanged.
fn stages_of(setup: &Setup, rows: &[Observation]) -> impl Iterator<Item = Vec<Trial>> {
    let variables = &setup.description.variables;
    let (count, moved) = (variables.len(), setup.moved(rows));
    let pairs = (0..count).flat_map(|j| (0..j).map(move |i| (i, j)));
    let alike = pairs.filter(|(i, j)| variables[*i].kind == variables[*j].kind);
    let exchanged: Vec<Vec<Change>> =
        std::iter::once(vec![]).chain(alike.map(|(i, j)| vec![Change::exchanged(i, j, count)])).collect();
    let trial = |joints: Vec<Change>| Trial {
        joints,
        ends: vec![vec![Change::BaseElsewhere, Change::ToolElsewhere]],
    };
    let one = exchanged.iter().cloned().chain((0..count).map(|i| vec![Change::Reversed(vec![i])]));
    let one = one.map(trial).collect();
    let reversed = move |signs: usize| {
        let joints = moved.iter().enumerate().filter(|(k, _)| signs >> k & 1 == 1);
        Change::Reversed(joints.map(|(_, i)| *i).collect())
    };
    let signs = 1..1_usize << setup.moved(rows).len().min(SIGNS);
    let several = move || {
        let all = signs.flat_map(|signs| {
            let reversed = reversed(signs);
            exchanged
                .iter()
                .map(move |order| [&order[..], std::slice::from_ref(&reversed)].concat())
                .collect::<Vec<_>>()
        });
        all.map(trial).collect()
    };
    std::iter::once(one).chain(std::iter::once_with(several))
}

/// The ideal machine with the tool of the spec.
struct Nominal<'a> {
    model: &'a Model<'a>,
    kinds: Vec<VariableKind>,
}

impl<'a> Nominal<'a> {
    fn new(model: &'a Model<'a>) -> Self {
        let variables = &model.manipulator.description().variables;
        Self { model, kinds: variables.iter().map(|variable| variable.kind).collect() }
    }
}

impl Chain for Nominal<'_> {
    fn kinds(&self) -> &[VariableKind] {
        &self.kinds
    }

    fn metres(&self) -> f64 {
        self.model.manipulator.description().length.in_metres()
    }

    fn parts(&self, q: &[f64], _: bool) -> Result<Parts, Error> {
        Ok([Pose::IDENTITY, self.model.manipulator.pose(q, &self.model.s)?, self.model.mounting])
    }
}

/// At most so many, at equal distances.
pub(super) fn some<T: Clone>(all: &[T], count: usize) -> Vec<T> {
    all.iter().step_by(all.len().div_ceil(count).max(1)).cloned().collect()
}

/// By how much a machine misses what was measured.
#[derive(Clone, Copy)]
struct Miss {
    /// The root mean square of a point: the length unit.
    rms: f64,
    /// The same as a share of how far the points are spread: what a unit brings together to one point, any chain comes near.
    share: f64,
}

impl Miss {
    fn new(model: &Model, rows: &[Observation], x: &[f64]) -> Option<Self> {
        let rms = model.figures(rows, x).ok()?.rms;
        Some(Self { rms, share: rms / spread(model, rows) }).filter(|missed| missed.share.is_finite())
    }

    /// Fits base and tool of the nominal machine. None if no fit is found.
    fn fitted(setup: &Setup, rows: &[Observation]) -> Option<Self> {
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
            // Too few rows at a station determine nothing.
            let pose = registered(&model, &rows, i).ok()??;
            model.stations[i] = Station { pose, exact: false, ..model.stations[i].clone() };
        }
        let model = model.with(model.base_and_tool(false));
        let found = fit(&model, &rows, &Options::default()).ok()?;
        Self::new(&model, &rows, &found.x)
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
