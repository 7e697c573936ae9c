//! What was found of a machine, in the files that controllers and other programs load.
//!
//! `found` is the machine as its repeatable sources have it, exactly, and what stays the same of its errors.
//! Each format writes its text from that, reads the text back as whoever loads it would, and [`Difference`] is what remains.

mod dh;
mod difference;
mod found;
mod isg_csv;
mod linuxcnc;
mod origins;
mod slides;
mod table;
mod turning;
mod ur_calibration;
mod urdf;

use std::ops::RangeInclusive;
use std::path::PathBuf;

use abbe_spec::diagnostic::Diagnostics;
use serde::Serialize;

pub use self::difference::{Difference, Figure};
use self::found::Found;
pub use self::turning::Turning;
use crate::finite;
use crate::machine::Machine;
use crate::notes::Notes;
use crate::number::digits;

/// How many configurations the differences are of, if nobody says.
pub const SAMPLES: usize = 1000;

/// How many they may be of.
pub const SAMPLES_RANGE: RangeInclusive<usize> = 1..=1_000_000;

/// What is the file of this machine in another format?
#[derive(Clone)]
pub struct Export {
    /// The machine: its repeatable sources are its errors.
    pub machine: Machine,
    /// What is to be written.
    pub format: Format,
    /// Over how many random configurations the differences are taken.
    pub samples: usize,
    /// Of these configurations.
    pub seed: u64,
}

/// What a machine can be exported to.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Format {
    /// A table of Denavit-Hartenberg numbers, CSV.
    Dh,
    /// A URDF file with the origins of the real robot.
    Urdf {
        /// The file of the nominal robot.
        file: PathBuf,
        /// The link that is `F_0`; the root if not given.
        base: Option<String>,
        /// The link whose frame is the tool point; the only last one if not given.
        tip: Option<String>,
    },
    /// The calibration of an arm of Universal Robots, YAML.
    UrCalibration,
    /// Tables of volumetric compensation of TwinCAT CNC and of the ISG kernel.
    IsgCsv {
        /// How many values of each axis.
        nodes: usize,
    },
    /// Files of compensation of LinuxCNC, one for each axis.
    LinuxCnc {
        /// How many values of each axis.
        nodes: usize,
    },
    /// Corrections of the joints on a grid.
    Table {
        /// How many values of each joint; as many as make about 10,000 in all, if nobody says.
        nodes: Option<usize>,
    },
}

impl Format {
    /// The names of all of them.
    pub const NAMES: [&str; 6] = ["dh", "urdf", "ur-calibration", "isg-csv", "linuxcnc", "table"];

    /// How many values a table over one axis has, if nobody says.
    pub const NODES: usize = 101;

    /// How many it may have.
    pub const NODES_RANGE: RangeInclusive<usize> = 2..=1_000_000;

    /// The names of those that have nodes.
    pub const WITH_NODES: [&str; 3] = ["isg-csv", "linuxcnc", "table"];
}

/// A file to be written.
#[derive(Clone, Debug, Serialize)]
pub struct ExportedFile {
    /// What it is called in a folder.
    pub name: String,
    /// All of it.
    pub text: String,
}

/// Files in another format, and how good they are.
#[derive(Clone, Debug, Serialize)]
pub struct Report {
    /// The machine's name.
    pub name: String,
    /// The format's name, and which kind of it.
    pub format: String,
    /// The length unit of the differences.
    pub length: &'static str,
    /// What is written: one file, or several that belong together.
    pub files: Vec<ExportedFile>,
    /// What is changed in a file that was given, as a diff shows it.
    pub changes: Vec<String>,
    /// What the format cannot hold, in sentences.
    pub left_out: Vec<String>,
    /// What the differences are, in words: of which tool from where.
    pub compared: [&'static str; 2],
    /// As the machine is without the export.
    pub before: Difference,
    /// What remains at the nodes of a table; `remains` is between them.
    pub at_nodes: Option<Difference>,
    /// What remains when the files are loaded and used.
    pub remains: Difference,
    /// What remains when the control knows where the axes stand that turn the workpiece, too; none where nothing does.
    pub placed: Option<Difference>,
    /// These axes.
    pub turned: Vec<Turning>,
    /// Over how many configurations.
    pub configurations: usize,
    /// Which ones.
    pub seed: u64,
    /// The sign, shown by a number of this machine.
    pub sign: String,
}

/// How the differences of a model are called: of what it says from where the tool really is.
const MODEL: [&str; 2] = ["nominal", "exported"];

/// How the differences of corrected commands are called: of where the tool really is from where it should be.
const COMMANDS: [&str; 2] = ["as commanded", "corrected"];

impl Export {
    /// Writes the files as text, reads them back and compares.
    pub fn run(&self, notes: &mut dyn Notes) -> Result<Report, Diagnostics> {
        let Self { machine, format, samples, seed } = self;
        let found = Found::new(machine, *samples, *seed)?;
        if found.is_nominal() {
            notes.warn("this spec has no repeatable source: the nominal machine is exported");
        }
        let report = match format {
            Format::Dh => dh::report(&found)?,
            Format::Urdf { file, base, tip } => {
                urdf::report(&found, urdf::From { file, base: base.as_deref(), tip: tip.as_deref() })?
            }
            Format::UrCalibration => ur_calibration::report(&found)?,
            Format::IsgCsv { nodes } => isg_csv::report(&found, *nodes)?,
            Format::LinuxCnc { nodes } => linuxcnc::report(&found, *nodes)?,
            Format::Table { nodes } => table::report(&found, *nodes, notes)?,
        };
        let Report { before, remains, .. } = &report;
        if remains.position.rms > before.position.rms && !found.is_nominal() {
            let [before, remains] = [before, remains].map(|difference| digits(difference.position.rms, 3));
            notes.warn(&format!(
                "with this the tool is farther off than without, {remains} {unit} against {before} {unit} (rms): do not load it; a table needs more nodes, or \
                 joints with narrower `limits`",
                unit = report.length
            ));
        }
        finite(&machine.origin, report)
    }

    /// The files that it reads beside the spec.
    pub(crate) fn beside(&self) -> Vec<PathBuf> {
        match &self.format {
            Format::Urdf { file, .. } => vec![file.clone()],
            _ => Vec::new(),
        }
    }
}

/// A length or an angle as files have it: what is below 1e-15 is rounding.
fn written(value: f64) -> f64 {
    format!("{value:.15}").parse::<f64>().unwrap_or(value) + 0.0
}

/// What is said of the sign where nothing is wrong.
fn as_nominal() -> String {
    "Nothing is wrong with this machine: the numbers are the nominal ones.".to_owned()
}

/// A change below this, in any unit, is rounding.
const UNCHANGED: f64 = 1e-12;
