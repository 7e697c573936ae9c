//! Where results go: stdout, and files that are whole or not there.

use std::fs::File;
use std::io::{self, ErrorKind, Write, stderr, stdout};
use std::path::{Path, PathBuf};
use std::process::ExitCode;

use serde::Serialize;
use tempfile::{Builder, NamedTempFile};

use crate::failure::Failure;
use crate::interrupt;

/// What a command found out.
#[derive(Debug)]
pub(crate) struct Outcome {
    text: String,
    passed: bool,
}

impl Outcome {
    /// Results of a command that checks nothing.
    pub(crate) fn passed(text: String) -> Self {
        Self { text, passed: true }
    }

    /// Results, and whether they are what they should be.
    pub(crate) fn checked(text: String, passed: bool) -> Self {
        Self { text, passed }
    }

    /// Writes the results to stdout; a reader who has seen enough is no failure.
    pub(crate) fn print(&self) -> Result<ExitCode, Failure> {
        let mut out = stdout().lock();
        match out.write_all(self.text.as_bytes()).and_then(|()| out.flush()) {
            Err(error) if error.kind() != ErrorKind::BrokenPipe => {
                Err(Failure::of("stdout", format!("cannot write the results: {error}")))
            }
            _ => Ok(ExitCode::from(u8::from(!self.passed))),
        }
    }
}

/// Results for machines: JSON in one line.
pub(crate) fn json(value: &impl Serialize) -> Result<String, Failure> {
    let text = serde_json::to_string(value).map_err(|error| Failure::of("JSON", error))?;
    Ok(text + "\n")
}

/// A message beside the results, on stderr.
pub(crate) fn note(message: &str) {
    // Nobody is left to be told if this fails.
    let _ = writeln!(stderr(), "{message}");
}

/// A file that appears under its name once it is complete.
#[derive(Debug)]
pub(crate) struct Pending {
    path: PathBuf,
    file: NamedTempFile<File>,
}

impl Pending {
    /// Begins the file, beside its final place.
    pub(crate) fn create(path: &Path) -> Result<Self, Failure> {
        if path.is_dir() {
            return Err(Failure::of(path.display(), "this is a folder, not a file").help("name a file in it"));
        }
        let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty());
        // With the permissions of any other file, not those of a secret.
        let create = |path: &Path| File::options().write(true).create_new(true).open(path);
        let make = || Builder::new().make_in(folder.unwrap_or(Path::new(".")), create);
        let file = interrupt::temporary(make).map_err(|error| cannot_write(path, &error))?;
        Ok(Self { path: path.to_owned(), file })
    }

    /// A file with that text, complete but for its place.
    pub(crate) fn complete(path: &Path, text: &str) -> Result<Self, Failure> {
        let mut file = Self::create(path)?;
        file.write_all(text.as_bytes()).map_err(|error| cannot_write(path, &error))?;
        Ok(file)
    }

    /// Puts the complete file in its place.
    pub(crate) fn finish(self) -> Result<(), Failure> {
        let Self { path, file } = self;
        file.persist(&path).map(|_| ()).map_err(|error| cannot_write(&path, &error.error))
    }
}

impl Write for Pending {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.file.as_file_mut().write(bytes)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.file.as_file_mut().flush()
    }
}

/// Writes a file that is whole or not there.
pub(crate) fn write(file: &Path, text: &str) -> Result<(), Failure> {
    let mut pending = Pending::create(file)?;
    pending.write_all(text.as_bytes()).map_err(|error| cannot_write(file, &error))?;
    pending.finish()
}

pub(crate) fn cannot_write(path: &Path, error: &io::Error) -> Failure {
    Failure::of(path.display(), format!("cannot write this: {error}"))
}
