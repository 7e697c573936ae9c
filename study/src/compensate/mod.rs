//! Joint commands that put the real tool where the ideal one should be.

mod commands;
mod in_f0;
pub mod options;
mod reason;
mod rows;

use abbe_spec::diagnostic::Diagnostics;
use serde::Serialize;

use crate::data::{Base, Data, Heading, Map, Summary, Table, Unusable};
use crate::extrapolated::{Extrapolated, extrapolated};
use crate::{Machine, Notes, finite, mistake};

pub use commands::{Command, Commands};
use in_f0::InF0;
use rows::Task;
pub use rows::{Norms, Row};

/// Which commands compensate the errors of this machine?
pub struct Compensate {
    /// The machine: its repeatable sources are its errors.
    pub machine: Machine,
    /// What the columns of the data are.
    pub map: Map,
    /// The commands to be corrected.
    pub data: Data,
    /// Whether the tool is to be brought to the poses that the data have, from the joints of the row on.
    pub poses: bool,
    /// What may be left at the tool point, in the length unit; of an angle, 1 rad counts as 1 m.
    pub tolerance: f64,
}

/// Corrected commands.
#[derive(Debug, Serialize)]
pub struct Report {
    /// The machine's name.
    pub name: String,
    /// The length unit of everything.
    pub length: &'static str,
    /// How many rows are compensated to the tolerance.
    pub compensated: usize,
    /// What may be left at the tool point.
    pub tolerance: f64,
    /// The distance of the tool point from where it should be, with the commands as they were.
    pub before: Size,
    /// … and corrected.
    pub after: Size,
    /// In how many ways, of six, the machine can move its tool at once.
    pub mobility: usize,
    /// Rows outside the ranges that were fitted, and how well the machine is known there; nothing if there are none.
    pub extrapolated: Option<Extrapolated>,
    /// Row by row; nothing if they were given away.
    pub rows: Vec<Row>,
    /// What is to be said of all of them.
    #[serde(skip)]
    pub told: Told,
    /// Rows that cannot be used.
    pub unusable: Vec<Unusable>,
    /// The file.
    #[serde(skip)]
    pub file: Summary,
    /// The names of its stations.
    #[serde(skip)]
    pub stations: Vec<String>,
}

/// What is to be said of rows, however many there are.
#[derive(Debug, Default)]
pub struct Told {
    /// How many there are.
    pub rows: usize,
    /// The first of them.
    pub first: Vec<Row>,
    /// How many are not compensated.
    pub failed: usize,
    /// The first of those: line and reason.
    pub reasons: Vec<(u64, String)>,
    /// In how many a joint turns far from its command.
    pub far: usize,
    /// The line where one turns most, and by how much: rad.
    pub farthest: Option<(u64, f64)>,
}

impl Told {
    /// How many rows and reasons are told one by one.
    const SHOWN: usize = 10;
    /// Turns of a joint by more degrees than this are far.
    pub const FAR: f64 = 10.0;

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
        if row.largest_turn > Self::FAR.to_radians() {
            self.far += 1;
            if self.farthest.is_none_or(|(_, turn)| row.largest_turn >= turn) {
                self.farthest = Some((row.line, row.largest_turn));
            }
        }
    }
}

/// Figures of the norms of ΔX: lengths in the spec's unit, angles in rad.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct Size {
    /// The mean distance of the tool point.
    pub mean: f64,
    /// The root mean square.
    pub rms: f64,
    /// The largest.
    pub max: f64,
    /// The largest turn.
    pub angle_max: f64,
}

/// Sums of norms, of which their figures follow.
#[derive(Default)]
struct Sums {
    count: usize,
    lengths: f64,
    squares: f64,
    length_max: f64,
    angle_max: f64,
}

impl Sums {
    fn add(&mut self, Norms { length, angle }: Norms) {
        self.count += 1;
        self.lengths += length;
        self.squares += length * length;
        self.length_max = self.length_max.max(length);
        self.angle_max = self.angle_max.max(angle);
    }

    fn size(&self) -> Size {
        let n = self.count.max(1) as f64;
        let (mean, rms) = (self.lengths / n, (self.squares / n).sqrt());
        Size { mean, rms, max: self.length_max, angle_max: self.angle_max }
    }
}

impl Compensate {
    /// Corrects row by row.
    pub fn run(&self, notes: &mut dyn Notes) -> Result<Report, Diagnostics> {
        let mut rows = Vec::new();
        let report = self.each(notes, |row| {
            rows.push(row);
            Ok::<_, Diagnostics>(())
        })?;
        Ok(Report { rows, ..report })
    }

    /// Corrects row by row, and gives each away: no matter how many there are. The report has none of them.
    pub fn each<E: From<Diagnostics>>(
        &self,
        notes: &mut dyn Notes,
        mut take: impl FnMut(Row) -> Result<(), E>,
    ) -> Result<Report, E> {
        let Self { machine, map, tolerance, .. } = self;
        if self.poses {
            check_poses(map)?;
        }
        let manipulator = machine.evaluator(true);
        let data = self.data.completed(map, &*manipulator, &machine.spec);
        let places = data.observations.iter().map(|row| (&row.q[..], &row.u[..]));
        let extrapolated = extrapolated(&machine.spec, &*manipulator, "rows", places, notes);
        let task = Task::new(&*manipulator, self.poses, *tolerance)?;
        let in_f0 = InF0::new(map, &data);
        let (mut told, mut before, mut after) = (Told::default(), Sums::default(), Sums::default());
        let mut unusable = data.unusable.clone();
        rows::rows(&task, &data, &in_f0, notes, |found| {
            match found {
                Ok(row) => {
                    let row = finite(&self.data.file, row)?;
                    told.add(&row);
                    before.add(row.before);
                    after.add(row.after);
                    take(row)?;
                }
                Err(row) => unusable.push(row),
            }
            Ok::<_, E>(())
        })?;
        unusable.sort_by_key(|row| row.line);
        if told.rows == 0 {
            return Err(rows::nothing(&data, &unusable).into());
        }
        let report = Report {
            name: machine.spec.name.clone(),
            length: machine.spec.length.symbol(),
            compensated: told.rows - told.failed,
            tolerance: *tolerance,
            mobility: task.mobility,
            extrapolated,
            before: before.size(),
            after: after.size(),
            file: Summary { rows: told.rows, unusable: unusable.clone(), ..data.summary() },
            unusable,
            stations: data.stations.clone(),
            rows: Vec::new(),
            told,
        };
        Ok(finite(&self.data.file, report)?)
    }
}

/// Whether a map has poses to which the tool can be brought.
pub fn check_poses(map: &Map) -> Result<(), Diagnostics> {
    let known = map.base != Base::Unknown || !map.stations.stated.is_empty();
    if map.is_pose() && known {
        return Ok(());
    }
    let help = "name the columns of position and orientation; or leave `--poses` out to correct joints";
    Err(mistake::with_help(map.path(), "`--poses` needs a map with `[pose]`, in F_0", help))
}

impl Report {
    /// Whether every row is compensated.
    pub fn complete(&self) -> bool {
        self.compensated == self.asked()
    }

    /// How many rows were to be compensated, those that cannot be used among them.
    pub fn asked(&self) -> usize {
        self.told.rows + self.unusable.len()
    }

    /// The corrected commands in the columns and units of the data, and what they leave.
    pub fn table(&self, map: &Map) -> Table {
        let rows = self.rows.iter().map(|row| row.numbers(map)).collect();
        let labels = map.labels(self.rows.iter().map(|row| &row.corrected), &self.stations);
        Table { heading: heading(map), rows, labels }
    }
}

impl Compensate {
    /// What stands above the corrected commands.
    pub fn heading(&self) -> Heading {
        let named = self.map.stations.column.is_some();
        let labels = if named { self.data.stations.clone() } else { Vec::new() };
        Heading { names: heading(&self.map), labels }
    }

    /// The name of a row's station, if there is a column of these.
    pub fn label(&self, row: &Row) -> Option<&str> {
        let station = row.corrected.station as usize;
        let label = self.map.stations.column.as_ref();
        label.map(|_| self.data.stations.get(station).map_or("", |name| name))
    }
}

fn heading(map: &Map) -> Vec<String> {
    let mut heading = map.heading(false);
    let added = ["line", "error_before", "error_after", "angle_before", "angle_after", "compensated"];
    heading.extend(added.map(str::to_owned));
    heading
}

impl Row {
    /// The corrected command in the columns and units of the data, and what it leaves.
    pub fn numbers(&self, map: &Map) -> Vec<Option<f64>> {
        let mut values = map.numbers(&self.corrected, [0.0; 3], false);
        let done = f64::from(u8::from(self.reason.is_none()));
        let Self { line, before, after, .. } = self;
        let added = [*line as f64, before.length, after.length, before.angle, after.angle, done];
        values.extend(added.map(Some));
        values
    }
}
