//! Rules for names.

use std::fmt::Display;

use crate::diagnostic::{Diagnostic, Diagnostics, Span};
use crate::document::{Document, Item, Section};
use crate::expr::{FUNCTION_NAMES, UNIT_NAMES};
use crate::visible::alters_text;

/// Reserved words of Rust.
const KEYWORDS: [&str; 53] = [
    "Self", "abstract", "as", "async", "await", "become", "box", "break", "const", "continue", "crate", "do",
    "dyn", "else", "enum", "extern", "false", "final", "fn", "for", "gen", "if", "impl", "in", "let", "loop",
    "macro", "match", "mod", "move", "mut", "override", "priv", "pub", "ref", "return", "self", "static",
    "struct", "super", "trait", "true", "try", "type", "typeof", "unsafe", "unsized", "use", "virtual",
    "where", "while", "yield", "_",
];

/// Maximum length of a name.
const LONGEST: usize = 60;

/// Returns `true` if `name` is valid in expressions and in generated code. Otherwise the reason is
/// recorded at `at`.
pub(super) fn check_identifier(name: &str, at: Span, document: &Document) -> bool {
    let Some((message, help)) = fault(name) else { return true };
    document.mistake(Diagnostic::new(at, message).label("not a valid name").help(help));
    false
}

/// Checks the name of a manipulator, which becomes the name of a module.
pub(super) fn check_manipulator_name(name: &str, at: Span, document: &Document) {
    if check_identifier(name, at.clone(), document) && name.contains(|c: char| c.is_ascii_uppercase()) {
        let help = format!("write `{}`", name.to_ascii_lowercase());
        let mistake = Diagnostic::new(at, "the name of a manipulator must be in lower case");
        document.mistake(mistake.label("this becomes the name of a module").help(help));
    }
}

/// Checks the name of a manipulator that is not in a file; diagnostics name `path`.
pub fn check_name(path: impl Display, name: &str) -> Result<(), Diagnostics> {
    let document = Document::new(path, name);
    check_manipulator_name(name, 0..name.len(), &document);
    document.finish(Some(()))
}

/// Names a table by its key `name`; another one of the same `kind` and name, whose location is
/// `first`, is a mistake.
pub(super) fn read_title(
    section: &mut Section<'_>,
    kind: &str,
    known: &mut Vec<(String, Span)>,
    help: &str,
) -> Option<String> {
    let item = section.required("name")?;
    let name = title_of(&item)?;
    section.name = format!("the {kind} \"{name}\"");
    section.span = item.span();
    if let Some((_, first)) = known.iter().find(|(other, _)| *other == name) {
        let mistake = Diagnostic::new(item.span(), format!("duplicate {kind} name \"{name}\""));
        section.document.mistake(mistake.label("second use").context(first.clone(), "first use").help(help));
    }
    known.push((name.clone(), item.span()));
    Some(name)
}

/// Converts a text of another format to a valid name: lower case, with `_` for invalid characters.
pub fn as_identifier(text: &str) -> String {
    let letter = |c: char| if c.is_ascii_alphanumeric() { c.to_ascii_lowercase() } else { '_' };
    let name: String = text.chars().map(letter).take(LONGEST - 10).collect();
    let name = if name.starts_with(|c: char| c.is_ascii_lowercase()) { name } else { format!("q_{name}") };
    if fault(&name).is_none() { name } else { name + "_" }
}

/// Returns the reason why a text is no valid name, and a remedy.
fn fault(name: &str) -> Option<(String, String)> {
    let shown = name.escape_debug();
    let mut letters = name.chars();
    let starts = letters.next().is_some_and(|first| first.is_ascii_alphabetic() || first == '_');
    let fault = if name.is_empty() {
        ("this name is empty".to_owned(), "use letters, digits and `_`".to_owned())
    } else if !starts || !letters.all(|c| c.is_ascii_alphanumeric() || c == '_') {
        let help = "names consist of letters a to z, digits and `_`, and begin with a letter";
        (format!("`{shown}` is not a valid name"), help.to_owned())
    } else if name.len() > LONGEST {
        ("this name is too long".to_owned(), format!("names have at most {LONGEST} letters"))
    } else if KEYWORDS.contains(&name) {
        let help = format!("write `{name}_`, or a longer name");
        (format!("`{shown}` is a keyword of Rust"), help)
    } else if UNIT_NAMES.contains(&name) {
        let help = format!("unit names are reserved: write `{name}_`");
        (format!("`{shown}` is a unit"), help)
    } else if FUNCTION_NAMES.contains(&name) || name == "pi" {
        (format!("`{shown}` is a function or constant"), format!("write `{name}_`, or a longer name"))
    } else {
        return None;
    };
    Some(fault)
}

/// Maximum length of a free-text name, in bytes.
const LONGEST_TITLE: usize = 200;

/// Reads a free-text name: not empty, on one line, shown as it is read, of limited length.
fn title_of(item: &Item<'_>) -> Option<String> {
    let name = item.string()?;
    if name.trim().is_empty() || name.contains(char::is_control) {
        return item.refuse("expected a name on one line", "use a short, descriptive name");
    }
    if let Some(c) = name.chars().find(|c| alters_text(*c)) {
        let message = format!("this name contains U+{:04X}, which alters the text around it", u32::from(c));
        return item.refuse(message, "remove this invisible character");
    }
    if name.len() > LONGEST_TITLE {
        let message = format!("this name is longer than {LONGEST_TITLE} letters");
        return item.refuse(message, "use a short name, and `description` for the rest");
    }
    Some(name)
}
