//! Signs that a terminal can show.

use std::io::IsTerminal;

use abbe_report::plain;

/// Returns true if a stream is a terminal and the locale has no UTF-8, as with `LANG=C`.
pub(crate) fn has_plain_signs(stream: &impl IsTerminal) -> bool {
    stream.is_terminal() && !is_utf8(|name| std::env::var(name).ok())
}

/// Returns a text as a stream can show it.
pub(crate) fn shown(text: String, stream: &impl IsTerminal) -> String {
    if has_plain_signs(stream) { plain(&text).replace('\u{a0}', " ") } else { text }
}

/// Returns true unless the first locale that is set names another encoding, or none.
fn is_utf8(variable: impl Fn(&str) -> Option<String>) -> bool {
    let locales = ["LC_ALL", "LC_CTYPE", "LANG"].into_iter();
    let locale = locales.filter_map(variable).find(|locale| !locale.is_empty());
    locale.is_none_or(|locale| {
        let locale = locale.to_ascii_lowercase();
        locale.contains("utf-8") || locale.contains("utf8")
    })
}

#[cfg(test)]
mod tests;
