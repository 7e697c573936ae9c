//! Mistakes that have no place in a file.

use std::fmt::Display;
use std::sync::Arc;

use abbe::{Description, Error, Quantity};
use abbe_codegen::diagnostic::{Diagnostic, Diagnostics};

/// Something wrong with a file, a spec or an option as a whole.
pub fn whole(subject: impl Display, message: impl Display) -> Diagnostics {
    let list = vec![Diagnostic::whole_file(message.to_string())];
    Diagnostics { path: subject.to_string(), text: Arc::from(""), list }
}

/// As [`whole`], with a way out.
pub fn with_help(subject: impl Display, message: impl Display, help: impl Display) -> Diagnostics {
    let list = vec![Diagnostic::whole_file(message.to_string()).help(help.to_string())];
    Diagnostics { path: subject.to_string(), text: Arc::from(""), list }
}

/// A configuration, described by `at`, that could not be evaluated: the source to blame is named if there is one.
pub fn not_evaluated(
    subject: impl Display,
    at: &str,
    error: &Error,
    description: &Description,
) -> Diagnostics {
    let source = match error {
        Error::NotFinite { quantity: Quantity::Errors, index } => description.effects.get(*index),
        _ => None,
    };
    let message = match source.map(|effect| &description.sources[effect.source].name) {
        Some(source) => format!("at {at}: the source \"{source}\" has no finite value"),
        None => format!("at {at}: {error}"),
    };
    whole(subject, message)
}
