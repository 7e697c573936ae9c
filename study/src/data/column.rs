//! Columns, and values that may come from them.

use abbe_spec::diagnostic::Span;

use super::from_rows::FromRows;

/// A column of the file.
#[derive(Clone, Debug)]
pub struct Column {
    /// Its name.
    pub name: String,
    /// Where the map names it, if that is a file.
    pub(super) span: Option<Span>,
}

/// How the numbers of a column are read.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Scale {
    /// One in the column, in coherent units; negative if it counts the other way round.
    pub one: f64,
    /// What it is where the column says 0, in coherent units.
    pub zero: f64,
}

impl Scale {
    /// Coherent numbers as they are.
    pub const COHERENT: Self = Self { one: 1.0, zero: 0.0 };

    /// What a number of the column is.
    pub(super) fn value(self, number: f64) -> f64 {
        self.one * number + self.zero
    }

    /// What stands in the column for a value.
    pub(super) fn number(self, value: f64) -> f64 {
        (value - self.zero) / self.one
    }
}

/// Where a value comes from.
#[derive(Clone, Debug)]
pub enum Channel {
    /// A column, on a scale.
    Column(Column, Scale),
    /// It is the same in every row.
    Fixed(f64),
    /// It follows from the rows.
    FromRows(FromRows),
}
