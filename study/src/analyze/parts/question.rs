//! What is asked, so that it can be asked again elsewhere.

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
pub struct Written {
    /// What messages call it.
    pub name: String,
    /// The folder where the files are that it names, if it may name any.
    pub folder: Option<String>,
    /// What is in it.
    pub text: String,
}

impl Written {
    /// Reads a file.
    pub fn read(path: &Path) -> Result<Self, Diagnostics> {
        let document = Document::read(path)?;
        let folder = document.folder.map(|folder| folder.to_string_lossy().into_owned());
        Ok(Self { name: document.path, folder, text: document.text.to_string() })
    }

    fn document(&self) -> Document {
        let mut document = Document::new(self.name.as_str(), self.text.as_str());
        document.folder = self.folder.as_ref().map(Into::into);
        document
    }
}

/// A change to the spec, as options say it.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum Change {
    /// `NAME=VALUE`, with a unit or in the spec's.
    Set(String),
    /// A source to switch on.
    Enable(String),
    /// A source to switch off.
    Disable(String),
    /// `NAME=VALUE`, a number in coherent units.
    Number(String),
}

impl Change {
    /// Reads the change. Mistakes are shown as those of the options `--set`, `--enable` and `--disable`.
    pub fn read(&self, spec: &Spec) -> Result<Changes, Diagnostics> {
        let one = std::slice::from_ref::<String>;
        match self {
            Self::Set(text) => Changes::read(one(text), &[], &[], spec),
            Self::Enable(source) => Changes::read(&[], one(source), &[], spec),
            Self::Disable(source) => Changes::read(&[], &[], one(source), spec),
            Self::Number(text) => Changes::number(text, spec),
        }
    }
}

/// An analysis with the texts of its files and all its options.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Question {
    /// The path of the spec, or the shipped name.
    pub spec: String,
    /// Its text; none of a shipped manipulator.
    pub spec_text: Option<Written>,
    /// The study; if there is none, that which is shipped with the manipulator, or joint samples.
    pub study: Option<Written>,
    /// What differs from the spec, in order.
    pub changes: Vec<Change>,
    /// As in [`Analyze`].
    pub monte_carlo: Option<usize>,
    /// As in [`Analyze`].
    pub seed: Option<u64>,
    /// As in [`Analyze`].
    pub interpret: bool,
    /// As in [`Analyze`].
    pub figures: bool,
}

impl Question {
    /// Of a manipulator: with the study that is given, or [`beside`](Study::beside) the spec, and no options.
    pub fn new(machine: &Machine, study: Option<&Path>) -> Result<Self, Diagnostics> {
        let file = machine.file.as_deref();
        let beside = Study::beside(machine);
        Ok(Self {
            spec: machine.origin.clone(),
            spec_text: file.map(Written::read).transpose()?,
            study: study.or(beside.as_deref()).map(Written::read).transpose()?,
            changes: Vec::new(),
            monte_carlo: None,
            seed: None,
            interpret: false,
            figures: false,
        })
    }

    /// What is wrong with the number of draws, if anything is.
    pub(super) fn check_draws(&self) -> Result<(), String> {
        match self.monte_carlo {
            None => Ok(()),
            Some(draws) if DRAWS.contains(&draws) => Ok(()),
            Some(draws) => Err(format!("it asks for {draws} draws: from 1 to {} are made", DRAWS.end())),
        }
    }

    /// The job that answers it.
    pub fn job(&self, notes: &mut dyn Notes) -> Result<Analyze, Diagnostics> {
        let machine = match &self.spec_text {
            Some(written) => Machine::of_spec(Spec::from_document(written.document())?, &self.spec),
            None => Machine::find(&self.spec)?,
        };
        let study = match &self.study {
            Some(written) => Study::read(written.document(), &machine.spec)?,
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

    /// By which parts of the same analysis are known: the SHA-256 of what is in the files, tables and paths among them, and of
    /// the options; not of where the files are.
    pub(super) fn identity(&self, job: &Analyze) -> Result<String, Diagnostics> {
        let (spec, study) = (&job.machine().spec, job.study());
        let beside = study.files.iter().map(|file| hash::of_file(file)).collect::<Result<Vec<_>, _>>()?;
        let texts = (&spec.hash, study.file.as_ref().map(|(_, hash)| hash), beside);
        let options = (&self.changes, self.monte_carlo, self.seed, self.interpret, self.figures);
        Ok(hash::of_text(&format!("{texts:?} {options:?}")))
    }

    /// Whether the spec is a shipped one.
    pub fn is_shipped(&self) -> bool {
        SHIPPED.iter().any(|shipped| shipped.name == self.spec) && self.spec_text.is_none()
    }
}
