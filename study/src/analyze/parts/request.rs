//! An analysis as data: its files and options, so that another machine can run it.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use abbe_spec::bounded::{Bounded, Contents, UnreadableFile};
use abbe_spec::{Document, Spec};
use serde::{Deserialize, Serialize};

use crate::{
    Changes, Machine, Notes, Result, Study, analyze::Analyze, analyze::options::DRAWS, hash, mistake,
};

/// Largest size of all files that a part carries, in bytes.
const LARGEST: u64 = 512 << 20;

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
    pub fn read(path: &Path) -> Result<Self> {
        Document::read(path).map(Self::new)
    }

    fn new(document: Document) -> Self {
        let folder = document.folder.map(|folder| folder.to_string_lossy().into_owned());
        Self { name: document.path, folder, text: document.text.to_string() }
    }

    fn document(&self, contents: Option<&Arc<Contents>>) -> Document {
        let mut document = Document::new(self.name.as_str(), self.text.as_str());
        document.contents = contents.cloned();
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
    /// `SOURCE=FACTOR`, a factor of the errors of a source.
    Scale(String),
    /// `NAME=VALUE`, with a plain number in coherent units.
    Number(String),
}

impl Change {
    /// Parses the change. Mistakes are reported under the options `--set`, `--enable`, `--disable`
    /// and `--scale`.
    pub fn read(&self, spec: &Spec) -> Result<Changes> {
        let one = std::slice::from_ref::<String>;
        match self {
            Self::Set(text) => Changes::read([one(text), &[], &[], &[]], spec),
            Self::Enable(source) => Changes::read([&[], one(source), &[], &[]], spec),
            Self::Disable(source) => Changes::read([&[], &[], one(source), &[]], spec),
            Self::Scale(text) => Changes::read([&[], &[], &[], one(text)], spec),
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
    /// Tolerances in place of those of the study, [`Study::limit`].
    pub tolerances: Vec<String>,
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
    pub fn new(machine: &Machine, study: Option<&Path>) -> Result<Self> {
        let file = machine.file.as_deref();
        let beside = Study::beside(machine);
        Ok(Self {
            spec: machine.origin.clone(),
            spec_text: file.map(FileText::read).transpose()?,
            study: study.or(beside.as_deref()).map(Study::document).transpose()?.map(FileText::new),
            tolerances: Vec::new(),
            changes: Vec::new(),
            monte_carlo: None,
            seed: None,
            interpret: false,
            figures: false,
        })
    }

    /// Checks the number of draws; returns a message if it is out of range.
    pub(super) fn check_draws(&self) -> Result<(), String> {
        match self.monte_carlo.filter(|draws| !DRAWS.contains(draws)) {
            None => Ok(()),
            Some(draws) => {
                Err(format!("it has {draws} draws; the number must be between 1 and {}", DRAWS.end()))
            }
        }
    }

    /// Returns the job that answers the question. Opens the tables and paths that the spec and the
    /// study name.
    pub fn job(&self, notes: &mut dyn Notes) -> Result<Analyze> {
        self.job_from(None, notes)
    }

    /// Returns the job that answers the question. Opens no file if the contents of the tables and
    /// paths are given.
    pub(super) fn job_from(
        &self,
        contents: Option<&Arc<Contents>>,
        notes: &mut dyn Notes,
    ) -> Result<Analyze> {
        let machine = match (&self.spec_text, Machine::named(&self.spec)?) {
            (Some(file), _) => Machine::of_spec(Spec::from_document(file.document(contents))?, &self.spec),
            (None, Some(shipped)) => shipped,
            (None, None) => {
                let help = "give the text of the spec, or the name of a shipped manipulator";
                let message = "there is no shipped manipulator of this name";
                return Err(mistake::with_help(&self.spec, message, help));
            }
        };
        let mut study = match &self.study {
            Some(file) => Study::read(file.document(contents), &machine.spec)?,
            None => Study::find(None, &machine)?,
        };
        study.limit(&self.tolerances, &machine.spec)?;
        let mut job = Analyze::new(machine, study);
        for change in &self.changes {
            job.change(&change.read(&job.machine().spec)?, notes);
        }
        job.monte_carlo = self.monte_carlo;
        job.seed = self.seed;
        job.interpret = self.interpret;
        job.figures = self.figures;
        Ok(job)
    }

    /// Returns the key that identifies the parts of one analysis: the SHA-256 of all file contents
    /// (tables and paths included) and options. File locations do not affect it. Opens no file if
    /// their contents are given.
    pub(super) fn identity(&self, job: &Analyze, contents: Option<&Contents>) -> Result<String> {
        let (spec, study) = (&job.machine().spec, job.study());
        let hash = |file: &PathBuf| match contents {
            None => hash::file(file),
            Some(contents) => Ok(hash::text(contents.get(&*file.to_string_lossy()).map_or("", |text| text))),
        };
        let beside = study.files.iter().map(hash).collect::<Result<Vec<_>, _>>()?;
        let texts = (&spec.hash, study.file.as_ref().map(|(_, hash)| hash), beside);
        let options =
            (&self.tolerances, &self.changes, self.monte_carlo, self.seed, self.interpret, self.figures);
        Ok(hash::text(&format!("{texts:?} {options:?}")))
    }
}

/// Reads the tables and paths that a job has read.
pub(super) fn contents(job: &Analyze) -> Result<Contents> {
    let (mut contents, mut left) = (Contents::new(), LARGEST);
    for file in job.machine().spec.beside.iter().chain(&job.study().files) {
        let bytes = Bounded::read_all(file, left).map_err(|error| {
            UnreadableFile::diagnostics(file.display(), &error, "give the path of a file")
        })?;
        let text = String::from_utf8(bytes).map_err(|_| {
            mistake::with_help(file.display(), "this file is not UTF-8 text", "save it as UTF-8")
        })?;
        left = left.saturating_sub(text.len() as u64);
        contents.insert(file.to_string_lossy().into_owned(), text);
    }
    Ok(contents)
}
