//! Diagnostics of a file, spec or option as a whole, without a span.

use crate::option::DISABLE_NAME;
use std::{fmt::Display, sync::Arc};

use abbe_core::{Class, Component, Description, Effect, Error, Quantity, Remedy};

use crate::diagnostic::{Diagnostic, Diagnostics};

/// Returns the diagnostics of an error that concerns `subject` (a file, spec or option) as a whole.
pub fn whole(subject: impl Display, reason: &impl Remedy) -> Diagnostics {
    with_help(subject, reason, reason.remedy())
}

/// Returns one diagnostic about `subject` as a whole, with its help line.
pub fn with_help(subject: impl Display, message: impl Display, help: impl Display) -> Diagnostics {
    let list = vec![Diagnostic::whole_file(message.to_string()).help(help.to_string())];
    Diagnostics { path: subject.to_string(), text: Arc::from(""), list }
}

/// Returns the diagnostics of a configuration, described by `at`, that could not be evaluated.
///
/// The message names the sources that can have caused the error.
pub fn not_evaluated(what: impl Display, at: &str, error: &Error, description: &Description) -> Diagnostics {
    let blamed = blamed(error, description);
    let help = if blamed.is_empty() {
        error.remedy().to_owned()
    } else {
        format!("check its expression and the values set; or disable it: `{DISABLE_NAME}`, `enabled = false`")
    };
    let message = match blamed.as_slice() {
        [] => format!("at {at}: {}", named(error, description)),
        [source] => format!("at {at}: the source \"{source}\" has no finite value"),
        several => {
            let names = several.iter().map(|source| format!("\"{source}\"")).collect::<Vec<_>>();
            format!("at {at}: one of the sources {} has no finite value", names.join(", "))
        }
    };
    with_help(what, message, help)
}

/// Describes an error with the name of the value that it counts: "joint variable q4 is not a finite
/// number".
pub fn named(error: &Error, description: &Description) -> String {
    let (quantity, index) = match *error {
        Error::NotFinite { quantity, index } => (quantity, index),
        Error::OutOfRange { input, .. } => (Quantity::Inputs, input),
        Error::PassiveLimit { passive } => (Quantity::Passive, passive),
        _ => return error.to_string(),
    };
    let name = match quantity {
        Quantity::Variables => description.variables.get(index).map(|one| one.name.to_string()),
        Quantity::Parameters => description.parameters.get(index).map(|one| one.name.to_string()),
        Quantity::Inputs => description.inputs.get(index).map(|one| one.name.to_string()),
        Quantity::Passive => description.passive().nth(index).map(|one| one.name.to_string()),
        Quantity::Errors => {
            Component::ALL.get(index % 6).map(|one| format!("{}{}", one.name(), index / 6 + 1))
        }
        _ => None,
    };
    let counted = format!("{quantity} {index}");
    match name {
        Some(name) => error.to_string().replacen(&counted, &format!("{quantity} `{name}`"), 1),
        None => error.to_string(),
    }
}

/// Returns the names of the sources that can have caused a non-finite effect or generalized error.
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
