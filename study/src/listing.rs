//! A table as words, for text and for HTML.

use std::ops::Range;

use serde::Serialize;

/// What a table says: the first column is words, those in `numbers` are flush right.
#[derive(Clone, Debug, Serialize)]
pub struct Listing {
    /// The name of every column.
    pub header: Vec<&'static str>,
    /// Cell by cell.
    pub rows: Vec<Vec<String>>,
    /// The columns that hold numbers.
    pub numbers: Range<usize>,
}
