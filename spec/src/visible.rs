//! Text that people read: on a terminal, on a page, in comments of generated code.
//!
//! Names and headings come from files of others. Some of their characters have no shape but alter
//! the text around them: a terminal obeys control characters, and bidirectional controls show a
//! line in another order than programs read it.

use std::borrow::Cow;

/// Returns `true` for characters that alter the text around them: control characters, separators of
/// lines and paragraphs, bidirectional controls, the byte-order mark, and the two noncharacters
/// that XML excludes. All of them have at most four hexadecimal digits.
pub fn alters_text(c: char) -> bool {
    c.is_control()
        || matches!(
            c,
            '\u{61c}' | '\u{200e}' | '\u{200f}' | '\u{2028}'..='\u{202e}' | '\u{2066}'..='\u{2069}'
                | '\u{feff}' | '\u{fffe}' | '\u{ffff}'
        )
}

/// Replaces every character that alters the text around it, except line breaks and tabs, by its
/// escape `\uXXXX`. Strings of JSON and TOML keep their meaning.
///
/// ```
/// use abbe_spec::visible::visible;
/// assert_eq!(visible("\u{1b}[2Jgone"), r"\u001b[2Jgone");
/// assert_eq!(visible("two\nlines of 3 µm"), "two\nlines of 3 µm");
/// ```
pub fn visible(text: &str) -> Cow<'_, str> {
    let escaped = |c: char| alters_text(c) && !matches!(c, '\n' | '\t');
    if !text.contains(escaped) {
        return Cow::Borrowed(text);
    }
    let mut visible = String::with_capacity(text.len() + 16);
    for c in text.chars() {
        if escaped(c) { visible += &format!("\\u{:04x}", u32::from(c)) } else { visible.push(c) }
    }
    Cow::Owned(visible)
}

/// Replaces characters beyond ASCII that alter the text around them by visible ones of the same
/// length in UTF-8, so that spans of the text stay valid.
pub(crate) fn with_placeholders(text: &str) -> Cow<'_, str> {
    let replaced = |c: char| alters_text(c) && !c.is_ascii();
    if !text.contains(replaced) {
        return Cow::Borrowed(text);
    }
    let placeholder = |c: char| if c.len_utf8() == 2 { '\u{a4}' } else { '\u{fffd}' };
    Cow::Owned(text.chars().map(|c| if replaced(c) { placeholder(c) } else { c }).collect())
}

#[cfg(test)]
mod tests;
