//! Joint commands that put the real tool where the ideal one should be.

mod commands;
mod reason;
mod rows;

use abbe::Pose;
use abbe::identify::{Figures, Measurement};
use abbe_codegen::diagnostic::Diagnostics;
use serde::Serialize;

use crate::data::{Base, Data, Map, Summary, Table, Unusable};
use crate::extrapolated::{Extrapolated, extrapolated};
use crate::{Machine, Notes, finite, mistake};

pub use commands::{Command, Commands};
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
    /// Row by row.
    pub rows: Vec<Row>,
    /// Rows that cannot be used.
    pub unusable: Vec<Unusable>,
    /// The file.
    #[serde(skip)]
    pub file: Summary,
    /// The names of its stations.
    #[serde(skip)]
    pub stations: Vec<String>,
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

impl Size {
    fn new(norms: impl Iterator<Item = Norms>) -> Self {
        let (lengths, angles): (Vec<f64>, Vec<f64>) = norms.map(|norms| (norms.length, norms.angle)).unzip();
        let Figures { mean, rms, max, .. } = Figures::from_norms(lengths);
        Self { mean, rms, max, angle_max: angles.into_iter().fold(0.0, f64::max) }
    }
}

impl Compensate {
    /// Corrects row by row.
    pub fn run(&self, notes: &mut dyn Notes) -> Result<Report, Diagnostics> {
        let Self { machine, map, tolerance, .. } = self;
        if self.poses {
            check_poses(map)?;
        }
        let manipulator = machine.evaluator(true);
        let mut data = self.data.completed(map, &*manipulator, &machine.spec).into_owned();
        in_f0(map, &mut data);
        let places = data.observations.iter().map(|row| (&row.q[..], &row.u[..]));
        let extrapolated = extrapolated(&machine.spec, &*manipulator, "rows", places, notes);
        let task = Task::new(&*manipulator, self.poses, *tolerance)?;
        let rows = rows::rows(&task, &mut data, notes)?;
        let report = Report {
            name: machine.spec.name.clone(),
            length: machine.spec.length.symbol(),
            compensated: rows.iter().filter(|row| row.reason.is_none()).count(),
            tolerance: *tolerance,
            mobility: task.mobility,
            extrapolated,
            before: Size::new(rows.iter().map(|row| row.before)),
            after: Size::new(rows.iter().map(|row| row.after)),
            file: Summary { rows: rows.len(), ..data.summary() },
            unusable: data.unusable,
            stations: data.stations,
            rows,
        };
        finite(&self.data.file, report)
    }
}

/// Poses as the tool has them in `F_0`: without the station from where they are seen and what is mounted on the tool.
fn in_f0(map: &Map, data: &mut Data) {
    let stands = |station: usize| data.stations.get(station).and_then(|name| map.stations.pose(name));
    let stations: Vec<Pose> =
        (0..data.stations.len().max(1)).map(|i| stands(i).unwrap_or(Pose::IDENTITY).inverse()).collect();
    let mounting = map.mounting().inverse();
    for row in &mut data.observations {
        if let Measurement::Pose(pose) = &mut row.measured {
            *pose = stations[row.station].then(pose).then(&mounting);
        }
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
        self.compensated == self.rows.len() + self.unusable.len()
    }

    /// The corrected commands in the columns and units of the data, and what they leave.
    pub fn table(&self, map: &Map) -> Table {
        let mut heading = map.heading(false);
        let added = ["line", "error_before", "error_after", "angle_before", "angle_after", "compensated"];
        heading.extend(added.map(str::to_owned));
        let rows = self.rows.iter().map(|row| {
            let mut values = map.numbers(&row.corrected, [0.0; 3], false);
            let done = f64::from(u8::from(row.reason.is_none()));
            let Row { line, before, after, .. } = row;
            let added = [*line as f64, before.length, after.length, before.angle, after.angle, done];
            values.extend(added.map(Some));
            values
        });
        let labels = map.labels(self.rows.iter().map(|row| &row.corrected), &self.stations);
        Table { heading, rows: rows.collect(), labels }
    }
}
