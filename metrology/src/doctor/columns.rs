//! Columns of a file or table: joint values and measured poses.

use abbe_spec::{Spec, diagnostic::listed};

use crate::data::{RawTable, Source, raw_table};
use crate::interpretations::{PoseFormat, configurations};
use abbe_study::{Notes, Result, mistake};

/// Numeric columns of a file or table.
pub(super) struct Columns {
    /// Names of the joint columns.
    pub(super) joint_names: Vec<String>,
    /// Names of the other numeric columns.
    pub(super) pose_names: Vec<String>,
    /// Joint values per row, in the file's units.
    pub(super) joints: Vec<Vec<f64>>,
    /// Measured values per row, in the file's units.
    pub(super) pose: Vec<Vec<f64>>,
}

/// First letters of the names of columns beside a pose, in lower case.
const OTHERS: [&str; 14] = [
    "temp", "u95", "sigma", "std", "rms", "time", "load", "mass", "line", "row", "index", "id", "speed",
    "humid",
];

/// Smallest number of distinct configurations. With fewer, every interpretation fits.
const LEAST: usize = 4;

impl Columns {
    /// Reads the columns. Joint columns are those named as the variables of the spec, or numbered
    /// as they are; unless all of these exist, the first columns are. Keeps at most `most` rows,
    /// evenly spaced.
    pub(super) fn read(source: Source<'_>, spec: &Spec, most: usize, notes: &mut dyn Notes) -> Result<Self> {
        let RawTable { heading, rows, slips } = raw_table(source)?;
        let fail = |message: String, help: &str| Err(mistake::with_help(source.name(), message, help));
        // In a mostly numeric column, a cell that is no number invalidates its row; other columns
        // are text.
        let is_number = |place: usize| {
            let numbers = rows.iter().filter(|row| !row[place].is_nan()).count();
            2 * numbers > rows.len()
        };
        let (numeric, texts): (Vec<usize>, Vec<usize>) =
            (0..heading.len()).partition(|place| is_number(*place));
        let what = if source.file().is_some() { "file" } else { "table" };
        let count = spec.variables.len();
        if numeric.len() < count + 3 {
            let columns = match numeric.len() {
                1 => "1 column".to_owned(),
                count => format!("{count} columns"),
            };
            let message = format!(
                "this {what} has {columns} of numbers; {count} joints and a position need {}",
                count + 3
            );
            let help = "write the joints first, then x, y, z, then the orientation, if any; \
                separate cells by commas, semicolons or tabs";
            return fail(message, help);
        }
        let names: Vec<&str> = spec.variables.iter().map(|variable| &*variable.name).collect();
        let joints = named(&heading, &numeric, &names)
            .or_else(|| numbered(&heading, &numeric, count))
            .unwrap_or_else(|| numeric[..count].to_vec());
        let rest: Vec<usize> = numeric.into_iter().filter(|place| !joints.contains(place)).collect();
        let pose = pose(&heading, &rest);
        let others = rest.iter().filter(|place| !pose.contains(place)).chain(&texts);
        let ignored: Vec<&str> = others.map(|place| &*heading[*place]).collect();
        if !ignored.is_empty() {
            notes.note(&format!("columns beside joints and pose are ignored: {}", listed(&ignored)));
        }
        let used = || joints.iter().chain(&pose);
        let is_whole = |row: &&Vec<f64>| !used().any(|place| row[*place].is_nan());
        let whole: Vec<&Vec<f64>> = rows.iter().filter(is_whole).collect();
        let slip = used().filter_map(|place| slips[*place].as_ref()).min_by_key(|(line, _)| line);
        if let Some((line, reason)) = slip {
            let others = match rows.len() - whole.len() {
                1 => String::new(),
                count => format!("; {count} rows have this problem"),
            };
            let place = if source.file().is_some() { "line" } else { "row" };
            notes.warn(&format!("an incomplete row is ignored: {place} {line}: {reason}{others}"));
        }
        let step = whole.len().div_ceil(most).max(1);
        if step > 1 {
            notes.note(&format!("{} of {} rows are used", whole.len().div_ceil(step), whole.len()));
        }
        let picked = |places: &[usize]| -> Vec<Vec<f64>> {
            let row = |row: &&Vec<f64>| places.iter().map(|place| row[*place]).collect();
            whole.iter().step_by(step).map(row).collect()
        };
        let (at, seen) = (picked(&joints), picked(&pose));
        let configurations = configurations(&at);
        if configurations < LEAST {
            let message = match at.len() {
                rows if rows == configurations => {
                    format!("this {what} has only {rows} complete rows below its heading")
                }
                rows if configurations == 1 => {
                    format!("the {rows} rows of this {what} have one configuration only")
                }
                rows => format!("the {rows} rows of this {what} have {configurations} configurations only"),
            };
            return fail(message, "at least four rows are needed, better ten, at well-spread configurations");
        }
        let names = |places: &[usize]| places.iter().map(|place| heading[*place].clone()).collect();
        Ok(Self { joint_names: names(&joints), pose_names: names(&pose), joints: at, pose: seen })
    }
}

/// Names of the columns of an orientation, in lower case.
const ORIENTATIONS: [&[&str]; 8] = [
    &["rx", "ry", "rz"],
    &["a", "b", "c"],
    &["w", "p", "r"],
    &["roll", "pitch", "yaw"],
    &["alpha", "beta", "gamma"],
    &["qx", "qy", "qz", "qw"],
    &["q0", "q1", "q2", "q3"],
    &["r11", "r12", "r13", "r21", "r22", "r23", "r31", "r32", "r33"],
];

/// Returns the name of a column in lower case, without its unit.
fn plain(name: &str) -> String {
    let name = name.to_lowercase();
    let name = name.split([' ', '[', '(']).find(|part| !part.is_empty()).unwrap_or_default();
    let units = ["_mm", "_m", "_um", "_deg", "_rad", "_in"];
    units.iter().find_map(|unit| name.strip_suffix(unit)).unwrap_or(name).to_owned()
}

/// Returns the columns with these names, in any case of letters.
fn named(heading: &[String], places: &[usize], names: &[&str]) -> Option<Vec<usize>> {
    let find = |name: &&str| {
        let exact = places.iter().find(|place| heading[**place] == *name);
        exact.or_else(|| places.iter().find(|place| plain(&heading[**place]) == name.to_lowercase())).copied()
    };
    names.iter().map(find).collect()
}

/// Returns the columns of a word with as many numbers as there are joints, such as `J1` … `J6`.
fn numbered(heading: &[String], places: &[usize], count: usize) -> Option<Vec<usize>> {
    let words = ["j", "q", "joint", "joint_", "axis", "axis_", "a", "theta", "ax"];
    let of_word = |word: &str| {
        let all = |first: usize| {
            let names: Vec<String> = (first..first + count).map(|i| format!("{word}{i}")).collect();
            named(heading, places, &names.iter().map(String::as_str).collect::<Vec<_>>())
        };
        all(1).or_else(|| all(0))
    };
    words.into_iter().find_map(of_word)
}

/// Returns the columns of a position or a pose: those with the usual names, or all if these name
/// none. Others beside a named position are no part of it, unless they complete a pose.
fn pose(heading: &[String], rest: &[usize]) -> Vec<usize> {
    let Some(position) = named(heading, rest, &["x", "y", "z"]) else { return rest.to_vec() };
    let orientation = ORIENTATIONS.iter().find_map(|names| named(heading, rest, names));
    let is_other = |place: &usize| OTHERS.iter().any(|other| plain(&heading[*place]).starts_with(other));
    let is_kept = |place: &&usize| match &orientation {
        Some(orientation) => orientation.contains(place),
        None => !position.contains(place) && !is_other(place),
    };
    let kept: Vec<usize> = rest.iter().filter(is_kept).copied().collect();
    let all = [&position[..], &kept].concat();
    if PoseFormat::all(all.len()).is_empty() { position } else { all }
}
