//! Ways out of wrong usage, beside those of the parser.

use abbe_spec::expr::Unit;
use clap::Command;
use clap::error::{ContextKind, ContextValue, ErrorKind};

/// Replaces the tip of an error if there is a better one: the command that has an option, the
/// quotes of a value, or the command that writes a missing map.
pub(crate) fn with_tip(mut usage: clap::Error, command: &Command) -> clap::Error {
    let given = match usage.get(ContextKind::InvalidArg) {
        Some(ContextValue::String(given)) => given.clone(),
        Some(ContextValue::Strings(missing)) => missing.join(" "),
        _ => return usage,
    };
    let tip = match usage.kind() {
        ErrorKind::UnknownArgument if given.starts_with('-') => {
            if usage.get(ContextKind::SuggestedArg).is_some() {
                return usage;
            }
            let has =
                |one: &&Command| one.get_arguments().any(|own| own.get_long() == given.strip_prefix("--"));
            let names: Vec<String> = command
                .get_subcommands()
                .filter(has)
                .map(|one| format!("`abbe {}`", one.get_name()))
                .collect();
            if names.is_empty() {
                String::new()
            } else {
                format!("{given} is an option of {}", names.join(", "))
            }
        }
        ErrorKind::UnknownArgument if Unit::named(&given).is_some() => {
            "write a value and its unit as one word, or in quotes: `0.4mm`, `\"0.4 mm\"`".to_owned()
        }
        ErrorKind::UnknownArgument if given.contains('=') => {
            format!(
                "values of joint variables are given by --q, those of parameters and inputs by --set {given}"
            )
        }
        ErrorKind::MissingRequiredArgument if given.contains("--map") => {
            "`abbe doctor SPEC DATA -o map.toml` proposes a map for a file of measurements".to_owned()
        }
        _ => return usage,
    };
    let tips = if tip.is_empty() { vec![] } else { vec![tip.into()] };
    usage.insert(ContextKind::Suggested, ContextValue::StyledStrs(tips));
    usage
}
