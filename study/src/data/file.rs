//! A CSV file: its heading, and records that know their lines.

use std::path::Path;

use abbe_codegen::cell::meant;
use abbe_codegen::diagnostic::Diagnostics;
use csv::StringRecord;

use super::date::parse_date;
use super::dialect::Dialect;
use crate::mistake;

const WANTED: &str = "give a CSV file with a heading in its first line";

/// A file with a heading.
pub(super) struct File {
    file: String,
    bytes: Vec<u8>,
    pub(super) dialect: Dialect,
    pub(super) heading: Vec<String>,
}

/// A record below the heading.
pub(super) struct Record<'t> {
    /// Its line in the file, from 1.
    pub(super) line: u64,
    heading: &'t [String],
    dialect: Dialect,
    fields: StringRecord,
}

impl File {
    /// Reads a file and its heading.
    pub(super) fn read(file: &Path) -> Result<Self, Diagnostics> {
        let file_name = file.display().to_string();
        let bytes = std::fs::read(file).map_err(|error| unreadable(&file_name, &error.into()))?;
        let dialect = Dialect::detect(&bytes);
        let mut table = Self { file: file_name, bytes, dialect, heading: Vec::new() };
        let mut reader = dialect.reader(&table.bytes);
        let heading = reader.headers().map_err(|error| unreadable(&table.file, &error))?;
        table.heading = heading.iter().map(|name| meant(name).to_owned()).collect();
        Ok(table)
    }

    /// Every record below the heading.
    pub(super) fn records(&self) -> impl Iterator<Item = Result<Record<'_>, Diagnostics>> {
        let mut lines = Lines { bytes: &self.bytes, at: 0, line: 1 };
        self.dialect.reader(&self.bytes).into_records().map(move |record| {
            let fields = record.map_err(|error| unreadable(&self.file, &error))?;
            let line = fields.position().map_or(0, |position| lines.of_record(position.byte()));
            Ok(Record { line, heading: &self.heading, dialect: self.dialect, fields })
        })
    }
}

/// Counts lines. The reader's own positions are behind the record before: the rest of a line end, empty lines and comments
/// are still to come.
struct Lines<'t> {
    bytes: &'t [u8],
    at: usize,
    line: u64,
}

impl Lines<'_> {
    /// The line on which the next record after that byte begins.
    fn of_record(&mut self, byte: u64) -> u64 {
        let mut start = byte as usize;
        loop {
            match self.bytes.get(start) {
                Some(b'\r' | b'\n') => start += 1,
                Some(b'#') => {
                    let rest = self.bytes[start..].iter();
                    start += rest.take_while(|byte| **byte != b'\n').count();
                }
                _ => break,
            }
        }
        self.line += self.bytes[self.at..start].iter().filter(|byte| **byte == b'\n').count() as u64;
        self.at = start;
        self.line
    }
}

impl Record<'_> {
    /// Whether there are cells beyond the heading, and how many in all. Empty ones do not count.
    pub(super) fn too_long(&self) -> Option<String> {
        let cells = (1..=self.fields.len()).rev().find(|cells| !self.is_empty(cells - 1))?;
        let columns = self.heading.len();
        (cells > columns).then(|| {
            let between = self.dialect.delimiter();
            format!(
                "it has {cells} cells, the heading {columns}: is there one of the {between} inside a cell?"
            )
        })
    }

    /// Whether there is nothing at a place.
    pub(super) fn is_empty(&self, place: usize) -> bool {
        self.fields.get(place).is_none_or(str::is_empty)
    }

    /// The finite numbers at some places, or why one is none.
    pub(super) fn numbers(&self, places: &[usize]) -> Result<Vec<f64>, String> {
        places.iter().map(|place| self.number(*place)).collect()
    }

    /// What stands at a place.
    pub(super) fn text(&self, place: usize) -> &str {
        self.fields.get(place).map_or("", meant)
    }

    /// The time at a place: a number, or of a date the days since 1970.
    pub(super) fn time(&self, place: usize) -> Result<f64, String> {
        let text = self.text(place);
        let time = parse_date(text).map(|(_, time)| time).or_else(|| self.dialect.number(text));
        time.filter(|time| time.is_finite()).ok_or_else(|| {
            format!("`{}` is `{}`, no date and no number", self.heading[place], text.escape_debug())
        })
    }

    /// The finite number at a place, or why it is none.
    pub(super) fn number(&self, place: usize) -> Result<f64, String> {
        let name = &self.heading[place];
        match self.fields.get(place) {
            None => Err(format!("it ends before `{name}`")),
            Some("") => Err(format!("`{name}` is missing")),
            Some(text) => match self.dialect.number(text) {
                Some(value) if value.is_finite() => Ok(value),
                Some(_) => Err(format!("`{name}` is `{}`", text.escape_debug())),
                None => Err(format!("`{name}` is `{}`, not a number", text.escape_debug())),
            },
        }
    }
}

fn unreadable(file: &str, error: &csv::Error) -> Diagnostics {
    mistake::with_help(file, format!("cannot read this file: {error}"), WANTED)
}

#[cfg(test)]
mod tests {
    use super::Lines;

    #[test]
    fn line_ends_of_any_kind_count() {
        for end in ["\n", "\r\n"] {
            let text = ["a,b", "1,2", "", "# no row", "3,4", "5,6"].join(end);
            let mut reader = csv::ReaderBuilder::new().comment(Some(b'#')).from_reader(text.as_bytes());
            let mut lines = Lines { bytes: text.as_bytes(), at: 0, line: 1 };
            let found: Vec<u64> = reader
                .records()
                .map(|record| lines.of_record(record.unwrap().position().unwrap().byte()))
                .collect();
            assert_eq!(found, [2, 5, 6], "{end:?}");
        }
    }
}
