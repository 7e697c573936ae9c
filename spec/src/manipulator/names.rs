//! What may be a name.

use crate::diagnostic::Diagnostic;
use crate::document::{Document, Item};
use crate::expr::{FUNCTION_NAMES, UNIT_NAMES};

/// Words that Rust keeps for itself.
const KEYWORDS: [&str; 53] = [
    "Self", "abstract", "as", "async", "await", "become", "box", "break", "const", "continue", "crate", "do",
    "dyn", "else", "enum", "extern", "false", "final", "fn", "for", "gen", "if", "impl", "in", "let", "loop",
    "macro", "match", "mod", "move", "mut", "override", "priv", "pub", "ref", "return", "self", "static",
    "struct", "super", "trait", "true", "try", "type", "typeof", "unsafe", "unsized", "use", "virtual",
    "where", "while", "yield", "_",
];

/// The longest name.
const LONGEST: usize = 60;

/// Whether `name` can be a name in expressions and in generated code; if not, a mistake at the item's key or
/// value says why.
pub(super) fn check_identifier(name: &str, at: crate::diagnostic::Span, document: &mut Document) -> bool {
    let Some((message, help)) = fault(name) else { return true };
    document.mistake(Diagnostic::new(at, message).label("this cannot be a name").help(help));
    false
}

/// The name that is nearest to a text of another format: in lower case, `_` for what names cannot have.
pub fn as_identifier(text: &str) -> String {
    let letter = |c: char| if c.is_ascii_alphanumeric() { c.to_ascii_lowercase() } else { '_' };
    let name: String = text.chars().map(letter).take(LONGEST - 10).collect();
    let name = if name.starts_with(|c: char| c.is_ascii_lowercase()) { name } else { format!("q_{name}") };
    if fault(&name).is_none() { name } else { name + "_" }
}

/// Why a text cannot be a name, and a way out.
fn fault(name: &str) -> Option<(String, String)> {
    let shown = name.escape_debug();
    let mut letters = name.chars();
    let starts = letters.next().is_some_and(|first| first.is_ascii_alphabetic() || first == '_');
    let fault = if name.is_empty() {
        ("a name is empty".to_owned(), "give it a name of letters, digits and `_`".to_owned())
    } else if !starts || !letters.all(|c| c.is_ascii_alphanumeric() || c == '_') {
        let help = "names have letters a to z, digits and `_`, and begin with a letter";
        (format!("`{shown}` is not a name"), help.to_owned())
    } else if name.len() > LONGEST {
        ("this name is too long".to_owned(), format!("names have at most {LONGEST} letters"))
    } else if KEYWORDS.contains(&name) {
        let help = format!("write `{name}_`, or say more");
        (format!("`{shown}` is a word of the Rust language"), help)
    } else if UNIT_NAMES.contains(&name) {
        let help =
            format!("unit names are reserved, so that `5 mm` can only be read in one way: write `{name}_`");
        (format!("`{shown}` is a unit"), help)
    } else if FUNCTION_NAMES.contains(&name) || name == "pi" {
        (format!("`{shown}` is a function or constant"), format!("write `{name}_`, or say more"))
    } else {
        return None;
    };
    Some(fault)
}

/// The longest free text that is a name, in bytes.
const LONGEST_TITLE: usize = 200;

/// A free text that is a name: not empty, in one line, and no page.
pub(super) fn title_of(item: &Item<'_>, document: &mut Document) -> Option<String> {
    let name = document.string(item)?;
    if name.trim().is_empty() || name.contains(char::is_control) {
        document.mistake(
            Diagnostic::new(item.span(), "a name must be text in one line")
                .help("give it a short, clear name"),
        );
        return None;
    }
    if name.len() > LONGEST_TITLE {
        document.mistake(
            Diagnostic::new(item.span(), format!("this name is longer than {LONGEST_TITLE} letters"))
                .help("give it a short, clear name; what else there is to say is its `description`"),
        );
        return None;
    }
    Some(name)
}
