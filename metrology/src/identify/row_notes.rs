//! Notes on rows that do not say what the map says of them: a place that moved, a machine that
//! stood still, orientations that nobody measured.
//!
//! Gross errors: rows far from a robust fit.

use abbe::identify::{
    Failure, Fit, Loss, Measurement, Model, MovedPlace, Observation, Options, Unknown, fit, moved_places,
    robust_scale,
};
use abbe::{Component, Pose, analysis::sampling::norm, rotation_vector};
use abbe_spec::option::{ROBUST_TUKEY, STATION_NEW};
use abbe_study::number::{digits, length, percent};

use super::fitted::{fitted_mountings, fitted_targets};
use super::{Prior, Setup};
use crate::data::Data;

/// Probability by chance up to which a place counts as moved.
const CHANCE: f64 = 1e-6;

/// Share of the squares of the residuals from which a place counts as moved.
const SHARE: f64 = 0.3;

/// Share of a motion that the nearest rows must show with 95 % confidence: a drift shows a quarter.
const SUDDEN: f64 = 0.5;

/// Largest number of rows, times the number of places, among which a motion is sought.
const TRIED: usize = 4000;

/// Share of its predicted motion up to which a measured one counts as none.
const STILL: f64 = 0.01;

/// Share of the arm length from which a place is far from where the map states it.
const FAR: f64 = 0.03;

/// Root mean square difference of orientations, in radians, up to which they are those of the
/// nominal machine.
const COPIED: f64 = 1e-5;

/// Notes on rows that do not say what the map says of them.
#[derive(Default)]
pub(crate) struct RowNotes {
    /// Sentences.
    pub(crate) notes: Vec<String>,
    /// A place moved between two rows: that the residuals follow time is no drift.
    pub(crate) has_moved: bool,
}

impl RowNotes {
    /// Examines rows of some data by their residuals at `x`.
    pub(crate) fn new(
        setup: &Setup,
        model: &Model,
        x: &[f64],
        (data, rows): (&Data, &[&Observation]),
    ) -> Result<Self, Failure> {
        let still = still(setup, model, x, rows)?;
        // Rows that repeat others move nothing.
        let (moved, has_moved) = match still.is_none() {
            true => moved(setup, model, x, (data, rows))?.unzip(),
            false => (None, None),
        };
        let copied = copied_orientations(setup, rows)?;
        let notes = still.into_iter().chain(moved).chain(copied).chain(far_from_stated(setup, model, x));
        Ok(Self { notes: notes.collect(), has_moved: has_moved == Some(true) })
    }
}

/// Returns a note on a place on the tool that was found far from where the map states it.
fn far_from_stated(setup: &Setup, model: &Model, x: &[f64]) -> Option<String> {
    let found = match setup.pose {
        true => fitted_mountings(model, x).iter().map(Pose::position).collect(),
        false => model.mounted(&fitted_targets(model, x)),
    };
    let away = found.into_iter().zip(setup.delivered_points()).map(|(a, b)| apart(a, b)).enumerate();
    let (place, most) = away.max_by(|(_, a), (_, b)| a.total_cmp(b))?;
    let unknown = if setup.pose { Unknown::Tool(place, Component::X) } else { Unknown::Target(place, 0) };
    let name = name(model, unknown);
    (most > FAR * setup.arm && !setup.is_tool_open()).then(|| {
        format!(
            "note: {name} comes out {} from where map and spec have it on the tool: is it that of another tool, or \
             in another unit?",
            length(most, setup.description.length)
        )
    })
}

/// Names the place that an unknown belongs to.
fn name(model: &Model, unknown: Unknown) -> String {
    match unknown {
        Unknown::Base(i, _) if model.stations.len() > 1 => {
            format!("F_0 at station {}", model.stations[i].name)
        }
        Unknown::Base(..) => "F_0".to_owned(),
        Unknown::Target(i, _) if model.targets.len() > 1 => format!("target {}", i + 1),
        Unknown::Target(..) => "the target".to_owned(),
        _ => "the measured frame".to_owned(),
    }
}

fn apart(a: [f64; 3], b: [f64; 3]) -> f64 {
    norm([a[0] - b[0], a[1] - b[1], a[2] - b[2]])
}

/// Returns a note on rows in which the joints differ from those before, but nothing moved: neither
/// the target nor, of a pose, its position, that the joints should have moved.
fn still(setup: &Setup, model: &Model, x: &[f64], rows: &[&Observation]) -> Result<Option<String>, Failure> {
    let mut at = model.at(x);
    let mut last: Vec<[[f64; 3]; 2]> = Vec::new();
    let mut lines = Vec::new();
    let least = (10.0 * setup.real.uncertainty.length).max(STILL * setup.arm);
    for row in rows {
        let measured: Vec<[f64; 3]> = match &row.measured {
            Measurement::Points(points) => points.iter().flatten().copied().collect(),
            Measurement::Pose(pose) => vec![pose.position()],
            Measurement::Readings(_) => return Ok(None),
        };
        // Deviations are predicted minus measured.
        let deviations = at.deviations(row)?.into_iter();
        let both =
            measured.into_iter().zip(deviations).map(|(at, by)| [at, [0, 1, 2].map(|i| at[i] + by[i])]);
        let here: Vec<[[f64; 3]; 2]> = both.collect();
        let stands = |(before, now): (&[[f64; 3]; 2], &[[f64; 3]; 2])| {
            let [measured, predicted] = [0, 1].map(|i| apart(before[i], now[i]));
            predicted > least && measured < STILL * predicted
        };
        if here.len() == last.len() && !here.is_empty() && last.iter().zip(&here).all(stands) {
            lines.push(row.line);
        }
        last = here;
    }
    Ok((!lines.is_empty()).then(|| {
        format!(
            "note: the joints differ from those of the row before, the measurement does not: the machine stood \
             still, or was not measured anew (lines {}). Leave these rows out",
            shown_lines(&lines)
        )
    }))
}

/// Returns a note on orientations that agree with the nominal machine, where positions do not.
///
/// The angles between the orientations of consecutive rows depend neither on base nor on tool.
fn copied_orientations(setup: &Setup, rows: &[&Observation]) -> Result<Option<String>, Failure> {
    let mut nominal = setup.ideal.at(&[]);
    let mut last: Option<[Pose; 2]> = None;
    let (mut turned, mut moved, mut count) = (0.0, 0.0, 0.0);
    for row in rows {
        let Measurement::Pose(measured) = &row.measured else { return Ok(None) };
        let both = [**measured, nominal.pose(row)?];
        if let Some(last) = last {
            let steps = [0, 1].map(|i| last[i].inverse().then(&both[i]));
            let [turn, there] = steps.map(|step| norm(rotation_vector(&step)));
            turned += (turn - there).powi(2);
            let [way, there] = steps.map(|step| norm(step.position()));
            moved += (way - there).powi(2);
            count += 1.0;
        }
        last = Some(both);
    }
    let [turned, moved] = [turned, moved].map(|sum: f64| (sum / f64::max(count, 1.0)).sqrt());
    Ok((count > 1.0 && turned < COPIED && moved > 10.0 * COPIED * setup.arm).then(|| {
        format!(
            "note: the orientations turn as the nominal machine does, within {} mrad, but positions differ by {}: \
             were they measured, or computed? If computed, `[point]` in place of `[pose]` takes the positions alone",
            digits(turned * 1e3, 1),
            length(moved, setup.description.length)
        )
    }))
}

/// Returns a note on the station or the place on the tool whose motion explains most of the
/// residuals, and whether it moved between two rows instead of being elsewhere in all.
fn moved(
    setup: &Setup,
    model: &Model,
    x: &[f64],
    (data, rows): (&Data, &[&Observation]),
) -> Result<Option<(String, bool)>, Failure> {
    let [stations, targets] = [&model.stations.len(), &model.targets.len()].map(|count| 0..*count);
    let tools = 0..if setup.pose { model.mountings.len() } else { 0 };
    let of_stations = stations.clone().map(|i| Component::ALL.map(|c| Unknown::Base(i, c)).to_vec());
    let of_targets = targets.map(|i| [0, 1, 2].map(|axis| Unknown::Target(i, axis)).to_vec());
    let of_tools = tools.map(|i| Component::ALL.map(|c| Unknown::Tool(i, c)).to_vec());
    let places: Vec<Vec<Unknown>> = of_stations.chain(of_targets).chain(of_tools).collect();
    let step = (rows.len() * places.len()).div_ceil(TRIED).max(1);
    let rows: Vec<&Observation> = rows.iter().step_by(step).copied().collect();
    let is_one = |one: &MovedPlace| one.p < CHANCE && one.share > SHARE && one.sudden > SUDDEN;
    let found = moved_places(model, &rows, x, &places)?;
    let Some(found) = found.into_iter().flatten().find(is_one) else { return Ok(None) };
    let part = |first: usize| norm([0, 1, 2].map(|i| found.change[first + i]));
    let mut by = length(part(0), setup.description.length);
    if found.change.len() > 3 {
        by += &format!(" and {} mrad", digits(part(3) * 1e3, 2));
    }
    let explained = percent(found.share, 1.0);
    let (is_station, is_moved) = (stations.contains(&found.place), found.row > 0);
    let place = name(model, places[found.place][0]);
    let on = if is_station { "" } else { " on the tool" };
    if !is_moved {
        let fitted = match is_station {
            true => format!("`base = \"unknown\"` in the map, or `{STATION_NEW}`,"),
            false => "`placement = \"unknown\"` in the map".to_owned(),
        };
        let note = format!(
            "note: {place} elsewhere{on} by {by} would explain {explained} of the squares of the residuals: \
             {fitted} fits it"
        );
        return Ok(Some((note, false)));
    }
    let (reason, more) = match is_station {
        true => ("was the instrument moved, or the machine on its foundation?", ""),
        false => ("did it slip, or was it mounted anew?", " and `placement = \"per station\"`"),
    };
    let way_out = match model.observables.is_empty() {
        true => format!(
            "Name the rows before and those from there on in a column of their own: `station = \"that column\"`{more} \
             in `[data]` of the map"
        ),
        false => "Give the rows from there on instruments of their own, by `setup` in `[data]` of the map"
            .to_owned(),
    };
    let [before, first] = [found.row - 1, found.row].map(|row| data.place(rows[row].line));
    let from =
        if step == 1 { format!("from {first} on") } else { format!("from between {before} and {first} on") };
    let note = format!(
        "note: {from}, {place} is {by} elsewhere{on} than before, which explains {explained} of the squares of the \
         residuals: {reason} {way_out}"
    );
    Ok(Some((note, true)))
}

/// Largest number of rows for the robust fit.
const ROWS: usize = 400;

/// Returns a warning of gross errors if the plain fit failed or its residuals suggest them.
pub(super) fn outlier_warning(model: &Model, data: &Data, plain: Option<&Fit>) -> Option<String> {
    let rows = &data.observations;
    if let Some(plain) = plain {
        let mut all = model.all_distances(rows, &plain.x).ok()?.into_values();
        let rms = (all.iter().map(|d| d * d).sum::<f64>() / all.len().max(1) as f64).sqrt();
        // For norms of Gaussian errors, the root mean square is 1.13 times the median and 0.76 of
        // the robust scale.
        if rms < 1.6 * robust_scale(&mut all) {
            return None;
        }
    }
    let part: Vec<Observation> = rows.iter().step_by(rows.len().div_ceil(ROWS).max(1)).cloned().collect();
    let priors = model.priors(Prior::DEFAULT_SHARE).ok()?;
    let robust = fit(model, &part, &Options { loss: Loss::Tukey, priors, ..Options::default() }).ok()?;
    // With several instruments, the largest uncertainty counts.
    let lengths = model.observables.iter().filter(|reading| !reading.kind.is_angle && model.camera.is_none());
    let length = lengths.map(|reading| reading.uncertainty).reduce(f64::max);
    let bound = 10.0 * robust.sigma * length.unwrap_or(model.uncertainty.length);
    let mut at = model.at(&robust.x);
    let mut wrong = Vec::new();
    for row in rows {
        let distances = at.distances(row).ok()?;
        wrong.extend(distances.iter().any(|distance| *distance > bound).then_some(row.line));
    }
    let poses = rows.iter().any(|row| matches!(row.measured, Measurement::Pose(_)));
    if wrong.is_empty() || poses && wrong.len() == rows.len() {
        return None;
    }
    Some(format!(
        "{} of {} rows lie more than ten standard deviations from a fit without them (lines {}); \
         `{ROBUST_TUKEY}` rejects outliers",
        wrong.len(),
        rows.len(),
        shown_lines(&wrong)
    ))
}

/// Formats the first twelve lines of a list, and the number of further ones.
pub fn shown_lines(lines: &[u64]) -> String {
    let shown = lines.iter().take(12).map(u64::to_string).collect::<Vec<_>>().join(", ");
    if lines.len() > 12 { format!("{shown} and {} more", lines.len() - 12) } else { shown }
}
