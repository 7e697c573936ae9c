//! Columns, and values that may come from them.

use abbe_codegen::diagnostic::Span;

use super::from_rows::FromRows;

/// A column of the file.
#[derive(Clone, Debug)]
pub struct Column {
    /// Its name.
    pub name: String,
    /// Where the map names it, if that is a file.
    pub(super) span: Option<Span>,
}

/// Where a value comes from.
#[derive(Clone, Debug)]
pub enum Channel {
    /// A column, times a factor that makes it coherent.
    Column(Column, f64),
    /// It is the same in every row.
    Fixed(f64),
    /// It follows from the rows.
    FromRows(FromRows),
}
