//! Which convention is it? Some rows of joints and poses, and the reading of their columns under which they are those of a spec.
//!
//! `columns` finds numbers in a file; a `reading` says what they mean: units, how an orientation is written, and `change`s, each
//! one thing that is other than the spec has it. `kinematics` has the poses of the spec under a change of its joints, `zeros` the
//! zeros of joints that fit best, `registration` base and tool that do. `search` goes through readings one by one and in pairs,
//! `ranked` keeps those that nothing simpler explains, `written` is the map of one, `corrected`
//! the spec where a reading is about it.

mod change;
mod columns;
mod corrected;
mod kinematics;
mod ranked;
mod reading;
mod registration;
mod residual;
mod search;
mod sets;
mod words;
mod written;
mod zeros;

use abbe_spec::diagnostic::Diagnostics;
use serde::Serialize;

pub use self::change::Change;
use self::columns::Columns;
use self::kinematics::Kinematics;
use self::ranked::Ranked;
pub use self::reading::{Layout, Reading};
use self::search::Search;
use crate::data::Source;
use crate::number::digits;
use crate::{Machine, Notes, mistake};

/// How many rows are looked at; of more, so many at equal distances.
const MOST_ROWS: usize = 40;

/// Which reading of these rows is that of this machine?
pub struct Doctor<'a> {
    /// The machine as its spec has it.
    pub machine: Machine,
    /// A column for each joint, then a pose or a position.
    pub data: Source<'a>,
    /// What may be left of a position for a reading to fit, in the spec's length unit.
    pub within: Option<f64>,
}

/// A reading, and what is left under it.
#[derive(Clone, Debug, Serialize)]
pub struct Finding {
    /// What the numbers are then.
    pub reading: Reading,
    /// The same in words.
    pub words: String,
    /// The root mean square of what is left of positions, in the spec's length unit.
    pub residual: f64,
    /// The root mean square of what is left of orientations, in rad; none if there are none.
    pub angle: Option<f64>,
    /// What is held against `within`, in the spec's length unit: both together, angles at a lever of three tenths of how far the
    /// positions spread, and more by what fitted numbers take away.
    pub both: f64,
}

/// What the rows are.
#[derive(Clone, Debug, Serialize)]
pub struct Report {
    /// The machine's name.
    pub name: String,
    /// The length unit of residuals.
    pub length: &'static str,
    /// How many rows were looked at.
    pub rows: usize,
    /// The columns that were read as joints.
    pub joints: Vec<String>,
    /// The columns that were read as what was seen.
    pub seen: Vec<String>,
    /// Whether a reading fits.
    pub fits: bool,
    /// What may be left of a position for that.
    pub within: f64,
    /// Readings that fit and cannot be told apart by these rows, the simplest first; if none fits, none.
    pub found: Vec<Finding>,
    /// The first of these with less in it, where that leaves little as well, but more than noise does.
    pub simpler: Option<Finding>,
    /// The nearest of the others.
    pub others: Vec<Finding>,
    /// What is found, in one sentence.
    pub sentence: String,
    /// The map of the first reading; none if none fits.
    pub map: Option<String>,
    /// What the map cannot hold: to be changed in the spec.
    pub of_spec: Vec<String>,
}

impl Doctor<'_> {
    /// Goes through the readings.
    pub fn run(&self, notes: &mut dyn Notes) -> Result<Report, Diagnostics> {
        let columns = Columns::read(self.data, &self.machine.spec, MOST_ROWS, notes)?;
        let kinematics = Kinematics::new(&self.machine.spec)
            .map_err(|error| mistake::whole(&self.machine.origin, &error))?;
        let layouts = reading::layouts(columns.pose.first().map_or(0, Vec::len));
        if layouts.is_empty() {
            let count = columns.pose.first().map_or(0, Vec::len);
            let message = format!("beside the joints there are {count} columns of numbers");
            let help = "a position has 3; a pose 6 with angles, 7 with a quaternion, 12 with a matrix, 16 as 4×4; leave out the others";
            return Err(mistake::with_help(self.data.name(), message, help));
        }
        let search = Search::new(&kinematics, &columns, &layouts, self.within);
        let candidates = search.run(notes)?;
        let Ranked { found, simpler, others } = ranked::ranked(candidates, self.within);
        let spec = &self.machine.spec;
        let best = found.first().or(others.first());
        let within =
            best.map_or(self.within.unwrap_or_default(), |best| search::limit(self.within, best.spread));
        if let Some(asked) = self.within.filter(|asked| *asked > within) {
            let unit = spec.length.symbol();
            notes.warn(&format!(
                "{} {unit} are more than a tenth of how far the positions spread, which any reading may leave: {} {unit} are taken",
                digits(asked, 3),
                digits(within, 3)
            ));
        }
        let finding = |candidate: &search::Candidate| Finding {
            words: words::reading(&candidate.reading, spec),
            reading: candidate.reading.clone(),
            residual: candidate.residual.position,
            angle: candidate.residual.angle,
            both: candidate.residual.both,
        };
        let (map, of_spec) = match found.first() {
            Some(first) => {
                let (map, of_spec) = written::map(first, spec, &columns, within);
                (Some(map), of_spec)
            }
            None => (None, Vec::new()),
        };
        let found: Vec<Finding> = found.iter().map(finding).collect();
        let others: Vec<Finding> = others.iter().map(finding).collect();
        Ok(Report {
            name: spec.name.clone(),
            length: spec.length.symbol(),
            rows: columns.joints.len(),
            fits: !found.is_empty(),
            simpler: simpler.as_ref().map(finding),
            joints: columns.joint_names,
            seen: columns.pose_names,
            within,
            sentence: words::sentence(&found, &others, spec, within),
            found,
            others,
            map,
            of_spec,
        })
    }
}
