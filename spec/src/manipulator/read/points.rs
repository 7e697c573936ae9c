//! Points of a table: reads and checks them.

use std::{io::Read, path::PathBuf};

use crate::bounded::{UnreadableFile, not_text};
use crate::csv_writer::meant;
use crate::diagnostic::{Diagnostic, Span, suggestion};
use crate::document::Item;
use crate::expr::LARGEST as LARGEST_NUMBER;

/// Maximum size of a file of points, in bytes.
const LARGEST: u64 = 16 << 20;

/// Columns of a CSV file.
pub(super) struct Columns {
    /// The file, as written in the spec.
    pub(super) file: String,
    span: Span,
    names: Vec<String>,
    /// Rows with their line numbers.
    rows: Vec<(u64, csv::StringRecord)>,
}

impl Columns {
    /// Reads the file that an item names, relative to the spec, and records it as part of the spec.
    pub(super) fn read(item: &Item<'_>) -> Option<Self> {
        let (file, span) = (item.string()?, item.span());
        let Some(folder) = &item.document.folder else {
            let message =
                format!("cannot read `{file}`: this spec is not in a file, so relative paths have no folder");
            let help = "read the spec from a file, or include the points: `x = […]`, `y = […]`";
            return item.refuse(message, help);
        };
        let path: PathBuf = folder.join(&file);
        let mut bytes = Vec::new();
        let opened = item.document.named_file(&path, LARGEST);
        let read = opened.and_then(|mut input| input.read_to_end(&mut bytes));
        let help = "the path is relative to the folder of the spec";
        let unfit = match &read {
            Err(error) if error.raw_os_error().is_some() => {
                return item.refuse(format!("cannot read `{file}`: {error}"), help);
            }
            Err(error) => Some(UnreadableFile::from_error(error, help)),
            Ok(_) => not_text(&bytes),
        };
        if let Some(UnreadableFile { message, help }) = unfit {
            return item.refuse(format!("`{file}`: {message}"), help);
        }
        item.document.files.borrow_mut().push(path.clone());
        item.document.beside.borrow_mut().push((path, bytes.clone()));
        let mut reader =
            csv::ReaderBuilder::new().trim(csv::Trim::All).comment(Some(b'#')).from_reader(&bytes[..]);
        let result = reader
            .headers()
            .map(|names| names.iter().map(|name| meant(name).to_owned()).collect())
            .and_then(|names| {
                let rows =
                    reader.records().map(|row| row.map(|row| (row.position().map_or(0, |p| p.line()), row)));
                Ok((names, rows.collect::<Result<Vec<_>, _>>()?))
            });
        match result {
            Ok((names, rows)) => Some(Self { file, span, names, rows }),
            Err(error) => item.refuse(format!("`{file}` is not a table: {}", in_words(&error)), FORM),
        }
    }

    /// Returns the numbers of a column.
    pub(super) fn numbers(&self, item: &Item<'_>) -> Option<Vec<f64>> {
        let name = item.string()?;
        let Some(index) = self.names.iter().position(|known| *known == name) else {
            let known: Vec<&str> = self.names.iter().map(String::as_str).collect();
            let message = format!("`{}` has no column `{}`", self.file, name.escape_debug());
            let help = match &known[..] {
                [only] if only.contains([';', '\t']) => FORM.to_owned(),
                _ => suggestion(item.document.mistakes(), &name, &known, "columns"),
            };
            return item.refuse(message, help);
        };
        let mut numbers = Vec::with_capacity(self.rows.len());
        for (line, row) in &self.rows {
            let cell = row.get(index).unwrap_or_default();
            match cell.parse::<f64>() {
                Ok(number) if number.abs() <= LARGEST_NUMBER => numbers.push(number),
                Ok(number) if number.is_finite() => {
                    let message =
                        format!("line {line} of `{}`: `{name}` is too large to compute with", self.file);
                    let mistake = Diagnostic::new(item.span(), message).label(format!("found `{number:e}`"));
                    return item
                        .document
                        .fail(mistake.help("the maximum is 1e150; remove rows without a measurement"));
                }
                _ => {
                    let message = format!("line {line} of `{}`: `{name}` is not a number", self.file);
                    let label = format!("found `{}`", cell.escape_debug());
                    let mistake = Diagnostic::new(item.span(), message).label(label);
                    return item.document.fail(mistake.help("remove rows without a measurement"));
                }
            }
        }
        Some(numbers)
    }
}

/// Required form of a file of points.
const FORM: &str =
    "expected a CSV file with a line of names, then rows; separate cells by commas, and use a decimal point";

/// Describes an error in the form of a file.
fn in_words(error: &csv::Error) -> String {
    match error.kind() {
        csv::ErrorKind::UnequalLengths { pos: Some(place), expected_len, len } => {
            format!("line {}: expected {expected_len} cells, found {len}", place.line())
        }
        csv::ErrorKind::Utf8 { pos: Some(place), .. } => format!("line {} is not UTF-8 text", place.line()),
        _ => error.to_string(),
    }
}

/// Numbers to be checked as points.
pub(super) struct Points<'c> {
    pub(super) x: Vec<f64>,
    pub(super) y: Vec<f64>,
    /// Location of each x; empty if they are in another file.
    pub(super) places: Vec<Span>,
    pub(super) columns: Option<&'c Columns>,
}

impl Points<'_> {
    /// Returns the points sorted by x, or records a mistake with its row.
    pub(super) fn check(self, table: &Item<'_>) -> Option<Vec<[f64; 2]>> {
        let Self { x, y, .. } = &self;
        if x.len() != y.len() {
            let message = format!("`x` has {} numbers, but `y` has {}", x.len(), y.len());
            return table.refuse_key(message, "every point needs an x and a y");
        }
        if x.len() < 2 {
            let message =
                format!("`{}` has {}", table.key, if x.is_empty() { "no points" } else { "one point" });
            let mistake = Diagnostic::new(table.key_span.clone(), message);
            return table
                .document
                .fail(mistake.label("at least two are needed").help("use a parameter for a constant"));
        }
        let falls = x[1] < x[0];
        let sign = if falls { -1.0 } else { 1.0 };
        if let Some(before) = x.windows(2).position(|pair| sign * pair[1] <= sign * pair[0]) {
            let (row, first) = (self.place(before + 1, table), self.place(before, table));
            let message = match x[before] == x[before + 1] {
                true => format!("{}: x is the same as in the row before", row.1),
                false => format!("{}: x turns back", row.1),
            };
            let mut mistake = Diagnostic::new(row.0, message).label(format!("x is {} here", x[before + 1]));
            if self.columns.is_none() {
                mistake = mistake.context(first.0, format!("and {} here", x[before]));
            }
            return table.document.fail(
                mistake.help("x must increase or decrease from row to row; average repeated measurements"),
            );
        }
        let mut points: Vec<[f64; 2]> = x.iter().zip(y).map(|(x, y)| [*x, *y]).collect();
        if falls {
            points.reverse();
        }
        Some(points)
    }

    /// Returns the location and the name of a point.
    fn place(&self, index: usize, table: &Item<'_>) -> (Span, String) {
        match (self.columns, self.places.get(index)) {
            (Some(columns), _) => {
                (columns.span.clone(), format!("line {} of `{}`", columns.rows[index].0, columns.file))
            }
            (None, Some(span)) => (span.clone(), format!("point {} of `{}`", index + 1, table.key)),
            (None, None) => (table.key_span.clone(), format!("point {}", index + 1)),
        }
    }
}
