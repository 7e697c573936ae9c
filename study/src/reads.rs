//! Input files of jobs, which output must not overwrite.

use std::path::PathBuf;

use crate::check::Check;
use crate::export::Export;
use crate::generate::Generate;
use crate::import::Import;
use crate::jacobian::Jacobian;
use crate::machine::Machine;
use crate::study_file::Study;

/// Access to the files that an input was read from.
pub trait Reads {
    /// Returns the files, in any order. Shipped files are not included.
    fn files(&self) -> Vec<PathBuf>;
}

impl Reads for () {
    fn files(&self) -> Vec<PathBuf> {
        Vec::new()
    }
}

/// Files that are listed individually.
impl Reads for Vec<PathBuf> {
    fn files(&self) -> Vec<PathBuf> {
        self.clone()
    }
}

impl Reads for Machine {
    fn files(&self) -> Vec<PathBuf> {
        self.file.iter().chain(&self.spec.beside).cloned().collect()
    }
}

impl Reads for Study {
    fn files(&self) -> Vec<PathBuf> {
        self.files.clone()
    }
}

// The patterns name every field, so that a new field does not compile until its files are
// considered.

impl Reads for Check {
    fn files(&self) -> Vec<PathBuf> {
        let Self { machine } = self;
        machine.files()
    }
}

impl Reads for Export {
    fn files(&self) -> Vec<PathBuf> {
        let Self { machine, format: _, samples: _, seed: _ } = self;
        [machine.files(), self.beside()].concat()
    }
}

impl Reads for Generate {
    fn files(&self) -> Vec<PathBuf> {
        let Self { machine, language: _, only: _, name: _ } = self;
        machine.files()
    }
}

impl Reads for Jacobian {
    fn files(&self) -> Vec<PathBuf> {
        let Self { machine, q: _ } = self;
        machine.files()
    }
}

impl Reads for Import {
    fn files(&self) -> Vec<PathBuf> {
        vec![self.file.clone()]
    }
}
