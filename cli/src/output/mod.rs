//! Where results go: stdout, and files that are whole or not there.
//!
//! Every file of every command is written by `Outputs`, which knows what the command has read. `target` is where a path
//! leads, `pending` a file that waits for its place; `folders` are those that were made, and `record` knows which files abbe wrote.

pub(crate) mod folders;
mod outputs;
mod pending;
mod record;
mod target;

use std::io::{self, ErrorKind, Read, Write, stderr, stdout};
use std::path::Path;
use std::process::ExitCode;

use serde::Serialize;

use crate::failure::Failure;

pub(crate) use outputs::Outputs;
pub(crate) use pending::Pending;

/// What a command found out.
#[derive(Debug)]
pub(crate) struct Outcome {
    text: String,
    passed: bool,
    /// Whether stdout has been given to a file of the results.
    aside: bool,
}

impl Outcome {
    /// Results of a command that checks nothing.
    pub(crate) fn passed(text: String) -> Self {
        Self::checked(text, true)
    }

    /// Results, and whether they are what they should be.
    pub(crate) fn checked(text: String, passed: bool) -> Self {
        Self { text, passed, aside: false }
    }

    /// The same on stderr, if something else has been printed.
    pub(crate) fn beside(self, printed: Printed) -> Self {
        Self { aside: printed.0, ..self }
    }

    /// Writes the results to stdout; a reader who has seen enough is no failure.
    pub(crate) fn print(&self) -> Result<ExitCode, Failure> {
        match self.aside {
            true => note(self.text.trim_end()),
            false => print(&mut self.text.as_bytes())?,
        }
        Ok(ExitCode::from(u8::from(!self.passed)))
    }
}

/// Whether a file was written to stdout.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Printed(bool);

/// Writes to stdout; a reader who has seen enough is no failure.
fn print(content: &mut impl Read) -> Result<(), Failure> {
    let mut out = stdout().lock();
    match io::copy(content, &mut out).and_then(|_| out.flush()) {
        Err(error) if error.kind() != ErrorKind::BrokenPipe => {
            Err(Failure::of("stdout", format!("cannot write the results: {error}")))
        }
        _ => Ok(()),
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

pub(crate) fn cannot_write(path: &Path, error: &io::Error) -> Failure {
    let help = match error.kind() {
        ErrorKind::PermissionDenied | ErrorKind::ReadOnlyFilesystem => {
            "name another folder, or make this one writable"
        }
        ErrorKind::StorageFull | ErrorKind::QuotaExceeded => "name another folder, or make room in this one",
        _ => "name another file or folder",
    };
    Failure::of(path.display(), format!("cannot write this: {error}")).help(help)
}
