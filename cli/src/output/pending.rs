//! A file that waits for its place until it, and all others of its command, are complete.

use std::fs::{self, File};
use std::io::{self, Write};
use std::path::{Path, PathBuf};

use abbe_study::data::{Csv, Heading};
use sha2::{Digest, Sha256};
use tempfile::{NamedTempFile, SpooledTempFile};

use super::place::{Place, parent};
use super::{cannot_write, temporary};
use crate::failure::Failure;

/// A file that is being written.
#[derive(Debug)]
pub(crate) struct Pending {
    /// As the user calls it.
    pub(super) path: PathBuf,
    pub(super) place: Place,
    pub(super) content: Content,
    hash: Sha256,
}

/// Where it is until then: beside its place; or, for pipes and devices, in memory, and beyond [`SMALL`] in a file without a name.
#[derive(Debug)]
pub(super) enum Content {
    Beside(NamedTempFile<File>),
    Apart(SpooledTempFile),
}

/// What is kept in memory, in bytes.
const SMALL: usize = 1 << 20;

impl Pending {
    pub(super) fn begin(path: &Path, place: Place) -> Result<Self, Failure> {
        let content = match &place {
            Place::File(file) => {
                let old = fs::metadata(file).ok();
                let begun = temporary::file(parent(file), old.as_ref());
                Content::Beside(begun.map_err(|error| cannot_write(path, &error))?)
            }
            Place::Stdout | Place::Through(_) => Content::Apart(SpooledTempFile::new(SMALL)),
        };
        Ok(Self { path: path.to_owned(), place, content, hash: Sha256::new() })
    }

    /// The same with a text, or bytes, in it.
    pub(crate) fn fill(mut self, content: &(impl AsRef<[u8]> + ?Sized)) -> Result<Self, Failure> {
        match self.write_all(content.as_ref()) {
            Ok(()) => Ok(self),
            Err(error) => Err(cannot_write(&self.path, &error)),
        }
    }

    /// Whether it will be a file of its own, not what is written to a pipe or a device.
    pub(crate) fn is_file(&self) -> bool {
        matches!(self.place, Place::File(_))
    }

    /// What is in it, as `sha256sum` says it.
    pub(super) fn hash(&self) -> String {
        abbe_study::hash::digits(&self.hash.clone().finalize())
    }
}

impl Write for Pending {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        let written = match &mut self.content {
            Content::Beside(file) => file.as_file_mut().write(bytes)?,
            Content::Apart(file) => file.write(bytes)?,
        };
        self.hash.update(&bytes[..written]);
        Ok(written)
    }

    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}

/// A CSV file that is written row by row.
pub(crate) struct Rows {
    path: PathBuf,
    csv: Csv<Pending>,
}

impl Rows {
    pub(super) fn new(file: Pending, heading: &Heading) -> Result<Self, Failure> {
        let path = file.path.clone();
        let csv = Csv::new(file, heading).map_err(|error| cannot_write(&path, &error))?;
        Ok(Self { path, csv })
    }

    /// A row: a label, if there is a column of them, and numbers.
    pub(crate) fn row(&mut self, label: Option<&str>, numbers: &[Option<f64>]) -> Result<(), Failure> {
        self.csv.row(label, numbers).map_err(|error| cannot_write(&self.path, &error))
    }

    /// The file with all rows in it.
    pub(crate) fn finish(self) -> Result<Pending, Failure> {
        self.csv.finish().map_err(|error| cannot_write(&self.path, &error))
    }
}
