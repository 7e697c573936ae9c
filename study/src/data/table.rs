//! Rows to be written: a heading and numbers.

use std::borrow::Cow;

use abbe_codegen::cell::harmless;
use csv::{QuoteStyle, WriterBuilder};
use serde::Serialize;

/// A table of numbers, for a CSV file.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Table {
    /// The names of its columns.
    pub heading: Vec<String>,
    /// Its rows; what was not measured is an empty field.
    pub rows: Vec<Vec<Option<f64>>>,
    /// The texts of a column before the others, such as the station of every row; none if there is no such column.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub labels: Vec<String>,
}

impl Table {
    /// As text: digits enough for a nanometre, and nothing that a spreadsheet would run.
    pub fn csv(&self) -> String {
        // What stands between cells in other countries would be taken for that, were it not in quotes.
        let texts = || self.heading.iter().chain(&self.labels);
        let quotes = match texts().any(|text| text.contains([';', '\t'])) {
            true => QuoteStyle::NonNumeric,
            false => QuoteStyle::Necessary,
        };
        let mut builder = WriterBuilder::new();
        builder.comment(Some(b'#')).flexible(true).quote_style(quotes);
        let mut writer = builder.from_writer(Vec::new());
        let mut write = |record: Vec<Cow<'_, str>>| {
            // A vector takes everything.
            let _ = writer.write_record(record.iter().map(|cell| cell.as_bytes()));
        };
        write(self.heading.iter().map(|name| harmless(name)).collect());
        for (i, row) in self.rows.iter().enumerate() {
            let label = self.labels.get(i).map(|label| harmless(label));
            let cells = row.iter().map(|value| value.map_or("".into(), |value| number(value).into()));
            write(label.into_iter().chain(cells).collect());
        }
        String::from_utf8(writer.into_inner().unwrap_or_default()).unwrap_or_default()
    }
}

fn number(value: f64) -> String {
    let value = format!("{value:.9e}").parse::<f64>().unwrap_or(value);
    format!("{}", value + 0.0)
}
