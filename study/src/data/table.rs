//! Rows to be written: a heading and numbers.

use std::borrow::Cow;
use std::io::{self, Write};

use abbe_spec::cell::harmless;
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

/// What stands above rows.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Heading {
    /// The names of the columns.
    pub names: Vec<String>,
    /// All texts that the column before the others may have; none if there is no such column.
    pub labels: Vec<String>,
}

impl Table {
    /// As text: digits enough for a nanometre, and nothing that a spreadsheet would run.
    pub fn csv(&self) -> String {
        let heading = Heading { names: self.heading.clone(), labels: self.labels.clone() };
        let written = || {
            let mut csv = Csv::new(Vec::new(), &heading)?;
            for (i, row) in self.rows.iter().enumerate() {
                csv.row(self.labels.get(i).map(String::as_str), row)?;
            }
            csv.finish()
        };
        // A vector takes everything.
        String::from_utf8(written().unwrap_or_default()).unwrap_or_default()
    }
}

/// The same text, written row by row.
pub struct Csv<W: Write>(csv::Writer<W>);

impl<W: Write> Csv<W> {
    /// Begins with the heading.
    pub fn new(to: W, heading: &Heading) -> io::Result<Self> {
        // What stands between cells in other countries would be taken for that, were it not in quotes.
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

    /// A row: a label, if there is a column of them, and numbers; what was not measured is an empty field.
    pub fn row(&mut self, label: Option<&str>, numbers: &[Option<f64>]) -> io::Result<()> {
        let cells = numbers.iter().map(|value| value.map_or("".into(), |value| number(value).into()));
        self.write(label.map(harmless).into_iter().chain(cells))
    }

    fn write<'c>(&mut self, record: impl Iterator<Item = Cow<'c, str>>) -> io::Result<()> {
        let record: Vec<Cow<'_, str>> = record.collect();
        self.0.write_record(record.iter().map(|cell| cell.as_bytes())).map_err(io::Error::from)
    }

    /// The end; where it was written to.
    pub fn finish(self) -> io::Result<W> {
        self.0.into_inner().map_err(|error| error.into_error())
    }
}

fn number(value: f64) -> String {
    let value = format!("{value:.9e}").parse::<f64>().unwrap_or(value);
    format!("{}", value + 0.0)
}
