//! Tables for people: columns under a ruled heading, and wrapped sentences.

use std::{cell::Cell, fmt, ops::RangeInclusive};

use abbe_study::number::NO_BREAK;
use comfy_table::{CellAlignment, ColumnConstraint, ContentArrangement, LineStyle, TableStyle, Width};

/// Width of text in columns, except within [`at_width`]: files and pages do not depend on a
/// terminal.
pub const WIDTH: usize = 100;

/// Widths that text can have: in fewer columns tables are unreadable, in more sentences are.
const WIDTHS: RangeInclusive<usize> = 60..=160;

/// Returns the width of text in columns.
pub(super) fn columns() -> usize {
    COLUMNS.get()
}

thread_local! {
    static COLUMNS: Cell<usize> = const { Cell::new(WIDTH) };
}

/// Formats text for a width of 60 to 160 columns; narrower and wider ones count as these.
pub fn at_width<T>(columns: usize, format: impl FnOnce() -> T) -> T {
    let before = COLUMNS.replace(columns.clamp(*WIDTHS.start(), *WIDTHS.end()));
    let formatted = format();
    COLUMNS.set(before);
    formatted
}

/// Maximum number of characters of a word in a table; the rest is cut off.
const LONGEST: usize = 2 * WIDTH;

const STYLE: TableStyle =
    TableStyle::new().header_separator(LineStyle::none().fill('─').junction('─').left('─').right('─'));

/// A table that grows row by row.
#[derive(Debug)]
pub struct Table(comfy_table::Table);

impl Table {
    /// An empty table.
    pub fn new(header: &[&str]) -> Self {
        let mut table = comfy_table::Table::new();
        table
            .load_style(STYLE)
            .set_content_arrangement(ContentArrangement::Dynamic)
            .set_width(COLUMNS.get() as u16);
        table.set_header(header.to_vec());
        // A heading is wrapped between words only.
        for (column, name) in table.column_iter_mut().zip(header) {
            let longest = name.split(' ').map(|word| word.chars().count()).max().unwrap_or_default();
            column.set_constraint(ColumnConstraint::LowerBoundary(Width::Fixed(
                longest as u16 + column.padding_width(),
            )));
        }
        Self(table)
    }

    /// Adds a row. The lines of a cell stand beside those of the other cells; longer words than two
    /// lines of the widest table are cut.
    pub fn row<T: Into<String>>(&mut self, cells: impl IntoIterator<Item = T>) {
        self.0.add_row(cells.into_iter().map(|cell| cut(cell.into())));
    }

    /// Sets columns flush right: numbers, which are never wrapped.
    pub fn right(mut self, columns: &[usize]) -> Self {
        for &column in columns {
            if let Some(column) = self.0.column_mut(column) {
                column.set_cell_alignment(CellAlignment::Right);
                column.set_constraint(ColumnConstraint::ContentWidth);
            }
        }
        self
    }
}

/// Cuts words to [`LONGEST`] characters: the layout time grows with the square of their length.
fn cut(text: String) -> String {
    let blank = |letter: char| letter == ' ' || letter == '\n';
    if text.split(blank).all(|word| word.len() <= LONGEST) {
        return text;
    }
    let mut cut = String::new();
    for word in text.split_inclusive(blank) {
        let letters = word.trim_end_matches(blank);
        match letters.char_indices().nth(LONGEST) {
            Some((end, _)) => cut.extend([&letters[..end], "…", &word[letters.len()..]]),
            None => cut.push_str(word),
        }
    }
    cut
}

impl fmt::Display for Table {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let mut table = self.0.clone();
        // Width has priority over whole words.
        if table.lines().any(|line| Some(line.trim_end().chars().count()) > table.width().map(usize::from)) {
            for column in table.column_iter_mut() {
                if matches!(column.constraint(), Some(ColumnConstraint::LowerBoundary(_))) {
                    column.remove_constraint();
                }
            }
        }
        table.lines().try_for_each(|line| writeln!(f, "{}", line.trim_end().replace(NO_BREAK, " ")))
    }
}

/// Wraps a text at the width of the tables and indents every line except the first.
pub fn wrapped(text: &str, indent: usize) -> String {
    let (mut lines, mut width) = (String::new(), indent);
    for word in text.split([' ', '\n']).filter(|word| !word.is_empty()) {
        let length = word.chars().count();
        if width > indent && width + 1 + length > COLUMNS.get() {
            lines.push_str(&format!("\n{:indent$}", ""));
            width = indent;
        } else if width > indent {
            lines.push(' ');
            width += 1;
        }
        lines.push_str(word);
        width += length;
    }
    lines.replace(NO_BREAK, " ")
}

#[cfg(test)]
mod tests;
