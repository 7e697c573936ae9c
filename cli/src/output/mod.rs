//! Results: stdout, and files that are written completely or not at all.
//!
//! `Outputs` writes every file of every command and knows the inputs of the command. `target`
//! resolves a path, `pending` is a file under construction, `folders` lists the folders that were
//! made, and `record` lists the files that abbe wrote.

pub(crate) mod folders;
mod outputs;
mod pending;
mod record;
mod target;

use std::io::{self, ErrorKind, Read, Write, stderr, stdout};
use std::path::Path;
use std::process::ExitCode;

use abbe_spec::visible::visible;
use serde::Serialize;

use crate::{Result, failure::Failure, signs::shown};

pub(crate) use outputs::Outputs;
pub(crate) use pending::Pending;
pub(crate) use target::is_stdout;

/// Results of a command.
#[derive(Debug)]
pub(crate) struct Outcome {
    text: String,
    passed: bool,
    /// True if stdout carries a file of the results; the text then goes to stderr.
    aside: bool,
}

impl Outcome {
    /// Creates the outcome of a command that checks nothing.
    pub(crate) fn passed(text: String) -> Self {
        Self::checked(text, true)
    }

    /// Creates the outcome of a command that checks something; the exit status is 1 unless
    /// `passed`.
    pub(crate) fn checked(text: String, passed: bool) -> Self {
        Self { text, passed, aside: false }
    }

    /// Moves the text to stderr if a file was printed to stdout.
    pub(crate) fn beside(self, printed: Printed) -> Self {
        Self { aside: printed.0, ..self }
    }

    /// Prints the text and returns the exit status.
    pub(crate) fn print(&self) -> Result<ExitCode> {
        match self.aside {
            true => note(self.text.trim_end()),
            false => print(&mut shown(visible(&self.text).into_owned(), &stdout()).as_bytes())?,
        }
        Ok(ExitCode::from(u8::from(!self.passed)))
    }
}

/// True if a file was written to stdout.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Printed(bool);

/// Writes to stdout. A closed pipe is not an error: its reader has read enough.
fn print(content: &mut impl Read) -> Result<()> {
    printed(io::copy(content, &mut stdout().lock()))
}

/// Completes a write to stdout, and returns its failure.
fn printed<T>(result: io::Result<T>) -> Result<()> {
    match result.and_then(|_| stdout().flush()) {
        Err(error) if error.kind() != ErrorKind::BrokenPipe => {
            Err(Failure::new("stdout", format!("cannot write the results: {error}")))
        }
        _ => Ok(()),
    }
}

/// Prints the help or the version to stdout, or a usage error to stderr, and returns the exit
/// status.
pub(crate) fn print_usage(usage: &clap::Error) -> Result<ExitCode> {
    let result = usage.print();
    if !usage.use_stderr() {
        printed(result)?;
    }
    Ok(ExitCode::from(u8::try_from(usage.exit_code()).unwrap_or(2)))
}

/// Serializes a report as one line of JSON.
pub(crate) fn json(value: &impl Serialize) -> Result<String> {
    serde_json::to_string(value).map(|text| text + "\n").map_err(|error| Failure::new("JSON", error))
}

/// Prints a message to stderr.
pub(crate) fn note(message: &str) {
    // A failed write to stderr cannot be reported anywhere.
    let _ = writeln!(stderr(), "{}", shown(visible(message).into_owned(), &stderr()));
}

/// Error of Windows for a file that another program has open.
const IN_USE: i32 = 32;

pub(crate) fn cannot_write(path: &Path, error: &io::Error) -> Failure {
    let help = match error.kind() {
        _ if cfg!(windows) && error.raw_os_error() == Some(IN_USE) => {
            "close the program that has it open, or choose another file"
        }
        ErrorKind::PermissionDenied | ErrorKind::ReadOnlyFilesystem => {
            "choose another folder, or make this one writable"
        }
        ErrorKind::StorageFull | ErrorKind::QuotaExceeded => {
            "choose a folder on another disk, or free some space"
        }
        _ => "choose another file or folder",
    };
    Failure::new(path.display(), format!("cannot write this: {error}")).help(help)
}

/// Quotes a path with spaces, for a command line.
pub(crate) fn quoted(path: &str) -> String {
    if path.contains(' ') { format!("\"{path}\"") } else { path.to_owned() }
}
