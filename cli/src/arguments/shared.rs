//! What several commands are told.

// No documentation comments on what is flattened: they would stand in place of the command's own.

use std::ffi::OsString;
use std::path::{Path, PathBuf};

use abbe_spec::Spec;
use abbe_spec::diagnostic::Diagnostics;
use abbe_study::analyze::parts::Change;
use abbe_study::options::THREADS;
use abbe_study::{Machine, Study};
use clap::{Args, ValueHint};

use super::values::whole;
use crate::failure::Failure;
use crate::output::note;

// The machine that a command is about.
#[derive(Args, Debug)]
pub(crate) struct Subject {
    /// Spec file, or shipped name
    #[arg(value_hint = ValueHint::FilePath)]
    spec: OsString,
    #[command(flatten)]
    changes: Changes,
}

// At the end of the options.
#[derive(Args, Debug)]
struct Changes {
    /// Set a parameter or an input: `--set x=250mm`
    #[arg(long, value_name = "NAME=VALUE", display_order = 100)]
    set: Vec<String>,
    /// Switch an error source on
    #[arg(long, value_name = "SOURCE", display_order = 101)]
    enable: Vec<String>,
    /// Switch an error source off
    #[arg(long, value_name = "SOURCE", display_order = 102)]
    disable: Vec<String>,
}

impl Subject {
    /// The changes, one by one.
    pub(crate) fn each_change(&self) -> Vec<Change> {
        let Changes { set, enable, disable } = &self.changes;
        let set = set.iter().cloned().map(Change::Set);
        let enable = enable.iter().cloned().map(Change::Enable);
        set.chain(enable).chain(disable.iter().cloned().map(Change::Disable)).collect()
    }

    /// The machine as its spec has it.
    pub(crate) fn as_written(&self) -> Result<Machine, Diagnostics> {
        Machine::find(&self.spec)
    }

    /// What is changed; the options are where mistakes are shown.
    pub(crate) fn changes(&self, spec: &Spec) -> Result<abbe_study::Changes, Diagnostics> {
        let Changes { set, enable, disable } = &self.changes;
        abbe_study::Changes::read(set, enable, disable, spec)
    }

    /// The machine with the changes.
    pub(crate) fn machine(&self) -> Result<Machine, Diagnostics> {
        let mut machine = self.as_written()?;
        machine.change(&self.changes(&machine.spec)?);
        Ok(machine)
    }
}

// What was measured.
#[derive(Args, Debug)]
pub(crate) struct Measured {
    /// Measurements: a CSV file
    #[arg(value_hint = ValueHint::FilePath)]
    pub(crate) data: PathBuf,
    /// What the columns are: a map (TOML), or the name of a shipped one
    #[arg(long, value_name = "FILE")]
    pub(crate) map: PathBuf,
}

// A page for people.
#[derive(Args, Debug)]
pub(crate) struct Page {
    /// Write a page with pictures: an HTML file that needs no network
    #[arg(long, value_name = "FILE", display_order = 90)]
    pub(crate) report: Option<PathBuf>,
    /// The date that the page shows; it knows no clock
    #[arg(long, value_name = "DATE", requires = "report", display_order = 91)]
    pub(crate) date: Option<String>,
}

// How files are written.
#[derive(Args, Debug)]
pub(crate) struct Writing {
    /// Replace files that abbe did not write, or that were changed since; never one that this run reads
    #[arg(long, display_order = 92)]
    pub(crate) force: bool,
}

// How a job is run, and what it prints.
#[derive(Args, Debug)]
pub(crate) struct Running {
    /// How many threads work; the results are the same for any number. All cores if not given
    #[arg(long, value_name = "N", display_order = 110, value_parser = whole(THREADS))]
    threads: Option<usize>,
    /// Print JSON
    #[arg(long, display_order = 111)]
    pub(crate) json: bool,
}

impl Running {
    /// Sets the number of threads; to be called once, before there is work.
    pub(crate) fn start(&self) -> Result<(), Failure> {
        let Some(threads) = self.threads else { return Ok(()) };
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads);
        pool.build_global().map_err(|error| Failure::of("--threads", error))
    }
}

/// The study that is given, or the one that belongs to the machine; one that was found beside its spec is named.
pub(crate) fn study(file: Option<&Path>, machine: &Machine) -> Result<Study, Diagnostics> {
    let study = Study::find(file, machine)?;
    if let (None, Some(beside)) = (file, Study::beside(machine)) {
        note(&format!("note: the study is {}, beside the spec", beside.display()));
    }
    Ok(study)
}
