//! Columns of a file or table: joint values and measured poses.

use abbe_spec::Spec;
use abbe_spec::diagnostic::{Diagnostics, listed};

use crate::data::{RawTable, Source, raw_table};
use crate::interpretations::configurations;
use abbe_study::{Notes, mistake};

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

/// Smallest number of distinct configurations. With fewer, every interpretation fits.
const LEAST: usize = 4;

impl Columns {
    /// Reads the columns. Joint columns are those named as the variables of the spec; unless all of
    /// these exist, the first columns are. Keeps at most `most` rows, evenly spaced.
    pub(super) fn read(
        source: Source<'_>,
        spec: &Spec,
        most: usize,
        notes: &mut dyn Notes,
    ) -> Result<Self, Diagnostics> {
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
        if !texts.is_empty() {
            let texts: Vec<&str> = texts.iter().map(|place| heading[*place].as_str()).collect();
            notes.note(&format!("text columns are ignored: {}", listed(&texts)));
        }
        let is_whole = |row: &&Vec<f64>| !numeric.iter().any(|place| row[*place].is_nan());
        let whole: Vec<&Vec<f64>> = rows.iter().filter(is_whole).collect();
        let slip = numeric.iter().filter_map(|place| slips[*place].as_ref()).min_by_key(|(line, _)| line);
        if let Some((line, reason)) = slip {
            let others = match rows.len() - whole.len() {
                1 => String::new(),
                count => format!("; {count} rows have this problem"),
            };
            let place = if source.file().is_some() { "line" } else { "row" };
            notes.warn(&format!("an incomplete row is ignored: {place} {line}: {reason}{others}"));
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
