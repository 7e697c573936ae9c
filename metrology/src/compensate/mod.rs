//! Corrected joint commands that bring the real tool to the pose of the ideal one.

pub mod options;
pub mod program;
mod rows;

use abbe_interpreter::Interpreter;
use abbe_spec::{Diagnostics, Spec, option::POSES};
use serde::Serialize;

use crate::data::{Base, Channel, Data, Heading, Layout, Map, Summary, Table, Unusable};
use crate::running_sums::RunningSums;
use abbe_study::extrapolation::{Extrapolation, ToolPointDeviation, warn_of_extrapolation};
use abbe_study::{Evaluator, Machine, Notes, Residuals, Result, RunRecord, finite, mistake, number};

use rows::{BaseFramePoses, Task};
pub use rows::{CommandCorrector, CorrectedCommand, ErrorNorms, Row};

/// Job of `abbe compensate`: corrects joint commands.
pub struct Compensate {
    /// Machine whose repeatable sources are compensated.
    pub machine: Machine,
    /// Description of the data columns.
    pub map: Map,
    /// Commands to correct.
    pub data: Data,
    /// Targets the poses in the data, with the joints of each row as the start; otherwise targets
    /// the ideal pose at these joints.
    pub poses: bool,
    /// Permitted remaining error of the tool point, in the length unit; for angles 1 rad counts as
    /// 1 m.
    pub tolerance: f64,
    /// Length that weighs as much as 1 rad of the orientation where both cannot be reached, in the
    /// length unit; `None` gives the position priority.
    pub weight: Option<f64>,
}

/// Corrected commands, and the errors of the machine before and after.
#[derive(Debug, Serialize)]
pub struct Report {
    /// Name of the machine.
    pub name: String,
    /// Symbol of the length unit.
    pub length: &'static str,
    /// Number of rows compensated within the tolerance.
    pub compensated: usize,
    /// Permitted remaining error of the tool point, in the length unit.
    pub tolerance: f64,
    /// Errors with the original commands.
    pub before: NormStatistics,
    /// Errors with the corrected commands.
    pub after: NormStatistics,
    /// Length that weighs as much as 1 rad, in the length unit; none where the position has
    /// priority.
    pub weight: Option<f64>,
    /// Number of independent tool motions, from 0 to 6.
    pub mobility: usize,
    /// Joints that the map fixes: they are not corrected.
    pub held: Vec<String>,
    /// Standard deviation of the tool point by the covariance and the random sources of the spec,
    /// root mean square over the rows, in the length unit; none if the spec states no covariance.
    pub deviation: Option<f64>,
    /// Rows outside the fitted ranges, with the uncertainty there; `None` if all rows are within
    /// them.
    pub extrapolated: Option<Extrapolation>,
    /// The targets are poses of the data.
    #[serde(skip)]
    pub of_poses: bool,
    /// Corrected rows, in file order.
    // Empty if `for_each_row` passed them on.
    pub rows: Vec<Row>,
    /// Summary of all rows.
    #[serde(skip)]
    pub row_summary: RowSummary,
    /// Rows that cannot be used, in file order.
    pub unusable: Vec<Unusable>,
    /// Stated date, persons and instruments, and the version of abbe; absent if nothing is stated.
    #[serde(skip_serializing_if = "RunRecord::is_empty")]
    pub record: RunRecord,
    /// Summary of the data file.
    #[serde(skip)]
    pub file: Summary,
    /// Names of the stations.
    #[serde(skip)]
    pub stations: Vec<String>,
}

/// Summary of corrected rows, of constant size.
#[derive(Debug, Default)]
pub struct RowSummary {
    /// Number of rows.
    pub rows: usize,
    /// First rows.
    pub first: Vec<Row>,
    /// Number of rows not compensated within the tolerance.
    pub failed: usize,
    /// First such rows: line and reason.
    pub reasons: Vec<(u64, String)>,
    /// Number of rows in which a joint rotates far from its command.
    pub far: usize,
    /// Line with the largest rotation of a joint, and that rotation in rad.
    pub farthest: Option<(u64, f64)>,
    /// Number of rows with a larger orientation error than before.
    pub turned: usize,
    /// Line with the largest of them, and these errors before and after in rad.
    pub most_turned: Option<(u64, [f64; 2])>,
}

impl RowSummary {
    /// Number of rows and reasons that are kept.
    const SHOWN: usize = 10;
    /// Rotation of a joint, in degrees, above which it counts as far.
    pub const FAR: f64 = 10.0;
    /// Increase of the orientation error, in rad, from which it counts.
    const TURNED: f64 = 1e-5;

    fn add(&mut self, row: &Row) {
        self.rows += 1;
        if self.first.len() < Self::SHOWN {
            self.first.push(row.clone());
        }
        if let Some(reason) = &row.reason {
            self.failed += 1;
            if self.reasons.len() < Self::SHOWN {
                self.reasons.push((row.line, reason.clone()));
            }
        }
        let [before, after] = [row.before.angle, row.after.angle];
        if after > before + Self::TURNED {
            self.turned += 1;
            if self.most_turned.is_none_or(|(_, [_, most])| after > most) {
                self.most_turned = Some((row.line, [before, after]));
            }
        }
        if row.largest_turn > Self::FAR.to_radians() {
            self.far += 1;
            if self.farthest.is_none_or(|(_, turn)| row.largest_turn >= turn) {
                self.farthest = Some((row.line, row.largest_turn));
            }
        }
    }
}

/// Statistics of the norms of ΔX: lengths in the spec's unit, angles in rad.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct NormStatistics {
    /// Mean distance of the tool point from its target.
    pub mean: f64,
    /// Root mean square distance.
    pub rms: f64,
    /// Largest distance.
    pub max: f64,
    /// Largest rotation of the tool from its target, in rad.
    pub angle_max: f64,
}

impl NormStatistics {
    fn new([lengths, angles]: &[RunningSums; 2]) -> Self {
        Self { mean: lengths.mean, rms: lengths.rms(), max: lengths.max, angle_max: angles.max }
    }
}

impl Compensate {
    /// Returns the options that the figures depend on.
    fn options(&self) -> Vec<(&'static str, String)> {
        let Self { machine, map: _, data: _, poses, tolerance, weight } = self;
        let poses = if *poses { "yes" } else { "" };
        let [tolerance, weight] = [Some(*tolerance), *weight]
            .map(|size| size.map_or(String::new(), |size| number::length(size, machine.spec.length)));
        machine.options_with([("poses", poses.to_owned()), ("tolerance", tolerance), ("weight", weight)])
    }

    /// Corrects all rows and returns them in the report.
    pub fn run(&self, notes: &mut dyn Notes) -> Result<Report> {
        let mut rows = Vec::new();
        let report = self.for_each_row(notes, |row| {
            rows.push(row);
            Ok::<_, Diagnostics>(())
        })?;
        Ok(Report { rows, ..report })
    }

    /// Corrects each row and passes it to `take`, so that memory use does not grow with the file.
    /// The report contains no rows.
    pub fn for_each_row<E: From<Diagnostics>>(
        &self,
        notes: &mut dyn Notes,
        mut take: impl FnMut(Row) -> Result<(), E>,
    ) -> Result<Report, E> {
        let Self { machine, map, tolerance, weight, .. } = self;
        map.require_joints("a compensation")?;
        if self.poses {
            check_poses(map)?;
        }
        // The search tries commands beyond the limits.
        let machine = machine.with_held_tables();
        let (spec, held) = with_held_joints(&machine.spec, map);
        let manipulator = match held.is_empty() {
            true => machine.evaluator(true),
            false => Evaluator::Interpreted(Box::new(Interpreter::new(spec))),
        };
        let data = self.data.completed(map, &*manipulator, &machine.spec);
        let configurations = || data.observations.iter().map(|row| (&row.q[..], &row.u[..]));
        let extrapolated =
            warn_of_extrapolation(&machine.spec, &*manipulator, &[[0.0; 3]], "rows", configurations(), notes);
        let deviation =
            ToolPointDeviation::at(&machine.spec, &*manipulator, &configurations().collect::<Vec<_>>());
        let task = Task::new(&*manipulator, self.poses, *tolerance, *weight)?;
        let base_frame = BaseFramePoses::new(map, &data);
        let (mut row_summary, mut norms) = (RowSummary::default(), [[RunningSums::default(); 2]; 2]);
        let mut unusable = data.unusable.clone();
        rows::correct_all(&task, &data, &base_frame, notes, |found| {
            match found {
                Ok(row) => {
                    let row = finite(&self.data.file, row)?;
                    row_summary.add(&row);
                    for (sums, ErrorNorms { length, angle }) in norms.iter_mut().zip([row.before, row.after])
                    {
                        sums[0].add(length);
                        sums[1].add(angle);
                    }
                    take(row)?;
                }
                Err(row) => unusable.push(row),
            }
            Ok::<_, E>(())
        })?;
        unusable.sort_by_key(|row| row.line);
        if row_summary.rows == 0 {
            return Err(rows::no_row_compensated(&data, &unusable).into());
        }
        let report = Report {
            name: machine.spec.name.clone(),
            length: machine.spec.length.symbol(),
            compensated: row_summary.rows - row_summary.failed,
            tolerance: *tolerance,
            weight: *weight,
            mobility: task.mobility,
            held,
            deviation,
            of_poses: self.poses,
            extrapolated,
            before: NormStatistics::new(&norms[0]),
            after: NormStatistics::new(&norms[1]),
            file: Summary { rows: row_summary.rows, unusable: unusable.clone(), ..data.summary() },
            unusable,
            record: map.record.with_options(self.options()),
            stations: data.stations.clone(),
            rows: Vec::new(),
            row_summary,
        };
        Ok(finite(&self.data.file, report)?)
    }

    /// Returns the heading of the table of corrected commands.
    pub fn heading(&self) -> Heading {
        let named = self.map.stations.column.is_some();
        let labels = if named { self.data.stations.clone() } else { Vec::new() };
        Heading { names: heading(&self.map), labels }
    }

    /// Returns the station name of a row; `None` if the data have no station column.
    pub fn label(&self, row: &Row) -> Option<&str> {
        let station = row.corrected.station as usize;
        self.map.stations.column.as_ref().map(|_| self.data.stations.get(station).map_or("", |name| name))
    }
}

/// Returns the spec with joints whose values the map fixes held there by their limits, and their
/// names.
fn with_held_joints(spec: &Spec, map: &Map) -> (Spec, Vec<String>) {
    let (mut spec, mut held) = (spec.clone(), Vec::new());
    for (variable, channel) in spec.variables.iter_mut().zip(&map.joints) {
        // A value beyond the limits stays a mistake of the rows.
        if let Channel::Fixed(value) = channel
            && (variable.limits[0]..=variable.limits[1]).contains(value)
        {
            variable.limits = [*value; 2];
            held.push(variable.name.clone());
        }
    }
    (spec, held)
}

/// Checks that a map describes poses in a known base frame.
pub fn check_poses(map: &Map) -> Result<()> {
    let is_base_known = map.base != Base::Unknown || !map.stations.stated.is_empty();
    if matches!(map.layout, Layout::Pose(..)) && is_base_known {
        return Ok(());
    }
    let help = format!("name the columns of position and orientation; or omit `{POSES}` to correct joints");
    Err(mistake::with_help(map.path(), format!("`{POSES}` needs a map with `[pose]`, in F_0"), help))
}

impl Report {
    /// Returns true if every row is compensated within the tolerance.
    pub fn complete(&self) -> bool {
        self.compensated == self.total_rows()
    }

    /// Returns the number of rows to compensate, unusable ones included.
    pub fn total_rows(&self) -> usize {
        self.row_summary.rows + self.unusable.len()
    }

    /// Returns the position errors with the original and the corrected commands; `None` without
    /// rows.
    pub fn residuals(&self) -> Option<Residuals> {
        Residuals::new(Some("as commanded"), "corrected", &self.rows, |row| row.residual.clone())
    }

    /// Returns the corrected commands in the columns and units of the data, with the remaining
    /// errors.
    pub fn table(&self, map: &Map) -> Table {
        let rows = self.rows.iter().map(|row| row.numbers(map)).collect();
        let labels = map.labels(self.rows.iter().map(|row| &row.corrected), &self.stations);
        Table { heading: heading(map), rows, labels, ..Table::default() }
    }
}

fn heading(map: &Map) -> Vec<String> {
    let mut heading = map.heading(false);
    let added = ["line", "error_before", "error_after", "angle_before", "angle_after", "compensated"];
    heading.extend(added.map(str::to_owned));
    heading
}

impl Row {
    /// Returns the corrected command in the columns and units of the data, with the remaining
    /// errors.
    pub fn numbers(&self, map: &Map) -> Vec<Option<f64>> {
        let mut values = map.numbers(&self.corrected, [0.0; 3], false);
        let done = f64::from(u8::from(self.reason.is_none()));
        let Self { line, before, after, .. } = self;
        let added = [*line as f64, before.length, after.length, before.angle, after.angle, done];
        values.extend(added.map(Some));
        values
    }
}
