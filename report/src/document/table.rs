//! Tables of a document.

use std::ops::Range;

/// Table of texts. The first column names the rows.
#[derive(Clone, Debug)]
pub(crate) struct Table {
    /// Caption; empty on the first screen.
    pub(crate) caption: String,
    pub(crate) columns: Vec<Column>,
    pub(crate) rows: Vec<Vec<String>>,
    /// Rows that are not shown, such as `… 3 more`; may be empty.
    pub(crate) rest: String,
}

/// Column of a table.
#[derive(Clone, Debug)]
pub(crate) struct Column {
    pub(crate) name: String,
    /// Numbers are flush right, and never wrapped.
    pub(crate) is_number: bool,
}

/// Creates a column of words.
pub(crate) fn words(name: impl Into<String>) -> Column {
    Column { name: name.into(), is_number: false }
}

/// Creates a column of numbers.
pub(crate) fn number(name: impl Into<String>) -> Column {
    Column { name: name.into(), is_number: true }
}

impl Table {
    /// Creates a table without rows.
    pub(crate) fn new<const N: usize>(caption: impl Into<String>, columns: [Column; N]) -> Self {
        Self { caption: caption.into(), columns: columns.into(), rows: Vec::new(), rest: String::new() }
    }

    /// Adds rows of one cell for each column.
    pub(crate) fn rows<const N: usize>(mut self, rows: impl IntoIterator<Item = [String; N]>) -> Self {
        self.rows.extend(rows.into_iter().map(Vec::from));
        self
    }

    /// Creates a table without a caption, of which some columns are numbers.
    pub(crate) fn listing(header: &[&str], rows: Vec<Vec<String>>, numbers: Range<usize>) -> Self {
        let columns = header
            .iter()
            .enumerate()
            .map(|(i, name)| Column { name: (*name).to_owned(), is_number: numbers.contains(&i) });
        Self { caption: String::new(), columns: columns.collect(), rows, rest: String::new() }
    }

    /// Sets the caption.
    pub(crate) fn titled(self, caption: impl Into<String>) -> Self {
        Self { caption: caption.into(), ..self }
    }

    /// Iterates over the names of the columns; `None` if they have none.
    pub(crate) fn heading(&self) -> Option<impl Iterator<Item = &str>> {
        let names = || self.columns.iter().map(|column| column.name.as_str());
        names().any(|name| !name.is_empty()).then(names)
    }

    /// Adds a row.
    pub(crate) fn row<const N: usize>(&mut self, row: [String; N]) {
        self.rows.push(row.into());
    }
}
