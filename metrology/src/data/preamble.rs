//! Lines above the heading of a table: `sep=;` states the separator, a title is an error.

use std::io::Cursor;

use abbe_spec::bounded::UnreadableFile;
use csv::StringRecord;

use super::dialect::{Dialect, SEPARATORS};
use abbe_study::lines::RecordedReader;
use abbe_study::number::counted;

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
mod tests {
    use super::*;

    fn found(text: &str) -> Option<String> {
        let mut text = text.as_bytes().to_vec();
        let stated = stated_separator(&mut text);
        above_heading(&text, Dialect::detect(&text, stated)).map(|found| found.message)
    }

    #[test]
    fn titles_are_told_from_headings() {
        let title = |line: u64, cells: &str, heading: u64| {
            Some(format!(
                "line {line} is not the heading: it has {cells}, but line {heading} and the rows below have 3"
            ))
        };
        for (text, expected) in [
            ("Run of Monday\nq1,x,y\n1,2,3\n4,5,6\n", title(1, "1 cell", 2)),
            ("Run of Monday;;\r\nq1;x;y\r\n1,5;2,5;3\r\n", title(1, "1 cell", 2)),
            // The title has a comma, which is not the separator.
            ("Monday, hall 2\nq1;x;y\n1,5;2;3\n", title(1, "1 cell", 2)),
            ("\n# by hand\nMonday\nHall;2\n\nq1;x;y\n1;2;3\n4;;6\n7;8;\n", title(3, "1 cell", 6)),
            ("sep=;\nMonday\nq1;x;y\n1;2;3\n", title(2, "1 cell", 3)),
            // The first line is a heading, whatever follows.
            ("q1,x,y\n1,2,3\n", None),
            ("q1,x,y\ndeg,mm,mm\n1,2,3\n", None),
            ("q1,x\n1,2,3\n4,5,6\n", None),
            ("q1,x\n1,2\nof,no,use\n4,5\n", None),
            ("q1\n1,5\n2,5\n", None),
            ("name\nfirst; good\nsecond; bad\n", None),
            ("q1,x\n", None),
            ("", None),
        ] {
            assert_eq!(found(text), expected, "{text:?}");
        }
    }

    #[test]
    fn separators_are_stated() {
        for (text, expected) in [
            ("sep=;\na,b\n", Some(b';')),
            ("\u{feff}SEP=,\r\na;b;c\r\n", Some(b',')),
            ("\"sep=\t\"\na;b\n", Some(b'\t')),
            ("sep=;", Some(b';')),
            ("sep=|\na|b\n", None),
            ("sep=\n", None),
            ("sep=;;\n", None),
            ("a,b\nsep=;\n", None),
        ] {
            let mut bytes = text.as_bytes().to_vec();
            assert_eq!(stated_separator(&mut bytes), expected, "{text:?}");
            assert_eq!(bytes == text.as_bytes(), expected.is_none());
        }
    }
}
