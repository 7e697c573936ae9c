//! CSV files that spreadsheets read without running formulas.
//!
//! Cells of CSV files that a spreadsheet would execute.
//!
//! A spreadsheet takes text that starts with `=`, `+`, `-`, `@`, one of their full-width forms, `|`
//! or a control character as a formula unless it is a number, some even after blanks. A leading
//! apostrophe makes it text; the reader removes it again.

#[cfg(test)]
mod tests;

use std::borrow::Cow;
use std::io::{self, Write};

use csv::{QuoteStyle, WriterBuilder};

/// The heading line of a CSV file.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Heading {
    /// The names of the columns.
    pub names: Vec<String>,
    /// All texts of a leading column of labels; empty if there is none.
    pub labels: Vec<String>,
}

/// Writes a CSV file row by row, with digits enough for a nanometre.
pub struct Csv<W: Write>(csv::Writer<W>);

impl<W: Write> Csv<W> {
    /// Starts a file with its heading.
    pub fn new(to: W, heading: &Heading) -> io::Result<Self> {
        // A text with a separator of another locale is quoted, or spreadsheets would split it.
        let mut texts = heading.names.iter().chain(&heading.labels);
        let quotes = match texts.any(|text| text.contains([';', '\t'])) {
            true => QuoteStyle::NonNumeric,
            false => QuoteStyle::Necessary,
        };
        let mut builder = WriterBuilder::new();
        builder.comment(Some(b'#')).flexible(true).quote_style(quotes);
        let mut csv = Self(builder.from_writer(to));
        csv.write(heading.names.iter().map(|name| harmless(name)))?;
        Ok(csv)
    }

    /// Writes a row: a label if there is a column of them, then numbers, `None` as an empty field.
    pub fn row(&mut self, label: Option<&str>, numbers: &[Option<f64>]) -> io::Result<()> {
        let cells = numbers.iter().map(|value| value.map_or("".into(), |value| number(value).into()));
        self.write(label.map(harmless).into_iter().chain(cells))
    }

    fn write<'c>(&mut self, record: impl Iterator<Item = Cow<'c, str>>) -> io::Result<()> {
        let record: Vec<Cow<'_, str>> = record.collect();
        self.0.write_record(record.iter().map(|cell| cell.as_bytes())).map_err(io::Error::from)
    }

    /// Flushes the file and returns the writer below.
    pub fn finish(self) -> io::Result<W> {
        self.0.into_inner().map_err(|error| error.into_error())
    }
}

fn number(value: f64) -> String {
    let value = format!("{value:.9e}").parse::<f64>().unwrap_or(value);
    format!("{}", value + 0.0)
}

/// Escapes a text for a cell.
///
/// ```
/// use abbe_spec::csv_writer::harmless;
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
