//! Tables for people: columns under a ruled heading, at most 100 wide.

use std::fmt;

use abbe_study::Listing;
use abbe_study::number::NO_BREAK;
use comfy_table::{CellAlignment, ColumnConstraint, ContentArrangement, LineStyle, Row, TableStyle};

/// The width that everything is set to, so that the same input gives the same text on every terminal.
pub const WIDTH: usize = 100;

const STYLE: TableStyle =
    TableStyle::new().header_separator(LineStyle::none().fill('─').junction('─').left('─').right('─'));

/// A listing as a table.
pub fn listed(listing: &Listing) -> String {
    let mut table = Table::new(&listing.header);
    listing.rows.iter().for_each(|row| table.row(row.clone()));
    table.right(&listing.numbers.clone().collect::<Vec<_>>()).to_string()
}

/// A table that grows row by row.
#[derive(Debug)]
pub struct Table(comfy_table::Table);

impl Table {
    /// An empty table.
    pub fn new(header: &[&str]) -> Self {
        let mut table = comfy_table::Table::new();
        table.load_style(STYLE).set_content_arrangement(ContentArrangement::Dynamic).set_width(WIDTH as u16);
        table.set_header(header.to_vec());
        Self(table)
    }

    /// Adds a row. Lines of a cell stand beside the same lines of the others.
    pub fn row<T: Into<Row>>(&mut self, cells: T) {
        self.0.add_row(cells);
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

    /// Keeps columns as wide as their text.
    pub fn unwrapped(mut self, columns: &[usize]) -> Self {
        for &column in columns {
            if let Some(column) = self.0.column_mut(column) {
                column.set_constraint(ColumnConstraint::ContentWidth);
            }
        }
        self
    }
}

impl fmt::Display for Table {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.0.lines().try_for_each(|line| writeln!(f, "{}", line.trim_end().replace(NO_BREAK, " ")))
    }
}

/// A text wrapped at the width of the tables, its lines after the first indented.
pub fn wrapped(text: &str, indent: usize) -> String {
    let (mut lines, mut width) = (String::new(), indent);
    for word in text.split([' ', '\n']).filter(|word| !word.is_empty()) {
        let length = word.chars().count();
        if width > indent && width + 1 + length > WIDTH {
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
