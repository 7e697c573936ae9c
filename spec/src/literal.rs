//! String literals of files and of generated code.

use crate::visible::alters_text;

/// Returns a text as a string literal that TOML, JSON, JavaScript and Python read alike: in double
/// quotes, with `\"`, `\\` and `\uXXXX` for every character that alters the text around it.
///
/// ```
/// use abbe_spec::literal::quoted;
/// assert_eq!(quoted("link \"3\""), r#""link \"3\"""#);
/// assert_eq!(quoted("a\nb\u{202e}"), r#""a\u000ab\u202e""#);
/// assert_eq!(quoted("soft\u{ad}hyphen"), "\"soft\u{ad}hyphen\"");
/// ```
pub fn quoted(text: &str) -> String {
    let mut quoted = String::from("\"");
    for c in text.chars() {
        match c {
            '"' | '\\' => quoted.extend(['\\', c]),
            c if alters_text(c) => quoted += &format!("\\u{:04x}", u32::from(c)),
            c => quoted.push(c),
        }
    }
    quoted + "\""
}
