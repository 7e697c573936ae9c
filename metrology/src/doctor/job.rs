//! The job: reads the rows, searches the interpretations, and writes the map of the best.
//!
//! Report of `abbe doctor`.

use abbe_study::{About, Machine, Notes, Result, mistake, number::digits};
use serde::Serialize;

use super::{alternatives, columns::Columns, kinematics::Kinematics, map_writer};
use crate::data::Source;
use crate::interpretations::{
    Candidate, Interpretation, LENGTHS, Observed, PoseFormat, Ranked, Search, Tolerance, ranked, words,
};

/// Largest number of rows that are used; of more, this many evenly spaced ones.
const MOST_ROWS: usize = 40;

/// Default tolerance, as a share of the spread of the positions.
const WITHIN: f64 = 0.02;

/// Job of `abbe doctor`: finds the interpretation under which data agree with a spec.
pub struct Doctor<'a> {
    /// Machine with its spec.
    pub machine: Machine,
    /// Rows with one column per joint, then a pose or position.
    pub data: Source<'a>,
    /// Largest residual at which an interpretation fits, in the spec's length unit; `None` for the
    /// default.
    pub within: Option<f64>,
}

impl Doctor<'_> {
    /// Searches the interpretations.
    pub fn run(&self, notes: &mut dyn Notes) -> Result<Report> {
        let columns = Columns::read(self.data, &self.machine.spec, MOST_ROWS, notes)?;
        let kinematics = Kinematics::new(&self.machine.spec).about(&self.machine.origin)?;
        let formats = PoseFormat::all(columns.pose.first().map_or(0, Vec::len));
        if formats.is_empty() {
            let count = columns.pose.first().map_or(0, Vec::len);
            let message = format!("there are {count} columns of numbers besides the joints");
            let help = "a position has 3 columns; a pose has 6 with angles, 7 with a quaternion, \
                12 with a 3×4 matrix or 16 with a 4×4 matrix; remove the others. Pixels of a camera need a \
                map: `abbe identify` with it tests units, signs and orders of the joints as well";
            return Err(mistake::with_help(self.data.name(), message, help));
        }
        let tolerance = Tolerance { within: self.within, share: WITHIN, enough: 1.0 };
        let metres = self.machine.spec.length.in_metres();
        let observed = Observed::all(&columns.pose, &formats, &LENGTHS, &[None], metres);
        let search = Search::new(&kinematics, &columns.joints, &LENGTHS, observed, tolerance);
        let candidates = search.run(alternatives::stages(&kinematics), notes)?;
        let Ranked { found, simpler, others } = ranked(candidates, &tolerance, None);
        let spec = &self.machine.spec;
        let best = found.first().or(others.first());
        let within = best.map_or(self.within.unwrap_or_default(), |best| tolerance.limit(best.spread));
        if let Some(requested) = self.within.filter(|requested| *requested > within) {
            let unit = spec.length.symbol();
            notes.warn(&format!(
                "{} {unit} exceeds a tenth of the spread of the positions; within that, any \
                 interpretation would fit. The limit {} {unit} is used instead",
                digits(requested, 3),
                digits(within, 3)
            ));
        }
        let finding = |candidate: &Candidate| Finding {
            words: std::iter::once(words::interpretation(&candidate.interpretation, spec))
                .chain(words::places(candidate, spec))
                .collect::<Vec<_>>()
                .join("; "),
            interpretation: candidate.interpretation.clone(),
            residual: candidate.residual.position,
            angle: candidate.residual.angle,
            spread: candidate.spread,
            both: candidate.residual.both,
        };
        let (map, of_spec) = match found.first() {
            Some(first) => {
                let (map, of_spec) = map_writer::map(first, spec, &columns);
                (Some(map), of_spec)
            }
            None => (None, Vec::new()),
        };
        let found: Vec<Finding> = found.iter().map(finding).collect();
        let others: Vec<Finding> = others.iter().map(finding).collect();
        let is_still = |joint: usize| columns.joints.iter().all(|row| row[joint] == columns.joints[0][joint]);
        let names = |is_one: &dyn Fn(usize) -> bool| {
            let joints = (0..spec.variables.len()).filter(|joint| is_one(*joint));
            joints.map(|joint| spec.variables[joint].name.clone()).collect()
        };
        Ok(Report {
            name: spec.name.clone(),
            length: spec.length.symbol(),
            rows: columns.joints.len(),
            still: names(&|joint| is_still(joint)),
            moved: names(&|joint| !is_still(joint)),
            fits: !found.is_empty(),
            simpler: simpler.as_ref().map(finding),
            joints: columns.joint_names,
            seen: columns.pose_names,
            within,
            found,
            others,
            map,
            of_spec,
        })
    }
}

/// An interpretation and its residual.
#[derive(Clone, Debug, Serialize)]
pub struct Finding {
    /// The interpretation.
    pub interpretation: Interpretation,
    /// Description of the interpretation.
    pub words: String,
    /// Root mean square residual of the positions, in the spec's length unit.
    pub residual: f64,
    /// Root mean square residual of the orientations, in rad; `None` if the data have no
    /// orientations.
    pub angle: Option<f64>,
    /// Root mean square distance of the positions from their mean, as this interpretation reads
    /// them, in the spec's length unit.
    pub spread: f64,
    /// Combined root mean square residual, in the spec's length unit, which is compared with
    /// `within`. Angles are multiplied by a lever of 0.3 × the spread of the positions. Corrected
    /// for the degrees of freedom that fitted numbers take.
    pub both: f64,
}

/// Units, order and format with which the numbers of a file agree with the spec.
#[derive(Clone, Debug, Serialize)]
pub struct Report {
    /// Name of the machine.
    pub name: String,
    /// Symbol of the length unit.
    pub length: &'static str,
    /// Number of rows that were used.
    pub rows: usize,
    /// Names of the columns read as joints.
    pub joints: Vec<String>,
    /// Names of the columns read as measured values.
    pub seen: Vec<String>,
    /// Indicates that at least one interpretation fits.
    pub fits: bool,
    /// Largest combined residual at which an interpretation fits, in the spec's length unit.
    pub within: f64,
    /// Interpretations that fit and that the data cannot distinguish, simplest first.
    pub found: Vec<Finding>,
    /// Simplification of the first interpretation that is also within the tolerance, but fits
    /// significantly worse.
    pub simpler: Option<Finding>,
    /// Best of the interpretations that do not fit.
    pub others: Vec<Finding>,
    /// Names of the joints that do not move in these rows.
    pub still: Vec<String>,
    /// Names of the joints that move in these rows.
    pub moved: Vec<String>,
    /// Map of the first interpretation; `None` if no interpretation fits.
    pub map: Option<String>,
    /// Corrections that the map cannot express and that belong in the spec or the file, one
    /// sentence each.
    pub of_spec: Vec<String>,
}
