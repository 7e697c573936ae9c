//! Notes on rows that do not say what the map says of them: a place that moved, a machine that
//! stood still, orientations that nobody measured.

use abbe::analysis::sampling::norm;
use abbe::identify::{Failure, Measurement, Model, Observation, Unknown, moved_places};
use abbe::{Component, Pose, rotation_vector};
use abbe_spec::option::STATION_NEW;

use super::fitted::{fitted_mountings, fitted_targets};
use super::outliers::shown_lines;
use super::setup::Setup;
use abbe_study::number::{digits, length, percent};

/// Probability by chance up to which a place counts as moved.
const CHANCE: f64 = 1e-6;

/// Share of the squares of the residuals from which a place counts as moved.
const SHARE: f64 = 0.3;

/// Share of its predicted motion up to which a measured one counts as none.
const STILL: f64 = 0.01;

/// Share of the arm length from which a place is far from where the map states it.
const FAR: f64 = 0.03;

/// Root mean square difference of orientations, in radians, up to which they are those of the
/// nominal machine.
const COPIED: f64 = 1e-5;

/// Returns notes on rows whose residuals at `x` show that they are not what the map says.
pub(crate) fn row_notes(
    setup: &Setup,
    model: &Model,
    x: &[f64],
    rows: &[Observation],
) -> Result<Vec<String>, Failure> {
    let still = still(setup, model, x, rows)?;
    // Rows that repeat others move nothing.
    let moved = if still.is_none() { moved(setup, model, x, rows)? } else { None };
    let copied = copied_orientations(setup, rows)?;
    Ok(still.into_iter().chain(moved).chain(copied).chain(far_from_stated(setup, model, x)).collect())
}

/// Returns a note on a place on the tool that was found far from where the map states it.
fn far_from_stated(setup: &Setup, model: &Model, x: &[f64]) -> Option<String> {
    let found = match setup.pose {
        true => fitted_mountings(model, x).iter().map(Pose::position).collect(),
        false => model.mounted(&fitted_targets(model, x)),
    };
    let away = |(a, b): ([f64; 3], [f64; 3])| norm([a[0] - b[0], a[1] - b[1], a[2] - b[2]]);
    let most = found.into_iter().zip(setup.delivered_points()).map(away).fold(0.0, f64::max);
    (most > FAR * setup.arm && !setup.is_tool_open()).then(|| {
        format!(
            "note: {} comes out {} from where the map states it on the tool: does the map have another tool, or \
             another unit?",
            if setup.pose { "the measured frame" } else { "a target" },
            length(most, setup.description.length)
        )
    })
}

/// Returns a note on rows in which the joints differ from those before, but nothing moved.
fn still(setup: &Setup, model: &Model, x: &[f64], rows: &[Observation]) -> Result<Option<String>, Failure> {
    let mut at = model.at(x);
    let mut last: Option<(Pose, Vec<[f64; 3]>)> = None;
    let mut lines = Vec::new();
    let apart = |a: [f64; 3], b: [f64; 3]| norm([a[0] - b[0], a[1] - b[1], a[2] - b[2]]);
    for row in rows {
        let measured = match &row.measured {
            Measurement::Points(points) => points.iter().flatten().copied().collect(),
            Measurement::Pose(pose) => vec![pose.position()],
            Measurement::Readings(_) => return Ok(None),
        };
        let predicted = at.pose(row)?;
        if let Some((pose, points)) = &last
            && points.len() == measured.len()
        {
            let motion = apart(pose.position(), predicted.position());
            let most = points.iter().zip(&measured).map(|(a, b)| apart(*a, *b)).fold(0.0, f64::max);
            let noise = 10.0 * setup.real.uncertainty.length;
            if motion > noise.max(STILL * setup.arm) && most < STILL * motion {
                lines.push(row.line);
            }
        }
        last = Some((predicted, measured));
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
fn copied_orientations(setup: &Setup, rows: &[Observation]) -> Result<Option<String>, Failure> {
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

/// Returns a note on the station or the place on the tool that explains most of the residuals, if
/// it differs in all rows or from one on.
fn moved(setup: &Setup, model: &Model, x: &[f64], rows: &[Observation]) -> Result<Option<String>, Failure> {
    let [stations, targets] = [&model.stations.len(), &model.targets.len()].map(|count| 0..*count);
    let tools = 0..if setup.pose { model.mountings.len() } else { 0 };
    let of_stations = stations.clone().map(|i| Component::ALL.map(|c| Unknown::Base(i, c)).to_vec());
    let of_targets = targets.map(|i| [0, 1, 2].map(|axis| Unknown::Target(i, axis)).to_vec());
    let of_tools = tools.map(|i| Component::ALL.map(|c| Unknown::Tool(i, c)).to_vec());
    let places: Vec<Vec<Unknown>> = of_stations.chain(of_targets).chain(of_tools).collect();
    let mut found = moved_places(model, rows, x, &places)?.into_iter();
    let Some(found) = found.find(|found| found.p < CHANCE && found.share > SHARE) else { return Ok(None) };
    let part = |first: usize| norm([0, 1, 2].map(|i| found.change[first + i]));
    let mut by = length(part(0), setup.description.length);
    if found.change.len() > 3 {
        by += &format!(" and {} mrad", digits(part(3) * 1e3, 2));
    }
    let explained = percent(found.share, 1.0);
    let (is_station, is_moved) = (stations.contains(&found.place), found.row > 0);
    let place = match places[found.place][0] {
        Unknown::Base(i, _) if model.stations.len() > 1 => {
            format!("F_0 at station {}", model.stations[i].name)
        }
        Unknown::Base(..) => "F_0".to_owned(),
        Unknown::Target(i, _) if model.targets.len() > 1 => format!("target {}", i + 1),
        Unknown::Target(..) => "the target".to_owned(),
        _ => "the measured frame".to_owned(),
    };
    let line = rows[found.row].line;
    let (on, reason, more) = match is_station {
        true => ("", "the instrument was moved, or the machine on its foundation", ""),
        false => (" on the tool", "it slipped, or was mounted anew", " and `placement = \"per station\"`"),
    };
    let fitted = match is_station {
        true => format!("`base = \"unknown\"` in the map, or `{STATION_NEW}`,"),
        false => "`placement = \"unknown\"` in the map".to_owned(),
    };
    Ok(Some(match is_moved {
        true => format!(
            "note: from line {line} on, {place} is {by} elsewhere{on} than before, which explains {explained} of the \
             squares of the residuals: {reason}. Name the rows before and those from there on in a column of \
             their own: `station = \"that column\"`{more} in `[data]` of the map"
        ),
        false => format!(
            "note: {place} is {by} elsewhere{on} than the map states, which explains {explained} of the squares of \
             the residuals: {fitted} fits it"
        ),
    }))
}
