//! An analysis as data: its files and options, so that another machine can run it.

use std::path::Path;

use abbe_manipulators::SHIPPED;
use abbe_spec::Spec;
use abbe_spec::diagnostic::Diagnostics;
use abbe_spec::document::Document;
use serde::{Deserialize, Serialize};

use crate::analyze::Analyze;
use crate::analyze::options::DRAWS;
use crate::changes::Changes;
use crate::hash;
use crate::machine::Machine;
use crate::notes::Notes;
use crate::study_file::Study;

/// A file with its text.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct FileText {
    /// Name of the file in messages.
    pub name: String,
    /// Folder against which paths in the file are resolved; `None` if it may name no files.
    pub folder: Option<String>,
    /// Content of the file.
    pub text: String,
}

impl FileText {
    /// Reads a file.
    pub fn read(path: &Path) -> Result<Self, Diagnostics> {
        Document::read(path).map(Self::new)
    }

    fn new(document: Document) -> Self {
        let folder = document.folder.map(|folder| folder.to_string_lossy().into_owned());
        Self { name: document.path, folder, text: document.text.to_string() }
    }

    fn document(&self) -> Document {
        let mut document = Document::new(self.name.as_str(), self.text.as_str());
        document.folder = self.folder.as_ref().map(Into::into);
        document
    }
}

/// A change to the spec, as given by an option.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum Change {
    /// `NAME=VALUE`, with a unit or in the spec's coherent unit.
    Set(String),
    /// Name of a source to switch on.
    Enable(String),
    /// Name of a source to switch off.
    Disable(String),
    /// `NAME=VALUE`, with a plain number in coherent units.
    Number(String),
}

impl Change {
    /// Parses the change. Mistakes are reported under the options `--set`, `--enable` and
    /// `--disable`.
    pub fn read(&self, spec: &Spec) -> Result<Changes, Diagnostics> {
        let one = std::slice::from_ref::<String>;
        match self {
            Self::Set(text) => Changes::read(one(text), &[], &[], spec),
            Self::Enable(source) => Changes::read(&[], one(source), &[], spec),
            Self::Disable(source) => Changes::read(&[], &[], one(source), spec),
            Self::Number(text) => Changes::parse_number(text, spec),
        }
    }
}

/// An analysis: the texts of its files, and all its options.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct AnalysisRequest {
    /// Path of the spec, or name of a shipped manipulator.
    pub spec: String,
    /// Text of the spec; `None` for a shipped manipulator.
    pub spec_text: Option<FileText>,
    /// The study; `None` uses the one shipped with the manipulator, or joint samples.
    pub study: Option<FileText>,
    /// Changes to the spec, in order.
    pub changes: Vec<Change>,
    /// Number of Monte Carlo draws, [`Analyze::monte_carlo`].
    pub monte_carlo: Option<usize>,
    /// Seed, [`Analyze::seed`].
    pub seed: Option<u64>,
    /// Interprets the spec, [`Analyze::interpret`].
    pub interpret: bool,
    /// Gathers figure data, [`Analyze::figures`].
    pub figures: bool,
}

impl AnalysisRequest {
    /// Creates the question with default options. Uses the given study, or the one
    /// [`beside`](Study::beside) the spec.
    pub fn new(machine: &Machine, study: Option<&Path>) -> Result<Self, Diagnostics> {
        let file = machine.file.as_deref();
        let beside = Study::beside(machine);
        Ok(Self {
            spec: machine.origin.clone(),
            spec_text: file.map(FileText::read).transpose()?,
            study: study.or(beside.as_deref()).map(Study::document).transpose()?.map(FileText::new),
            changes: Vec::new(),
            monte_carlo: None,
            seed: None,
            interpret: false,
            figures: false,
        })
    }

    /// Checks the number of draws; returns a message if it is out of range.
    pub(super) fn check_draws(&self) -> Result<(), String> {
        match self.monte_carlo {
            None => Ok(()),
            Some(draws) if DRAWS.contains(&draws) => Ok(()),
            Some(draws) => {
                Err(format!("it has {draws} draws; the number must be between 1 and {}", DRAWS.end()))
            }
        }
    }

    /// Returns the job that answers the question.
    pub fn job(&self, notes: &mut dyn Notes) -> Result<Analyze, Diagnostics> {
        let machine = match &self.spec_text {
            Some(file) => Machine::of_spec(Spec::from_document(file.document())?, &self.spec),
            None => Machine::find(&self.spec)?,
        };
        let study = match &self.study {
            Some(file) => Study::read(file.document(), &machine.spec)?,
            None => Study::find(None, &machine)?,
        };
        let mut job = Analyze::new(machine, study);
        for change in &self.changes {
            let changes = change.read(&job.machine().spec)?;
            job.change(&changes, notes);
        }
        job.monte_carlo = self.monte_carlo;
        job.seed = self.seed;
        job.interpret = self.interpret;
        job.figures = self.figures;
        Ok(job)
    }

    /// Returns the key that identifies the parts of one analysis: the SHA-256 of all file contents
    /// (tables and paths included) and options. File locations do not affect it.
    pub(super) fn identity(&self, job: &Analyze) -> Result<String, Diagnostics> {
        let (spec, study) = (&job.machine().spec, job.study());
        let beside = study.files.iter().map(|file| hash::file(file)).collect::<Result<Vec<_>, _>>()?;
        let texts = (&spec.hash, study.file.as_ref().map(|(_, hash)| hash), beside);
        let options = (&self.changes, self.monte_carlo, self.seed, self.interpret, self.figures);
        Ok(hash::text(&format!("{texts:?} {options:?}")))
    }

    /// Returns true if the spec is a shipped one.
    pub fn is_shipped(&self) -> bool {
        SHIPPED.iter().any(|shipped| shipped.name == self.spec) && self.spec_text.is_none()
    }
}
