//! Reader of runs of one axis or of body diagonals: target positions and deviations, as lasers
//! write them.
//!
//! A file has one row for each reading, with columns `position`, `direction` and `deviation` (or
//! `actual`, the actual position), or one row for each position with one column for each pass,
//! such as `1+` and `1-`. Units are in the headings: `position (mm)`, `deviation (um)`. A circular
//! test has a column `angle` instead, and deviations of the radius.

use abbe::LengthUnit;
use abbe_spec::expr::{Dimension, Unit};

use super::missing::not_a_heading;
use super::source::{Opened, Source};
use abbe_study::{Result, mistake};

/// Approaches of one target position.
#[derive(Clone, Debug, Default)]
pub struct TargetRuns {
    /// Target position, in mm or deg.
    pub position: f64,
    /// Deviations of the approaches from below and from above, in um or arcsec.
    pub deviations: [Vec<f64>; 2],
}

/// Runs of an axis or of several diagonals.
#[derive(Clone, Debug)]
pub struct Runs {
    /// The axis is rotary.
    pub is_rotary: bool,
    /// The positions are angles on a circle, in deg, the deviations those of its radius.
    pub is_circle: bool,
    /// Name of each diagonal, empty for an axis, and its targets by rising position.
    pub lines: Vec<(String, Vec<TargetRuns>)>,
}

/// Names of columns, in lower case.
const POSITION: [&str; 3] = ["position", "target", "target position"];
const DEVIATION: [&str; 3] = ["deviation", "error", "radial deviation"];
const ACTUAL: [&str; 3] = ["actual", "actual position", "measured"];
const DIRECTION: [&str; 2] = ["direction", "approach"];
const DIAGONAL: [&str; 1] = ["diagonal"];
/// Columns without a meaning here.
const IGNORED: [&str; 3] = ["run", "line", "time"];

/// Words for the directions of approach, from below and from above.
const WORDS: [&[&str]; 2] = [
    &["+", "1", "+1", "up", "forward", "fwd", "positive", "↑", "ccw"],
    &["-", "−", "-1", "down", "reverse", "rev", "backward", "negative", "↓", "cw"],
];

/// Distance of positions, relative to the largest, within which they are the same.
const SAME: f64 = 1e-9;

const FORM: &str = "name columns `position (mm)`, or `angle (deg)` of a circle, `direction` and `deviation (um)`, or \
                    one column for each pass: `1+ (um)`, `1- (um)`";

/// Position, direction and deviation.
type Reading = (f64, usize, f64);

/// Returns the target positions in rising order, with the readings at each as the file has them.
fn targets(mut readings: Vec<Reading>) -> Vec<TargetRuns> {
    readings.sort_by(|a, b| a.0.total_cmp(&b.0));
    let mut targets: Vec<TargetRuns> = Vec::new();
    for (at, side, deviation) in readings {
        let is_same = targets.last().is_some_and(|one| at - one.position <= SAME * at.abs().max(1.0));
        if !is_same {
            targets.push(TargetRuns { position: at, ..TargetRuns::default() });
        }
        if let Some(target) = targets.last_mut() {
            target.deviations[side].push(deviation);
        }
    }
    targets
}

/// Column of readings.
struct Readings {
    place: usize,
    unit: Unit,
    /// Direction of a pass; none where a column has it.
    direction: Option<usize>,
    /// Actual positions instead of deviations.
    is_actual: bool,
}

/// Reads runs.
pub(crate) fn runs(source: Source<'_>) -> Result<Runs> {
    let Opened { heading, records, .. } = source.open(&[])?;
    let name = source.name();
    let refuse = |message: String, help: &str| Err(mistake::with_help(&name, message, help));
    let parts: Vec<(String, Option<&str>)> = heading.iter().map(|cell| split(cell)).collect();
    let find = |names: &[&str]| parts.iter().position(|(own, _)| names.contains(&own.as_str()));
    let is_circle = find(&POSITION).is_none();
    let Some(position) = find(&POSITION).or(find(&["angle"])) else {
        let is_none = not_a_heading(&heading, &["position (mm)", "direction", "deviation (um)"]);
        return refuse("no column is named `position`".to_owned(), is_none.as_deref().unwrap_or(FORM));
    };
    let (direction, diagonal) = (find(&DIRECTION), find(&DIAGONAL));
    let unit = |place: usize| match parts[place].1.map(|text| (text, Unit::named(text))) {
        Some((_, Some(unit))) if unit.dimension == Dimension::LENGTH || unit.dimension == Dimension::NONE => {
            Ok(unit)
        }
        Some((text, _)) => Err(mistake::with_help(
            &name,
            format!("`{}` is not a unit of a length or an angle", text.escape_debug()),
            "write `mm`, `um`, `deg` or `arcsec`",
        )),
        None => Err(mistake::with_help(
            &name,
            format!("column `{}` has no unit", heading[place].escape_debug()),
            "write it in parentheses behind the name: `position (mm)`, `deviation (um)`",
        )),
    };
    let readings: Vec<Readings> = match (find(&DEVIATION), find(&ACTUAL)) {
        (Some(place), _) => vec![Readings { place, unit: unit(place)?, direction: None, is_actual: false }],
        (None, Some(place)) => vec![Readings { place, unit: unit(place)?, direction: None, is_actual: true }],
        (None, None) => {
            let mut passes = Vec::new();
            for (place, (own, _)) in parts.iter().enumerate() {
                let is_other = Some(place) == direction || Some(place) == diagonal || place == position;
                if let Some(side) = pass(own).filter(|_| !is_other && !IGNORED.contains(&own.as_str())) {
                    passes.push(Readings {
                        place,
                        unit: unit(place)?,
                        direction: Some(side),
                        is_actual: false,
                    });
                }
            }
            passes
        }
    };
    if readings.is_empty() {
        return refuse("no column has deviations".to_owned(), FORM);
    }
    if direction.is_none() && readings.iter().any(|own| own.direction.is_none()) {
        return refuse("no column is named `direction`".to_owned(), FORM);
    }
    let position_unit = unit(position)?;
    let is_angle = position_unit.dimension == Dimension::NONE;
    let fits = |own: &&Readings| match is_circle {
        true => is_angle && own.unit.dimension == Dimension::LENGTH && !own.is_actual && diagonal.is_none(),
        false => own.unit.dimension == position_unit.dimension,
    };
    if let Some(own) = readings.iter().find(|own| !fits(own)) {
        let [one, other] = [position, own.place].map(|place| heading[place].escape_debug());
        let message = match is_circle {
            true => "a circular test has angles and deviations of its radius".to_owned(),
            false => format!("`{one}` and `{other}` are not both lengths or both angles"),
        };
        return refuse(message, FORM);
    }
    let is_rotary = is_angle && !is_circle;
    // In mm or rad; deviations are shown in um or arcsec.
    let coherent = |unit: Unit, number: f64| unit.convert(number, LengthUnit::Millimetre);
    let shown = |deviation: f64| if is_rotary { 3600.0 * deviation.to_degrees() } else { 1e3 * deviation };
    let mut lines: Vec<(String, Vec<Reading>)> = Vec::new();
    for record in records {
        let record = record?;
        let failed = |reason: String| {
            let message = format!("line {}: {reason}", record.line);
            mistake::with_help(&name, message, "correct the row, or remove it")
        };
        if let Some(reason) = record.too_long() {
            return Err(failed(reason));
        }
        let target = coherent(position_unit, record.number(position).map_err(failed)?);
        let at = if is_angle { target.to_degrees() } else { target };
        let line = diagonal.map_or(String::new(), |place| record.text(place).into_owned());
        if diagonal.is_some() && line.is_empty() {
            return Err(failed("the diagonal is missing".to_owned()));
        }
        for own in &readings {
            if own.direction.is_some() && record.is_empty(own.place) {
                continue;
            }
            let side = match (own.direction, direction) {
                (Some(side), _) => side,
                (None, place) => {
                    let text =
                        place.map(|place| record.text(place).trim().to_lowercase()).unwrap_or_default();
                    word(&text).ok_or_else(|| {
                        failed(format!("`{}` is not a direction, `+` or `-`", text.escape_debug()))
                    })?
                }
            };
            let number = coherent(own.unit, record.number(own.place).map_err(failed)?);
            let deviation = shown(if own.is_actual { number - target } else { number });
            let place = lines.iter().position(|(other, _)| *other == line).unwrap_or_else(|| {
                lines.push((line.clone(), Vec::new()));
                lines.len() - 1
            });
            lines[place].1.push((at, side, deviation));
        }
    }
    let lines: Vec<_> = lines.into_iter().map(|(line, readings)| (line, targets(readings))).collect();
    for (line, targets) in &lines {
        if targets.len() < 2 {
            let of =
                if line.is_empty() { String::new() } else { format!(" of diagonal {}", line.escape_debug()) };
            return refuse(format!("there are fewer than two target positions{of}"), "measure at several");
        }
    }
    if lines.is_empty() {
        return refuse("there are no readings".to_owned(), FORM);
    }
    Ok(Runs { is_rotary, is_circle, lines })
}

/// Splits a heading into its name, in lower case, and the unit in parentheses.
fn split(heading: &str) -> (String, Option<&str>) {
    let parts = heading.strip_suffix(')').and_then(|text| text.rsplit_once('('));
    let (name, unit) = parts.map_or((heading, None), |(name, unit)| (name, Some(unit.trim())));
    (name.trim().to_lowercase(), unit)
}

/// Returns the direction that a word means: 0 from below, 1 from above.
fn word(text: &str) -> Option<usize> {
    WORDS.iter().position(|words| words.contains(&text))
}

/// Returns the direction of a pass: the last word or sign of its name.
fn pass(name: &str) -> Option<usize> {
    let last = name.split(' ').next_back().unwrap_or_default();
    let sign = name.char_indices().next_back().map(|(at, _)| &name[at..]).filter(|sign| *sign != "1");
    word(last).filter(|_| last != "1").or_else(|| word(sign?))
}
