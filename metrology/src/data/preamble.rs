//! Lines above the heading of a table: `sep=;` states the separator, a title is an error.

use std::io::Cursor;

use abbe_spec::bounded::UnreadableFile;
use csv::StringRecord;

use super::dialect::{Dialect, SEPARATORS};
use abbe_study::{lines::RecordedReader, number::counted};

/// Number of records that are examined.
const LOOKED_AT: usize = 40;

/// Returns the separator that a first line `sep=;` states, and turns that line into a comment.
pub(super) fn stated_separator(text: &mut [u8]) -> Option<u8> {
    let start = if text.starts_with(b"\xef\xbb\xbf") { 3 } else { 0 };
    let line = text[start..].split(|byte| *byte == b'\n').next()?;
    let line = line.strip_suffix(b"\r").unwrap_or(line);
    let line = line.strip_prefix(b"\"").and_then(|line| line.strip_suffix(b"\"")).unwrap_or(line);
    let (key, [separator]) = line.split_last_chunk()?;
    let is_stated = key.eq_ignore_ascii_case(b"sep=") && SEPARATORS.contains(separator);
    let separator = is_stated.then_some(*separator)?;
    text[start] = b'#';
    Some(separator)
}

/// A line of a table.
struct Row {
    line: u64,
    /// Number of cells, without empty ones at the end.
    cells: usize,
    has_number: bool,
    /// Each of these cells is nonempty.
    is_full: bool,
}

/// Reports first lines that are not the heading.
///
/// They have fewer cells than the rows below, and the first line with as many cells as these has no
/// number. All separators are tried, because a title does not reveal the one of the table.
pub(super) fn above_heading(text: &[u8], dialect: Dialect) -> Option<UnreadableFile> {
    std::iter::once(dialect).chain(SEPARATORS.map(|separator| dialect.separated(separator))).find_map(
        |dialect| {
            let rows = rows(text, dialect);
            let columns = rows.iter().map(|row| row.cells).max()?;
            let heading = rows.iter().position(|row| row.cells == columns)?;
            let ([above @ .., _], below) = rows.split_at(heading + 1) else { return None };
            let (first, widest) = (above.first()?, above.iter().map(|row| row.cells).max()?);
            let names = &rows[heading];
            let is_of_table = |row: &&Row| row.has_number && row.cells > widest;
            let table = below.iter().filter(is_of_table).count();
            if columns < 2 || names.has_number || !names.is_full || 2 * table <= below.len() {
                return None;
            }
            let line = first.line;
            let message = format!(
                "line {line} is not the heading: it has {}, but line {} and the rows below have \
                 {columns}",
                counted(first.cells, "cell", "cells"),
                names.line
            );
            Some(UnreadableFile::new(message, "remove the lines above the heading, which names the columns"))
        },
    )
}

fn rows(text: &[u8], dialect: Dialect) -> Vec<Row> {
    let (watched, mut lines) = RecordedReader::new(Cursor::new(text));
    let records = dialect.all_records(watched).into_records().take(LOOKED_AT).filter_map(Result::ok);
    let row = |record: StringRecord| {
        let cells = (1..=record.len()).rev().find(|cells| !record[cells - 1].is_empty()).unwrap_or(0);
        let is_number =
            |cell: &str| cell.parse::<f64>().is_ok() || cell.replacen(',', ".", 1).parse::<f64>().is_ok();
        Row {
            line: record.position().map_or(0, |position| lines.record_line(position.byte())),
            cells,
            has_number: record.iter().any(is_number),
            is_full: record.iter().take(cells).all(|cell| !cell.is_empty()),
        }
    };
    records.map(row).collect()
}

#[cfg(test)]
mod tests;
