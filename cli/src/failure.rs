//! Why a command could not do what it was asked.

use std::fmt::Display;
use std::io::{IsTerminal, Write, stderr};
use std::process::ExitCode;

use abbe_spec::diagnostic::Diagnostics;
use abbe_study::mistake;

/// Bad usage or input: exit status 2.
#[derive(Debug)]
pub(crate) struct Failure(Box<Diagnostics>);

impl Failure {
    /// Something wrong with a file, a spec or an argument as a whole.
    pub(crate) fn of(subject: impl Display, message: impl Display) -> Self {
        mistake::with_help(subject, message, "`abbe COMMAND --help` says what can be given").into()
    }

    /// Says a way out.
    pub(crate) fn help(mut self, help: impl Display) -> Self {
        for diagnostic in &mut self.0.list {
            diagnostic.help = Some(help.to_string());
        }
        self
    }

    /// Shows what is wrong, in colours if somebody watches.
    pub(crate) fn report(&self) -> ExitCode {
        let plain = std::env::var_os("NO_COLOR").is_some_and(|value| !value.is_empty());
        let text = self.0.render(!plain && stderr().is_terminal());
        // Nobody is left to be told if this fails.
        let _ = writeln!(stderr(), "{text}");
        ExitCode::from(2)
    }
}

impl From<Diagnostics> for Failure {
    fn from(diagnostics: Diagnostics) -> Self {
        Self(Box::new(diagnostics))
    }
}
