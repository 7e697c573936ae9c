//! Columns, and channels that read from them.

use abbe_spec::diagnostic::Span;

use super::from_rows::FromRows;

/// A column of a data file.
#[derive(Clone, Debug)]
pub struct Column {
    /// Heading of the column.
    pub name: String,
    /// Position in the map, if that is a file.
    pub(super) span: Option<Span>,
}

impl Column {
    /// Returns columns without names, of numbers that are in no table.
    pub(crate) fn unnamed<const N: usize>() -> Box<[Self; N]> {
        Box::new(std::array::from_fn(|_| Self { name: String::new(), span: None }))
    }
}

/// Linear scale of a column.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Scale {
    /// Factor to coherent units; negative for the opposite direction of counting.
    pub one: f64,
    /// Value at 0 in the column, in coherent units.
    pub zero: f64,
}

impl Scale {
    /// Identity scale of a column in coherent units.
    pub const COHERENT: Self = Self { one: 1.0, zero: 0.0 };

    /// Converts a number of the column to a value.
    pub(crate) fn value(self, number: f64) -> f64 {
        self.one * number + self.zero
    }

    /// Converts a value to a number of the column.
    pub(crate) fn number(self, value: f64) -> f64 {
        (value - self.zero) / self.one
    }
}

/// Source of a value.
#[derive(Clone, Debug)]
pub enum Channel {
    /// A column with a scale.
    Column(Column, Scale),
    /// A constant.
    Fixed(f64),
    /// A quantity computed from the rows.
    FromRows(FromRows),
}
