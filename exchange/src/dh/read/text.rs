//! Finds a table in a text: its heading, its rows, and remarks around it.

use abbe_spec::{DhConvention, Diagnostic, Document, diagnostic::Span, number::counted, option::DH};
use std::path::Path;

use super::heading::Heading;

/// Largest number of rows.
const MOST_ROWS: usize = 1000;

/// Table in a text.
pub(super) struct Text {
    /// Name of the robot: the title above the table, or else the name of the file.
    pub(super) name: String,
    /// Spans of the cells of the heading.
    pub(super) heading: Vec<Span>,
    /// Spans of the cells of each row.
    pub(super) rows: Vec<Vec<Span>>,
    /// A comma in a number is a decimal point.
    pub(super) decimal_comma: bool,
    /// Convention that the text names, and where.
    pub(super) convention: Option<(Span, DhConvention)>,
    /// The text around the table has a line about base or tool.
    pub(super) has_ends: bool,
}

impl Text {
    /// Finds the first line with two known names of columns, and the rows below it.
    pub(super) fn find(document: &Document) -> Option<Self> {
        let whole = document.text.clone();
        let is_heading = |cells: &[Span]| {
            cells.iter().filter(|cell| Heading::parse(&whole[(*cell).clone()]).is_some()).count() >= 2
        };
        let mut lines = lines(&whole);
        let mut around: Vec<Span> = Vec::new();
        let heading = lines.by_ref().find_map(|line| {
            let separator = separator(&whole[line.clone()])?;
            let cells = cells(&whole, line.clone(), separator);
            if !is_heading(&cells) {
                around.push(line);
                return None;
            }
            Some((cells, separator, line))
        });
        let Some((heading, separator, line)) = heading else {
            return document.fail(no_table(&whole));
        };
        let mut rows: Vec<Vec<Span>> = Vec::new();
        let framed = matches!(separator, '|' | '│');
        let mut ended = false;
        for line in lines {
            let text = whole[line.clone()].trim();
            let is_border = framed && !text.contains(separator);
            if ended || (is_border && !rows.is_empty()) {
                ended = true;
                around.push(line);
            } else if !(is_border || text.is_empty() || text.starts_with('#')) {
                rows.push(cells(&whole, line, separator));
            }
        }
        if rows.is_empty() || rows.len() > MOST_ROWS {
            let message = match rows.len() {
                0 => "there are no rows below this heading".to_owned(),
                rows => format!("this table has {rows} rows; the maximum is {MOST_ROWS}"),
            };
            return document.refuse(line, message, "write one row for each joint, from base to tip");
        }
        let columns = heading.iter().rposition(|cell| !cell.is_empty()).map_or(0, |last| last + 1);
        for row in &rows {
            if let Some(last) = row.last().filter(|_| row.len() < columns) {
                let cells = counted(row.len(), "cell", "cells");
                let message = format!("this row has {cells}, but the heading has {columns}");
                let help = "write a cell for every column: 0 for zero, or an empty cell if it \
                    does not apply";
                return document
                    .fail(Diagnostic::new(last.clone(), message).label("the row ends here").help(help));
            }
            let beyond = row.get(heading.len()..).unwrap_or_default();
            if let Some(cell) = beyond.iter().find(|cell| !cell.is_empty()) {
                let message =
                    format!("this row has {} cells, but the heading has {}", row.len(), heading.len());
                let help = "if a cell contains the separator, or decimals have a comma, separate \
                    the cells by `;`";
                return document
                    .fail(Diagnostic::new(cell.clone(), message).label("first extra cell").help(help));
            }
        }
        let find = |words: [&str; 2]| {
            around.iter().find_map(|line| {
                let text = whole[line.clone()].to_lowercase();
                words.iter().find_map(|word| {
                    let at = text.find(word).filter(|_| text.len() == line.len())?;
                    Some(line.start + at..line.start + at + word.len())
                })
            })
        };
        let standard = find(["stddh", "standard dh"]).map(|span| (span, DhConvention::Standard));
        let convention =
            standard.or_else(|| find(["moddh", "modified dh"]).map(|span| (span, DhConvention::Modified)));
        let begins = |line: &Span, end: &str| {
            let text = whole[line.clone()].trim_start_matches(|c: char| c == '│' || c.is_whitespace());
            text.strip_prefix(end).is_some_and(|rest| rest.trim_start().starts_with([':', '=', '│']))
        };
        let has_ends = around.iter().any(|line| ["base", "tool"].iter().any(|end| begins(line, end)));
        let file_name = Path::new(&document.path).file_stem().map(|name| name.to_string_lossy().into_owned());
        let titled = around.iter().find_map(|line| title(&whole[line.clone()]));
        Some(Self {
            name: titled.or(file_name).unwrap_or_else(|| "robot".to_owned()),
            heading,
            rows,
            decimal_comma: separator != ',',
            convention,
            has_ends,
        })
    }
}

/// Returns the name of the robot in a title of the Robotics Toolbox: `Puma 560 [Unimation]:: 6
/// axis, …`, `DHRobot: Puma 560 (by Unimation), 6 joints …`.
fn title(line: &str) -> Option<String> {
    let name = match line.trim().split_once("::") {
        Some((name, _)) => name.split('[').next()?,
        None => line.trim().strip_prefix("DHRobot")?.split_once(':')?.1.split([',', '(']).next()?,
    };
    Some(name.trim().to_owned()).filter(|name| !name.is_empty())
}

/// Iterates over the lines of a text, without their line ends.
fn lines(text: &str) -> impl Iterator<Item = Span> {
    let mut start = 0;
    text.split_inclusive('\n').map(move |line| {
        let begin = start;
        start += line.len();
        // Some programs begin a text with a byte order mark.
        let mark = if line.starts_with('\u{feff}') { '\u{feff}'.len_utf8() } else { 0 };
        // A tab at the end of a line begins an empty cell.
        let inner = line.trim_end_matches(|c: char| c != '\t' && c.is_whitespace());
        begin + mark..begin + inner.len().max(mark)
    })
}

/// Returns the separator that a line has most often, if it has any.
fn separator(line: &str) -> Option<char> {
    let count = |separator: &char| line.matches(*separator).count();
    let most = ['\t', ';', ',', '|', '│'].into_iter().max_by_key(count)?;
    (count(&most) > 0 && !line.starts_with('#')).then_some(most)
}

/// Splits a line into cells, without blanks and quotes around them.
fn cells(text: &str, line: Span, separator: char) -> Vec<Span> {
    let mut cells = Vec::new();
    let (mut begin, mut quoted) = (line.start, false);
    for (at, c) in text[line.clone()].char_indices() {
        let at = line.start + at;
        match c {
            '"' => quoted = !quoted,
            c if c == separator && !quoted => {
                cells.push(begin..at);
                begin = at + c.len_utf8();
            }
            _ => {}
        }
    }
    cells.push(begin..line.end);
    let mut cells: Vec<Span> = cells.into_iter().map(|cell| trimmed(text, cell)).collect();
    if matches!(separator, '|' | '│') {
        // The border of the table adds empty cells at both ends.
        cells.remove(0);
        if cells.last().is_some_and(Span::is_empty) {
            cells.pop();
        }
    }
    cells
}

/// Removes blanks and quotes around a cell.
fn trimmed(text: &str, cell: Span) -> Span {
    let inner = text[cell.clone()].trim_matches(|c: char| c.is_whitespace() || c == '"');
    let start = cell.start + text[cell.clone()].find(inner).unwrap_or_default();
    start..start + inner.len()
}

/// Reports a text without a table.
fn no_table(text: &str) -> Diagnostic {
    let start = text.trim_start();
    let help = "its first line must name the columns: `theta,d,a,alpha`";
    if start.is_empty() {
        return Diagnostic::whole_file("this file is empty").help(help);
    }
    let begin = text.len() - start.len();
    let line = begin..begin + start.lines().next().unwrap_or_default().len();
    let message = match start.starts_with('<') {
        true => "this is XML, not a table",
        false => "this file has no table of Denavit-Hartenberg numbers",
    };
    let help = if start.starts_with('<') { &format!("leave out `{DH}` for URDF") } else { help };
    Diagnostic::new(line, message).label("expected a heading").help(help)
}
