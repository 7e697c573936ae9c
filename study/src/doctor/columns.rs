//! The numbers of a file or a table: joints, and what was seen.

use abbe_spec::Spec;
use abbe_spec::diagnostic::{Diagnostics, listed};

use crate::data::{Numbers, Source, numbers};
use crate::interpretations::configurations;
use crate::{Notes, mistake};

/// The rows of a file or a table.
pub(super) struct Columns {
    /// The names of the columns of joints.
    pub(super) joint_names: Vec<String>,
    /// The names of the others that have numbers.
    pub(super) pose_names: Vec<String>,
    /// A number for each joint, as it stands there.
    pub(super) joints: Vec<Vec<f64>>,
    /// What was seen, as it stands there.
    pub(super) pose: Vec<Vec<f64>>,
}

/// Of fewer configurations every reading fits.
const LEAST: usize = 4;

impl Columns {
    /// The columns that are named as the variables of the spec are the joints; if not all are there, the first ones.
    pub(super) fn read(
        source: Source<'_>,
        spec: &Spec,
        most: usize,
        notes: &mut dyn Notes,
    ) -> Result<Self, Diagnostics> {
        let Numbers { heading, rows, slips } = numbers(source)?;
        let fail = |message: String, help: &str| Err(mistake::with_help(source.name(), message, help));
        // A cell that is no number among numbers is a slip in its row; among texts it is a text.
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
                "this {what} has {columns} of numbers; {count} joints and a position are {}",
                count + 3
            );
            let help = "first the joints, then x, y, z, then the orientation if there is one; between cells stand commas, semicolons or tabs";
            return fail(message, help);
        }
        if !texts.is_empty() {
            let texts: Vec<&str> = texts.iter().map(|place| heading[*place].as_str()).collect();
            notes.note(&format!("columns of texts are not read: {}", listed(&texts)));
        }
        let is_whole = |row: &&Vec<f64>| !numeric.iter().any(|place| row[*place].is_nan());
        let whole: Vec<&Vec<f64>> = rows.iter().filter(is_whole).collect();
        let slip = numeric.iter().filter_map(|place| slips[*place].as_ref()).min_by_key(|(line, _)| line);
        if let Some((line, reason)) = slip {
            let others = match rows.len() - whole.len() {
                1 => String::new(),
                count => format!("; {count} rows are like this"),
            };
            let place = if source.file().is_some() { "line" } else { "row" };
            notes.warn(&format!("a row that is not whole is not read: {place} {line}: {reason}{others}"));
        }
        let named: Option<Vec<usize>> = spec
            .variables
            .iter()
            .map(|variable| numeric.iter().copied().find(|place| heading[*place] == variable.name))
            .collect();
        let joints = named.unwrap_or_else(|| numeric[..count].to_vec());
        let pose: Vec<usize> = numeric.into_iter().filter(|place| !joints.contains(place)).collect();
        let step = whole.len().div_ceil(most).max(1);
        if step > 1 {
            notes.note(&format!("{} of {} rows are looked at", whole.len().div_ceil(step), whole.len()));
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
                    format!("this {what} has {rows} whole rows below its heading")
                }
                rows if configurations == 1 => {
                    format!("the {rows} rows of this {what} are of one configuration")
                }
                rows => format!("the {rows} rows of this {what} are of {configurations} configurations"),
            };
            return fail(message, "give four at least, better ten, at configurations far from each other");
        }
        let names = |places: &[usize]| places.iter().map(|place| heading[*place].clone()).collect();
        Ok(Self { joint_names: names(&joints), pose_names: names(&pose), joints: at, pose: seen })
    }
}
