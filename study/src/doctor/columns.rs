//! The numbers of a file: joints, and what was seen.

use std::path::Path;

use abbe_codegen::diagnostic::Diagnostics;
use abbe_codegen::spec::Spec;

use crate::data::numbers;
use crate::{Notes, mistake};

/// The rows of a file.
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

impl Columns {
    /// The columns that are named as the variables of the spec are the joints; if not all are there, the first ones.
    pub(super) fn read(
        file: &Path,
        spec: &Spec,
        most: usize,
        notes: &mut dyn Notes,
    ) -> Result<Self, Diagnostics> {
        let (heading, rows) = numbers(file)?;
        let fail = |message: String, help: &str| Err(mistake::with_help(file.display(), message, help));
        let is_number = |place: usize| rows.iter().all(|row| row[place].is_some());
        let numeric: Vec<usize> = (0..heading.len()).filter(|place| is_number(*place)).collect();
        let texts: Vec<&str> = (0..heading.len())
            .filter(|place| !is_number(*place))
            .map(|place| heading[place].as_str())
            .collect();
        let count = spec.variables.len();
        let named: Option<Vec<usize>> = spec
            .variables
            .iter()
            .map(|variable| numeric.iter().copied().find(|place| heading[*place] == variable.name))
            .collect();
        if rows.len() < 4 {
            let message = format!("this file has {} rows below its heading", rows.len());
            return fail(message, "give four at least, better ten, at configurations far from each other");
        }
        if numeric.len() < count + 3 {
            let message = format!(
                "this file has {} columns of numbers in every row; {count} joints and a position are {}",
                numeric.len(),
                count + 3
            );
            return fail(message, "first the joints, then x, y, z, then the orientation if there is one");
        }
        if !texts.is_empty() {
            let texts = abbe_codegen::diagnostic::listed(&texts);
            notes.note(&format!("columns without a number in every row are not read: {texts}"));
        }
        let joints = named.unwrap_or_else(|| numeric[..count].to_vec());
        let pose: Vec<usize> = numeric.into_iter().filter(|place| !joints.contains(place)).collect();
        let step = rows.len().div_ceil(most);
        if step > 1 {
            notes.note(&format!("of {} rows every {step}th is looked at", rows.len()));
        }
        let picked = |places: &[usize]| -> Vec<Vec<f64>> {
            let row = |row: &Vec<Option<f64>>| places.iter().filter_map(|place| row[*place]).collect();
            rows.iter().step_by(step).map(row).collect()
        };
        let names = |places: &[usize]| places.iter().map(|place| heading[*place].clone()).collect();
        Ok(Self {
            joint_names: names(&joints),
            pose_names: names(&pose),
            joints: picked(&joints),
            pose: picked(&pose),
        })
    }
}
