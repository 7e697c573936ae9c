//! Cells of CSV files that a spreadsheet would run.
//!
//! A text that begins with `=`, `+`, `-`, `@` or a control character is a formula there, unless it is a number. An apostrophe
//! before it makes it a text; whoever reads the file takes that away again.

use std::borrow::Cow;

/// A text as it is written into a cell.
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

/// What was meant by a cell: the opposite of [`harmless`].
pub fn meant(cell: &str) -> &str {
    cell.strip_prefix('\'').filter(|text| begins_a_formula(text)).unwrap_or(cell)
}

/// … behind apostrophes: those of the text itself are told from ours by one more.
fn begins_a_formula(text: &str) -> bool {
    text.trim_start_matches('\'').starts_with(['=', '+', '-', '@', '\t', '\r', '\n'])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_text_comes_back_and_none_is_run() {
        let letters = ["'", "=", "+", "-", "@", "\t", "\r", "1", ".", "e", ",", "\""];
        let mut texts = vec![String::new()];
        for _ in 0..4 {
            let longer = texts.iter().flat_map(|text| letters.map(|letter| text.clone() + letter));
            texts = longer.chain([String::new()]).collect();
        }
        for text in texts {
            let cell = harmless(&text);
            assert_eq!(meant(&cell), text);
            let runs = cell.starts_with(['=', '+', '-', '@', '\t', '\r', '\n']);
            assert!(!runs || text.parse::<f64>().is_ok(), "{text:?}");
        }
    }
}
