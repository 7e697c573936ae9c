//! CSV files: a heading, and records with line numbers, read on demand.

use abbe_spec::option::MAP;
use std::io::{self, Cursor, Read};
use std::path::Path;
use std::sync::Arc;

use abbe_spec::bounded::{Bounded, UnreadableFile, not_text};
use abbe_spec::csv_writer::meant;
use abbe_spec::diagnostic::Diagnostics;
use csv::StringRecord;

use super::dialect::{Dialect, SEPARATORS};
use super::preamble::{above_heading, stated_separator};
use super::record::Record;
use abbe_study::lines::{Lines, RecordedReader};
use abbe_study::{Result, mistake};

const WANTED: &str = "give a CSV file with a heading in its first line";

/// Largest size of a file, in bytes.
const LARGEST_FILE: u64 = 4 << 30;

/// Number of bytes examined for the dialect.
const HEAD: u64 = 1 << 18;

/// Largest number of columns.
const MOST_COLUMNS: usize = 50_000;

/// Largest number of rows.
pub(super) const MOST_ROWS: usize = 2_000_000;

/// A CSV file with a heading.
pub(super) struct File {
    file: String,
    reader: csv::Reader<RecordedReader<io::Chain<Cursor<Vec<u8>>, Bounded>>>,
    lines: Lines,
    pub(super) dialect: Dialect,
    pub(super) heading: Arc<[String]>,
}

impl File {
    /// Opens a file and reads its heading, unless the names of its columns are given.
    pub(super) fn open(file: &Path, columns: &[String]) -> Result<Self> {
        let name = file.display().to_string();
        let fail = |error: io::Error| unfit(&name, &UnreadableFile::from_error(&error, WANTED));
        let mut input = Bounded::open(file, LARGEST_FILE).map_err(fail)?;
        let mut head = Vec::new();
        input.by_ref().take(HEAD).read_to_end(&mut head).map_err(fail)?;
        if let Some(found) = not_text(&head).or_else(|| other_text(&head)) {
            return Err(unfit(&name, &found));
        }
        let stated = stated_separator(&mut head);
        let fits = |one: &u8| cells(&head, Dialect::detect(&head, Some(*one))).len() == columns.len();
        // A first row of numbers has more decimal commas than separators.
        let stated = stated.or_else(|| SEPARATORS.into_iter().find(fits).filter(|_| !columns.is_empty()));
        let dialect = Dialect::detect(&head, stated);
        if let Some(found) = above_heading(&head, dialect) {
            return Err(unfit(&name, &found));
        }
        let has_heading = columns.is_empty() || has_heading(&name, &head, dialect, columns)?;
        let (watched, lines) = RecordedReader::new(Cursor::new(head).chain(input));
        let (reader, heading): (_, Arc<[String]>) = match has_heading {
            true => {
                let mut reader = dialect.reader(watched);
                let heading = reader.headers().map_err(|error| unreadable(&name, &error))?;
                let heading = heading.iter().map(|name| meant(name).to_owned()).collect();
                (reader, heading)
            }
            false => (dialect.all_records(watched), columns.into()),
        };
        if heading.len() > MOST_COLUMNS {
            let message = format!("this file has {} columns; the maximum is {MOST_COLUMNS}", heading.len());
            return Err(mistake::with_help(
                name,
                message,
                "leave out the columns that the map does not name",
            ));
        }
        Ok(Self { file: name, reader, lines, dialect, heading })
    }

    /// Returns the records below the heading.
    pub(super) fn records(self) -> impl Iterator<Item = Result<Record>> {
        let Self { file, reader, mut lines, dialect, heading } = self;
        reader.into_records().enumerate().map(move |(row, record)| {
            let fields = record.map_err(|error| unreadable(&file, &error))?;
            let line = fields.position().map_or(0, |position| lines.record_line(position.byte()));
            if row == MOST_ROWS {
                let message = format!("this file has more than the maximum of {MOST_ROWS} rows");
                return Err(mistake::with_help(&file, message, "split it, or keep every second row"));
            }
            Ok(Record::written(line, Arc::clone(&heading), dialect, fields))
        })
    }
}

/// Returns the cells of the first row.
fn cells(head: &[u8], dialect: Dialect) -> StringRecord {
    dialect.all_records(head).into_records().find_map(csv::Result::ok).unwrap_or_default()
}

/// Returns whether the first row has one of the names that columns would have without a heading.
fn has_heading(file: &str, head: &[u8], dialect: Dialect, columns: &[String]) -> Result<bool> {
    let row = cells(head, dialect);
    if row.iter().any(|cell| columns.iter().any(|name| name == meant(cell))) {
        return Ok(true);
    }
    if row.len() != columns.len() {
        let message =
            format!("the map names {} columns, and the first row has {} cells", columns.len(), row.len());
        return Err(mistake::with_help(file, message, "give `columns` in `[data]` a name for each cell"));
    }
    Ok(false)
}

/// Recognizes a text that is not a table by its first line.
fn other_text(head: &[u8]) -> Option<UnreadableFile> {
    if head.contains(&0) {
        return Some(UnreadableFile::new("this is not a text file: it contains null bytes", WANTED));
    }
    let text = String::from_utf8_lossy(head);
    let mut lines = text.lines().map(str::trim);
    let line = lines.find(|line| !line.is_empty() && !line.starts_with('#'))?;
    let (what, help) = if line.starts_with('[') && line.ends_with(']') {
        (
            "TOML",
            format!("data are a CSV file; the spec is the argument before it, and a map follows `{MAP}`"),
        )
    } else if line.starts_with('<') {
        ("XML", WANTED.to_owned())
    } else if line.starts_with('{') || line == "[" {
        ("JSON", WANTED.to_owned())
    } else {
        return None;
    };
    Some(UnreadableFile::new(format!("this file is not a table; it seems to be {what}"), help))
}

fn unreadable(file: &str, error: &csv::Error) -> Diagnostics {
    let found = match error.kind() {
        csv::ErrorKind::Io(error) => UnreadableFile::from_error(error, WANTED),
        csv::ErrorKind::Utf8 { pos, .. } => {
            let line = pos.as_ref().map_or(1, csv::Position::line);
            let message = format!("this file has a byte near line {line} that is not UTF-8 text");
            UnreadableFile::new(message, "save it as UTF-8, or write names without accents")
        }
        _ => UnreadableFile::new(format!("cannot read this file: {error}"), WANTED),
    };
    unfit(file, &found)
}

fn unfit(file: &str, UnreadableFile { message, help }: &UnreadableFile) -> Diagnostics {
    mistake::with_help(file, message, help)
}
