//! Mistakes that have no place in a file.

use std::fmt::Display;
use std::sync::Arc;

use abbe::identify::Failure;
use abbe::{Class, Description, Effect, Error, Quantity};
use abbe_spec::diagnostic::{Diagnostic, Diagnostics};

/// What knows a way out of itself.
pub trait WayOut: Display {
    /// What to do about it.
    fn way_out(&self) -> &'static str;
}

impl WayOut for Error {
    fn way_out(&self) -> &'static str {
        match self {
            Self::NotFinite { .. } => {
                "a number divides by 0 there, or is far too large: are the units of the spec right?"
            }
            Self::EulerSingularity { .. } => {
                "leave this configuration out, or say `orientation = \"rotation-vector\"`"
            }
            Self::OutOfRange { .. } => "give another value, or widen the input's `range` in the spec",
            Self::Count { .. } => "give as many values as the manipulator has",
        }
    }
}

impl WayOut for Failure {
    fn way_out(&self) -> &'static str {
        match self {
            Self::Observation { error, .. } => match error {
                Error::NotFinite { .. } => {
                    "is a cell of the row, or a unit of the map, far too large? Leave the row out"
                }
                error => error.way_out(),
            },
            Self::Machine(error) => error.way_out(),
            Self::TooFew { .. } => {
                "measure at more configurations, or let the map know more: `base = \"known\"`"
            }
            Self::Untouched { .. } => "leave the row out, or widen the limits of the joints",
            Self::NotConverged { .. } => {
                "look for rows that are far off, wrong units and reversed joints in the map; or try `--robust tukey`"
            }
        }
    }
}

/// Something that cannot be worked out about a file, a spec or an option.
pub fn whole(subject: impl Display, reason: &impl WayOut) -> Diagnostics {
    with_help(subject, reason, reason.way_out())
}

/// Something wrong with a file, a spec or an option as a whole, and a way out.
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
    let blamed = blamed(error, description);
    let help = match blamed.is_empty() {
        true => error.way_out(),
        false => {
            "look at its expression and at what is set; or leave it out: `--disable NAME`, `enabled = false`"
        }
    };
    let message = match blamed.as_slice() {
        [] => format!("at {at}: {error}"),
        [source] => format!("at {at}: the source \"{source}\" has no finite value"),
        several => {
            let names = several.iter().map(|source| format!("\"{source}\"")).collect::<Vec<_>>();
            format!("at {at}: one of the sources {} has no finite value", names.join(", "))
        }
    };
    with_help(subject, message, help)
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
