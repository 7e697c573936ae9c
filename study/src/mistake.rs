//! Mistakes that have no place in a file.

use std::fmt::Display;
use std::sync::Arc;

use abbe::{Class, Description, Effect, Error, Quantity};
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

/// A configuration, described by `at`, that could not be evaluated: the sources that can be to blame are named.
pub fn not_evaluated(
    subject: impl Display,
    at: &str,
    error: &Error,
    description: &Description,
) -> Diagnostics {
    let message = match blamed(error, description).as_slice() {
        [] => format!("at {at}: {error}"),
        [source] => format!("at {at}: the source \"{source}\" has no finite value"),
        several => {
            let names = several.iter().map(|source| format!("\"{source}\"")).collect::<Vec<_>>();
            format!("at {at}: one of the sources {} has no finite value", names.join(", "))
        }
    };
    whole(subject, message)
}

/// The sources that an effect, or a generalized error, without a finite value can come from.
fn blamed<'a>(error: &Error, description: &'a Description) -> Vec<&'a str> {
    let causes = |effect: &Effect| match *error {
        Error::NotFinite { quantity: Quantity::Effects, index } => description.effects[index] == *effect,
        Error::NotFinite { quantity: Quantity::Errors, index } => {
            let repeatable = description.sources[effect.source].class == Class::Repeatable;
            repeatable && 6 * effect.frame + effect.component.index() == index
        }
        _ => false,
    };
    let causing = description.effects.iter().filter(|effect| causes(effect));
    let mut blamed = causing.map(|effect| effect.source).collect::<Vec<_>>();
    blamed.dedup();
    blamed.into_iter().map(|source| &*description.sources[source].name).collect()
}
