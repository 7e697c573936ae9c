//! Table of text cells, for text and HTML.

use std::ops::Range;

use serde::Serialize;

/// Table of text cells. Columns in `numbers` are right-aligned.
#[derive(Clone, Debug, Serialize)]
pub struct Listing {
    /// Names of the columns.
    pub header: Vec<&'static str>,
    /// Cells, row by row.
    pub rows: Vec<Vec<String>>,
    /// Range of the numeric columns.
    pub numbers: Range<usize>,
}
