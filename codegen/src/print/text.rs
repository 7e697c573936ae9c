//! Documentation: a spec's free text, and sizes of arrays.

use abbe_core::Description;
use abbe_core::function::Array;
use abbe_spec::visible::alters_text;

/// Meaning of the status of loops that do not close.
pub(super) const NOT_CLOSED: &str =
    "A loop does not close on the path from home, or a passive joint exceeds a limit.";

/// Error of loops that do not close.
pub(super) const OPEN: &str = "a loop does not close, or a passive joint exceeds a limit";

/// Returns the sizes of an array of a function, the outermost first.
pub(super) fn sizes(array: &Array, description: &Description) -> Vec<String> {
    array.shape.iter().map(|count| count.value(description).to_string()).collect()
}

/// Escapes links, tags and code blocks.
pub(super) fn escaped(text: &str) -> String {
    let mut escaped = String::new();
    for character in text.chars() {
        if matches!(character, '[' | ']' | '<' | '>' | '|' | '`' | '~' | '\\') {
            escaped.push('\\');
        }
        escaped.push(character);
    }
    escaped
}

/// Makes a text safe for a comment of any language: on one line, in one writing direction, without
/// the end of a comment and the trigraphs of C.
pub(super) fn harmless(text: &str) -> String {
    text.replace(alters_text, " ")
        .replace("*/", "* /")
        .replace("/*", "/ *")
        .replace("??", "? ?")
        // Of `???` the first pass leaves two.
        .replace("??", "? ?")
        .replace(r#"""""#, "'''")
}

/// Wraps a text to lines of bounded width.
pub(super) fn wrapped(text: &str, width: usize) -> Vec<String> {
    let mut lines: Vec<String> = Vec::new();
    for word in text.split_whitespace() {
        match lines.last_mut() {
            Some(line) if line.chars().count() + 1 + word.chars().count() <= width => {
                line.push(' ');
                line.push_str(word);
            }
            _ => lines.push(word.to_owned()),
        }
    }
    lines
}
