//! Errors of usage and input.

use std::fmt::Display;
use std::io::{IsTerminal, Write, stderr};
use std::process::ExitCode;

use abbe_spec::Diagnostics;
use abbe_study::mistake;

use crate::signs::shown;

/// A result whose error, unless another one is named, is a [`Failure`].
pub(crate) type Result<T, E = Failure> = std::result::Result<T, E>;

/// Wrong usage or input: exit status 2.
#[derive(Debug)]
pub(crate) struct Failure(Box<Diagnostics>);

impl Failure {
    /// Creates a failure about a file, a spec or an argument as a whole.
    pub(crate) fn new(subject: impl Display, message: impl Display) -> Self {
        mistake::with_help(subject, message, "`abbe COMMAND --help` lists the arguments and options").into()
    }

    /// Replaces the help line.
    pub(crate) fn help(mut self, help: impl Display) -> Self {
        for diagnostic in &mut self.0.list {
            diagnostic.help = Some(help.to_string());
        }
        self
    }

    /// Prints the diagnostics to stderr, in colour on a terminal unless `NO_COLOR` is set.
    pub(crate) fn report(&self) -> ExitCode {
        let no_colour = std::env::var_os("NO_COLOR").is_some_and(|value| !value.is_empty());
        let text = shown(self.0.render(!no_colour && stderr().is_terminal()), &stderr());
        // A failed write to stderr cannot be reported anywhere.
        let _ = writeln!(stderr(), "{text}");
        ExitCode::from(2)
    }
}

impl From<Diagnostics> for Failure {
    fn from(diagnostics: Diagnostics) -> Self {
        Self(Box::new(diagnostics))
    }
}
