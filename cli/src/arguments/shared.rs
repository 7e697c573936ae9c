//! Arguments that several commands have.

// Flattened structs have no doc comments: clap would show them in place of the command's own.

use std::ffi::OsString;
use std::io::stdout;
use std::path::{Path, PathBuf};

use abbe_report::Document;
use abbe_report::text::{Detail, next};
use abbe_spec::{Diagnostics, Spec};
use abbe_study::{Machine, RunRecord, Study, analyze::parts::Change, check_date, options::THREADS};
use clap::{Args, ValueHint};
use serde::Serialize;

use super::values::whole;
use crate::Result;
use crate::failure::Failure;
use crate::output::{json, note};
use crate::signs::has_plain_signs;

// Machine to work on.
#[derive(Args, Debug)]
pub(crate) struct Subject {
    /// Path of a spec file (TOML), or name of a shipped manipulator
    #[arg(value_hint = ValueHint::FilePath)]
    spec: OsString,
    #[command(flatten)]
    pub(crate) changes: Changes,
}

// Listed after the other options.
#[derive(Args, Debug)]
pub(crate) struct Changes {
    /// Set a parameter or an input: `--set x=250mm`
    #[arg(long, value_name = "NAME=VALUE", display_order = 100)]
    set: Vec<String>,
    /// Enable an error source
    #[arg(long, value_name = "SOURCE", display_order = 101)]
    enable: Vec<String>,
    /// Disable an error source
    #[arg(long, value_name = "SOURCE", display_order = 102)]
    disable: Vec<String>,
    /// Multiply the errors of a source: `--scale gear=0.5`
    #[arg(long, value_name = "SOURCE=FACTOR", display_order = 103)]
    scale: Vec<String>,
}

impl Changes {
    /// Reads the changes. Diagnostics point into the options.
    pub(crate) fn read(&self, spec: &Spec) -> Result<abbe_study::Changes, Diagnostics> {
        let Self { set, enable, disable, scale } = self;
        abbe_study::Changes::read([set, enable, disable, scale], spec)
    }
}

impl Subject {
    /// Returns the changes, one per option: first `--set`, then `--enable`, `--disable` and
    /// `--scale`.
    pub(crate) fn each_change(&self) -> Vec<Change> {
        let Changes { set, enable, disable, scale } = &self.changes;
        let set = set.iter().cloned().map(Change::Set);
        let enable = enable.iter().cloned().map(Change::Enable);
        let disable = disable.iter().cloned().map(Change::Disable);
        set.chain(enable).chain(disable).chain(scale.iter().cloned().map(Change::Scale)).collect()
    }

    /// Reads the machine without the changes.
    pub(crate) fn as_written(&self) -> Result<Machine, Diagnostics> {
        Machine::find(&self.spec)
    }

    /// Reads the machine and applies the changes.
    pub(crate) fn machine(&self) -> Result<Machine, Diagnostics> {
        let mut machine = self.as_written()?;
        machine.change(&self.changes.read(&machine.spec)?);
        Ok(machine)
    }
}

// Measurements and their map.
#[derive(Args, Debug)]
pub(crate) struct Measured {
    /// Measurements: a CSV file
    #[arg(value_hint = ValueHint::FilePath)]
    pub(crate) data: PathBuf,
    /// Map (TOML) that describes the columns, or name of a shipped map
    #[arg(long, value_name = "FILE")]
    pub(crate) map: PathBuf,
}

// HTML page of a report.
#[derive(Args, Debug)]
pub(crate) struct Page {
    /// Write an HTML page with figures to this file; it needs no network
    #[arg(long, value_name = "FILE", display_order = 90)]
    pub(crate) report: Option<PathBuf>,
    #[command(flatten)]
    pub(crate) dated: Dated,
}

// Date of a report.
#[derive(Args, Debug)]
pub(crate) struct Dated {
    /// Date of the report, such as 2026-03-14, instead of the date in the map's [record]. The clock
    /// is never read. [default: none]
    #[arg(long, value_name = "DATE", value_parser = check_date, display_order = 91)]
    date: Option<String>,
}

impl Dated {
    /// Replaces the date of a record, if one is given.
    pub(crate) fn date(&self, record: &mut RunRecord) {
        *record = std::mem::take(record).dated(self.date.as_ref());
    }
}

// Overwriting of files.
#[derive(Args, Debug)]
pub(crate) struct Writing {
    /// Replace files that abbe did not write or that were changed since; inputs of the run are
    /// never replaced
    #[arg(long, display_order = 92)]
    pub(crate) force: bool,
}

// How much is printed, and in which form.
#[derive(Args, Debug)]
pub(crate) struct Showing {
    /// Print every table and sentence, not only the answer
    #[arg(long, display_order = 109, conflicts_with = "json")]
    full: bool,
    /// Print the report as JSON
    #[arg(long, display_order = 111)]
    pub(crate) json: bool,
}

impl Showing {
    /// Returns the text of a report, in signs that the terminal has.
    pub(crate) fn text(&self, document: Document) -> String {
        let is_plain = has_plain_signs(&stdout());
        let document = if is_plain { document.in_plain_signs() } else { document };
        document.text(self.detail())
    }

    pub(crate) fn detail(&self) -> Detail {
        Detail::new(self.full)
    }

    /// Returns what a command prints: as JSON the numbers and the sentences, otherwise the text and
    /// what to do next.
    pub(crate) fn answer<R: Serialize>(&self, report: &R, document: Document, next: &str) -> Result<String> {
        if self.json { json(&document.worded(report)) } else { Ok(self.text(document) + &self.next(next)) }
    }

    /// Returns the line that says what to do next; nothing below a full report.
    fn next(&self, text: &str) -> String {
        match self.detail() {
            Detail::Answer => next(text),
            Detail::Full => String::new(),
        }
    }
}

// Execution of a job.
#[derive(Args, Debug)]
pub(crate) struct Running {
    /// Number of threads; the results do not depend on it. [default: all cores]
    #[arg(long, value_name = "N", display_order = 110, value_parser = whole(THREADS))]
    threads: Option<usize>,
}

impl Running {
    /// Sets the number of threads. Must be called once, before the job starts.
    pub(crate) fn start(&self) -> Result<()> {
        let Some(threads) = self.threads else { return Ok(()) };
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads);
        pool.build_global().map_err(|error| Failure::new("--threads", error))
    }
}

// What most commands have after their own options.
#[derive(Args, Debug)]
pub(crate) struct Common {
    #[command(flatten)]
    pub(crate) writing: Writing,
    #[command(flatten)]
    pub(crate) showing: Showing,
    #[command(flatten)]
    pub(crate) running: Running,
}

/// Returns the given study, or the one that belongs to the machine. A study found beside the spec
/// is named in a note.
pub(crate) fn study(
    file: Option<&Path>,
    tolerances: &[String],
    machine: &Machine,
) -> Result<Study, Diagnostics> {
    let mut study = Study::find(file, machine)?;
    if let (None, Some(beside)) = (file, Study::beside(machine)) {
        note(&format!("note: using the study {} beside the spec", beside.display()));
    }
    study.limit(tolerances, &machine.spec)?;
    Ok(study)
}
