//! Tests the interpretation of the data. The [search](crate::interpretations) tries other units,
//! signs, column orders and formats than the map states, with base and tool fitted.

use std::{cmp::Reverse, collections::BTreeMap};

use abbe::identify::{Measurement, Model, Observation, Options, Station, Uncertainty, fit};
use abbe::{Error, Pose, VariableKind};

use super::map_interpretation::MapInterpretation;
use super::reading_units::check_reading_units;
use super::registered::{for_each_point, registered};
use super::setup::Setup;
use crate::data::{Data, Map};
use crate::interpretations::{
    Chain, Change, Interpretation, MOST, Observed, Parts, Ranked, SIGNS, Search, Tolerance, Trial, ranked,
    words,
};
use abbe_study::{Result, mistake, number};

/// Largest numbers of rows for the fit and for the search.
pub(super) const ROWS: usize = 150;
const SEARCHED: usize = 40;
/// Residual, as a share of the arm length, below which the interpretation of the map is accepted.
const NEAR: f64 = 2e-3;
/// Residual, as a share of the arm length, from which several joints are changed at once.
const FAR: f64 = 2e-2;
/// Residual, as a share of the arm length, up to which an interpretation with several differences
/// is plausible.
const LIKELY: f64 = 1e-2;
/// Residual, as a share of the spread of the points, at which the search ends.
const ENOUGH: f64 = 0.02;
/// Factor by which another interpretation must be better.
const BETTER: f64 = 5.0;

/// Returns an error if the nominal machine fits the data badly and another interpretation fits
/// well. Otherwise returns the root mean square position error with base and tool fitted, in the
/// length unit; none if the fit fails.
pub(crate) fn check_interpretation(setup: &Setup, map: &Map, data: &Data) -> Result<Option<f64>> {
    check_reading_units(setup, map, data)?;
    let rows = subsample(&data.observations, ROWS);
    let rows = setup.ideal.as_poses(&rows).into_owned();
    let here = FitResidual::fitted(setup, &rows);
    let rms = here.map(|here| here.rms);
    if rms.is_some_and(|rms| rms < NEAR * setup.arm) {
        return Ok(rms);
    }
    let better = with_other_mount(setup, &rows, here);
    // Joints that follow from poses have no columns to be read otherwise.
    let has_joints = map.command_pose.is_none();
    let search = || has_joints.then(|| better_interpretation(setup, map, &rows, here)).flatten();
    let Some((there, questions)) = better.or_else(search) else { return Ok(rms) };
    let unit = setup.description.length;
    let there = number::length(there.rms, unit);
    let message = match rms {
        Some(here) => format!(
            "with the interpretation in the map the residual is {} (root mean square, base and \
             tool fitted); with another interpretation it is {there}",
            number::length(here, unit),
        ),
        None => format!(
            "with the interpretation in the map no placement of base and tool fits these data; \
             with another interpretation the residual is {there} (root mean square)"
        ),
    };
    Err(mistake::with_help(&data.file, message, questions.join("; ")))
}

/// Returns the residual with camera and board exchanged, if it is far better, as a question.
fn with_other_mount(
    setup: &Setup,
    rows: &[Observation],
    here: Option<FitResidual>,
) -> Option<(FitResidual, Vec<String>)> {
    let camera = setup.ideal.camera?;
    let inverse = |row: &Observation| match &row.measured {
        Measurement::Pose(pose) => {
            Observation { measured: Measurement::Pose(Box::new(pose.inverse())), ..row.clone() }
        }
        _ => row.clone(),
    };
    let there = FitResidual::fitted(setup, &rows.iter().map(inverse).collect::<Vec<_>>())?;
    let is_better = there.rms < FAR * setup.arm && here.is_none_or(|here| there.rms < here.rms / BETTER);
    let (place, mount) = if camera.is_on_tool { ("in the room", "room") } else { ("on the tool", "tool") };
    is_better.then(|| (there, vec![format!("is the camera {place}? write `mount = \"{mount}\"`")]))
}

/// Returns the interpretation with the fewest differences among those that fit far better than the
/// map's, as questions to the user.
fn better_interpretation(
    setup: &Setup,
    map: &Map,
    rows: &[Observation],
    here: Option<FitResidual>,
) -> Option<(FitResidual, Vec<String>)> {
    let share = here.map_or(MOST, |here| MOST.min(here.share / BETTER));
    let tolerance = Tolerance { within: None, share, enough: (ENOUGH / share).min(1.0) };
    let map_interpretation = MapInterpretation::new(setup, map)?;
    let search_rows = search_rows(setup, rows);
    let joints: Vec<Vec<f64>> =
        search_rows.iter().map(|(row, _)| map_interpretation.joints(&row.q)).collect();
    let numbers: Vec<Vec<f64>> =
        search_rows.iter().map(|(_, pose)| map_interpretation.numbers(pose)).collect();
    let (metres, chain) = (setup.description.length.in_metres(), NominalChain::new(&setup.ideal));
    let observed = Observed::all(
        &numbers,
        &map_interpretation.layouts(),
        &map_interpretation.lengths(),
        &map_interpretation.changes(),
        metres,
    );
    let search = Search::new(&chain, &joints, &map_interpretation.travels(), observed, tolerance);
    let is_near = here.is_some_and(|here| here.rms < FAR * setup.arm && here.share < MOST);
    let stages = if is_near { 1 } else { 2 };
    let candidates = search.run(trial_stages(setup, rows).take(stages), &mut ()).ok()?;
    let Ranked { found, .. } = ranked(candidates, &tolerance, Some(&map_interpretation.interpretation));
    let names: Vec<&str> = setup.description.variables.iter().map(|variable| &*variable.name).collect();
    let accepted = |found: &Interpretation| {
        let questions = words::questions(found, &map_interpretation.interpretation, &names);
        let most = if questions.len() > 1 { LIKELY * setup.arm } else { f64::INFINITY };
        let rows: Vec<Observation> = rows.iter().map(|row| map_interpretation.reread(row, found)).collect();
        let there = FitResidual::fitted(setup, &rows)?;
        // A unit that enlarges all points lowers the share, but explains nothing.
        let is_better = here.is_none_or(|here| there.rms < here.rms);
        (!questions.is_empty() && is_better && there.share < share && there.rms < most)
            .then_some((there, questions))
    };
    found.first().and_then(|first| accepted(&first.interpretation))
}

/// Returns rows with a pose or with the point of one target, all from one station: the largest such
/// group.
fn search_rows<'r>(setup: &Setup, rows: &'r [Observation]) -> Vec<(&'r Observation, Pose)> {
    type Points<'r> = Vec<(&'r Observation, Pose)>;
    let mut groups: BTreeMap<(u32, Option<usize>), Points<'_>> = BTreeMap::new();
    for row in rows {
        for_each_point(&setup.ideal, row, |target, point| {
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
    subsample(&largest.unwrap_or_default(), SEARCHED)
}

/// Returns stages of trials: single signs and exchanged columns of joints, then all combinations of
/// signs, each with at most two columns exchanged.
fn trial_stages(setup: &Setup, rows: &[Observation]) -> impl Iterator<Item = Vec<Trial>> {
    let variables = &setup.description.variables;
    let (count, moved) = (variables.len(), setup.moved(rows));
    let pairs = (0..count).flat_map(|j| (0..j).map(move |i| (i, j)));
    let same_kind = pairs.filter(|(i, j)| variables[*i].kind == variables[*j].kind);
    let exchanged: Vec<Vec<Change>> =
        std::iter::once(vec![]).chain(same_kind.map(|(i, j)| vec![Change::exchanged(i, j, count)])).collect();
    let trial = |joints: Vec<Change>| Trial {
        joints,
        ends: vec![vec![Change::BaseElsewhere, Change::ToolElsewhere]],
    };
    let one = exchanged.iter().cloned().chain((0..count).map(|i| vec![Change::Reversed(vec![i])]));
    let one = one.map(trial).collect();
    let several = move || {
        let reversals = Change::reversals(&moved[..moved.len().min(SIGNS)]);
        let all = reversals.flat_map(|reversed| {
            exchanged.iter().map(move |order| [&order[..], std::slice::from_ref(&reversed)].concat())
        });
        all.map(trial).collect()
    };
    std::iter::once(one).chain(std::iter::once_with(several))
}

/// Ideal machine with the tool of the spec.
struct NominalChain<'a> {
    model: &'a Model<'a>,
    kinds: Vec<VariableKind>,
}

impl<'a> NominalChain<'a> {
    fn new(model: &'a Model<'a>) -> Self {
        let variables = &model.manipulator.description().variables;
        Self { model, kinds: variables.iter().map(|variable| variable.kind).collect() }
    }
}

impl Chain for NominalChain<'_> {
    fn kinds(&self) -> &[VariableKind] {
        &self.kinds
    }

    fn metres(&self) -> f64 {
        self.model.manipulator.description().length.in_metres()
    }

    fn parts(&self, q: &[f64], _: bool) -> Result<Parts, Error> {
        Ok([Pose::IDENTITY, self.model.manipulator.pose(q, &self.model.s)?, self.model.mountings[0]])
    }
}

/// Returns at most `count` elements at equal distances.
pub(super) fn subsample<T: Clone>(all: &[T], count: usize) -> Vec<T> {
    all.iter().step_by(all.len().div_ceil(count).max(1)).cloned().collect()
}

/// Residual of a machine against the measurements.
#[derive(Clone, Copy)]
struct FitResidual {
    /// Root mean square position error, in the length unit.
    rms: f64,
    /// Ratio of `rms` to the spread of the points. A wrong unit that shrinks all points
    /// together lowers `rms`, but not this.
    share: f64,
}

impl FitResidual {
    fn new(model: &Model, rows: &[Observation], x: &[f64]) -> Option<Self> {
        let rms = model.figures(rows, x).ok()?.rms;
        Some(Self { rms, share: rms / spread(model, rows) }).filter(|missed| missed.share.is_finite())
    }

    /// Fits base and tool of the nominal machine. Returns none if the fit fails.
    fn fitted(setup: &Setup, rows: &[Observation]) -> Option<Self> {
        // Poses become four points, so that one number measures position and orientation.
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
            model.targets = corners.repeat(model.mountings.len());
        }
        for i in 0..model.stations.len() {
            // Too few rows at a station determine no placement.
            let pose = registered(&model, &rows, i).ok()??;
            model.stations[i] = Station { pose, exact: false, ..model.stations[i].clone() };
        }
        let model = model.with(model.base_and_tool(false));
        let found = fit(&model, &rows, &Options::default()).ok()?;
        Self::new(&model, &rows, &found.x)
    }
}

/// Computes the root mean square distance of the measured points from their mean, per target and
/// station.
fn spread(model: &Model, rows: &[Observation]) -> f64 {
    let mut all: BTreeMap<(u32, Option<usize>), Vec<[f64; 3]>> = BTreeMap::new();
    for row in rows {
        for_each_point(model, row, |target, point| all.entry((row.station, target)).or_default().push(point));
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
