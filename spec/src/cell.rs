//! Cells of CSV files that a spreadsheet would execute.
//!
//! A spreadsheet takes text that starts with `=`, `+`, `-`, `@`, one of their full-width forms, `|`
//! or a control character as a formula unless it is a number, some even after blanks. A leading
//! apostrophe makes it text; the reader removes it again.

use std::borrow::Cow;

/// Escapes a text for a cell.
///
/// ```
/// use abbe_spec::cell::harmless;
/// assert_eq!(harmless("=1+2"), "'=1+2");
/// assert_eq!(harmless("x, measured"), "x, measured");
/// assert_eq!(harmless("-1.5e-3"), "-1.5e-3");
/// ```
pub fn harmless(text: &str) -> Cow<'_, str> {
    match begins_a_formula(text) && text.parse::<f64>().is_err() {
        true => format!("'{text}").into(),
        false => text.into(),
    }
}

/// Returns the text of a cell: the inverse of [`harmless`].
pub fn meant(cell: &str) -> &str {
    cell.strip_prefix('\'').filter(|text| begins_a_formula(text)).unwrap_or(cell)
}

/// Characters with which a formula starts.
const STARTS: [char; 12] = ['=', '+', '-', '@', '|', '＝', '＋', '－', '＠', '\t', '\r', '\n'];

/// Returns `true` for a formula, possibly after apostrophes and blanks: text that starts with
/// apostrophes is escaped by one more.
fn begins_a_formula(text: &str) -> bool {
    let is_blank = |c: char| c.is_whitespace() && !STARTS.contains(&c);
    text.trim_start_matches(|c| c == '\'' || is_blank(c)).starts_with(STARTS)
}

#[cfg(test)]
mod tests;
