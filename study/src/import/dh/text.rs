//! Where a table stands in a text: its heading, its rows, and what is said around it.

use std::path::Path;

use abbe_spec::DhConvention;
use abbe_spec::diagnostic::{Diagnostic, Span};
use abbe_spec::document::Document;

use super::columns::Meaning;
use crate::number::counted;

/// The most rows of a table.
const MOST_ROWS: usize = 1000;

/// A table in a text.
pub(super) struct Text {
    /// What it is called: by itself, or as its file.
    pub(super) name: String,
    /// The cells of the heading.
    pub(super) heading: Vec<Span>,
    /// The cells of each row.
    pub(super) rows: Vec<Vec<Span>>,
    /// Whether decimals can have a comma.
    pub(super) decimal_comma: bool,
    /// Where the text says which convention it is.
    pub(super) convention: Option<(Span, DhConvention)>,
    /// Whether something is said about base or tool beside it.
    pub(super) has_ends: bool,
}

impl Text {
    /// The first line whose cells are names of Denavit-Hartenberg numbers, and the rows below it.
    pub(super) fn find(document: &mut Document) -> Option<Self> {
        let whole = document.text.clone();
        let known = |cells: &[Span]| {
            let cells = cells.iter().filter(|cell| Meaning::of(&whole[(*cell).clone()]).is_some());
            cells.count() >= 2
        };
        let mut lines = lines(&whole);
        let mut around: Vec<Span> = Vec::new();
        let heading = lines.by_ref().find_map(|line| {
            let separator = separator(&whole[line.clone()])?;
            let cells = cells(&whole, line.clone(), separator);
            if !known(&cells) {
                around.push(line);
                return None;
            }
            Some((cells, separator, line))
        });
        let Some((heading, separator, line)) = heading else {
            document.mistake(no_table(&whole));
            return None;
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
                0 => "there is no row below this heading".to_owned(),
                rows => format!("this table has {rows} rows; {MOST_ROWS} can be read"),
            };
            document.mistake(Diagnostic::new(line, message).help("one row for each joint, from base to tip"));
            return None;
        }
        let columns = heading.iter().rposition(|cell| !cell.is_empty()).map_or(0, |last| last + 1);
        for row in &rows {
            if let Some(last) = row.last().filter(|_| row.len() < columns) {
                let cells = counted(row.len(), "cell", "cells");
                let message = format!("this row has {cells}, the heading {columns}");
                let help = "a row has a cell for every column, `0` where a number is zero, nothing where there is none";
                document.mistake(Diagnostic::new(last.clone(), message).label("it ends here").help(help));
                return None;
            }
            let beyond = row.get(heading.len()..).unwrap_or_default();
            if let Some(cell) = beyond.iter().find(|cell| !cell.is_empty()) {
                let message = format!("this row has {} cells, the heading {}", row.len(), heading.len());
                let help = "is there a separator inside a cell, or a comma in a decimal? Write `;` between cells then";
                document.mistake(Diagnostic::new(cell.clone(), message).label("one too many").help(help));
                return None;
            }
        }
        let said = |words: [&str; 2]| {
            around.iter().find_map(|line| {
                let text = whole[line.clone()].to_lowercase();
                words.iter().find_map(|word| {
                    let at = text.find(word).filter(|_| text.len() == line.len())?;
                    Some(line.start + at..line.start + at + word.len())
                })
            })
        };
        let standard = said(["stddh", "standard dh"]).map(|span| (span, DhConvention::Standard));
        let convention =
            standard.or_else(|| said(["moddh", "modified dh"]).map(|span| (span, DhConvention::Modified)));
        let begins = |line: &Span, end: &str| {
            let text = whole[line.clone()].trim_start_matches(|c: char| c == '│' || c.is_whitespace());
            text.strip_prefix(end).is_some_and(|rest| rest.trim_start().starts_with([':', '=', '│']))
        };
        let has_ends = around.iter().any(|line| ["base", "tool"].iter().any(|end| begins(line, end)));
        let of_file = Path::new(&document.path).file_stem().map(|name| name.to_string_lossy().into_owned());
        let titled = around.iter().find_map(|line| title(&whole[line.clone()]));
        Some(Self {
            name: titled.or(of_file).unwrap_or_else(|| "robot".to_owned()),
            heading,
            rows,
            decimal_comma: separator != ',',
            convention,
            has_ends,
        })
    }
}

/// What the Robotics Toolbox says above a table: `Puma 560 [Unimation]:: 6 axis, …`, `DHRobot: Puma 560 (by Unimation), 6 joints …`.
fn title(line: &str) -> Option<String> {
    let name = match line.trim().split_once("::") {
        Some((name, _)) => name.split('[').next()?,
        None => line.trim().strip_prefix("DHRobot")?.split_once(':')?.1.split([',', '(']).next()?,
    };
    Some(name.trim().to_owned()).filter(|name| !name.is_empty())
}

/// The lines of a text, without their ends.
fn lines(text: &str) -> impl Iterator<Item = Span> {
    let mut start = 0;
    text.split_inclusive('\n').map(move |line| {
        let begin = start;
        start += line.len();
        // Of some programs a text begins with a mark that is no part of it.
        let mark = if line.starts_with('\u{feff}') { '\u{feff}'.len_utf8() } else { 0 };
        // A tab at its end is a cell.
        let inner = line.trim_end_matches(|c: char| c != '\t' && c.is_whitespace());
        begin + mark..begin + inner.len().max(mark)
    })
}

/// What stands between the cells of a line, if anything can.
fn separator(line: &str) -> Option<char> {
    let count = |separator: &char| line.matches(*separator).count();
    let most = ['\t', ';', ',', '|', '│'].into_iter().max_by_key(count)?;
    (count(&most) > 0 && !line.starts_with('#')).then_some(most)
}

/// The cells of a line, without blanks and quotes around them.
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
        // The table's own frame.
        cells.remove(0);
        if cells.last().is_some_and(Span::is_empty) {
            cells.pop();
        }
    }
    cells
}

fn trimmed(text: &str, cell: Span) -> Span {
    let inner = text[cell.clone()].trim_matches(|c: char| c.is_whitespace() || c == '"');
    let start = cell.start + text[cell.clone()].find(inner).unwrap_or_default();
    start..start + inner.len()
}

fn no_table(text: &str) -> Diagnostic {
    let start = text.trim_start();
    let help = "its first line names the columns: `theta,d,a,alpha`";
    if start.is_empty() {
        return Diagnostic::whole_file("this file is empty").help(help);
    }
    let begin = text.len() - start.len();
    let line = begin..begin + start.lines().next().unwrap_or_default().len();
    let message = match start.starts_with('<') {
        true => "this is XML, not a table",
        false => "this file has no table of Denavit-Hartenberg numbers",
    };
    let help = if start.starts_with('<') { "leave out `--dh` for URDF" } else { help };
    Diagnostic::new(line, message).label("expected a heading").help(help)
}
