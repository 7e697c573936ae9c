//! Tables of a document.

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

/// Mark before the name of a column of numbers.
const NUMBERS: char = '>';

impl Table {
    /// Creates a table without rows. `>` before the name of a column marks a column of numbers.
    pub(crate) fn new<const N: usize>(caption: impl Into<String>, columns: [&str; N]) -> Self {
        Self::listing(caption, &columns, Vec::new())
    }

    /// Adds rows of one cell for each column.
    pub(crate) fn rows<const N: usize>(mut self, rows: impl IntoIterator<Item = [String; N]>) -> Self {
        self.rows.extend(rows.into_iter().map(Vec::from));
        self
    }

    /// Creates a table with rows; columns as for [`new`](Self::new).
    pub(crate) fn listing(
        caption: impl Into<String>,
        columns: &[impl AsRef<str>],
        rows: Vec<Vec<String>>,
    ) -> Self {
        let column = |name: &str| {
            let number = name.strip_prefix(NUMBERS);
            Column { name: number.unwrap_or(name).to_owned(), is_number: number.is_some() }
        };
        let columns = columns.iter().map(|name| column(name.as_ref())).collect();
        Self { caption: caption.into(), columns, rows, rest: String::new() }
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
