//! One row below a heading.

use std::{borrow::Cow, sync::Arc};

use abbe_spec::{csv_writer::meant, expr::LARGEST};
use csv::StringRecord;

use super::{cells::Cells, dialect::Dialect};
use abbe_study::date::parse_date;

/// A row of a file or of columns in memory.
pub(super) struct Record {
    /// Line in the file, from 1; index of the row in a table.
    pub(super) line: u64,
    heading: Arc<[String]>,
    fields: Fields,
}

/// Storage of the cells.
enum Fields {
    /// Texts of a file.
    Written(Dialect, StringRecord),
    /// Columns in memory, and the index of the row.
    Columns(Arc<[Arc<Cells>]>, usize),
}

/// One cell.
enum Cell<'a> {
    Text(&'a str),
    Number(f64),
}

impl Record {
    pub(super) fn written(line: u64, heading: Arc<[String]>, dialect: Dialect, fields: StringRecord) -> Self {
        Self { line, heading, fields: Fields::Written(dialect, fields) }
    }

    pub(super) fn of_columns(row: usize, heading: Arc<[String]>, cells: Arc<[Arc<Cells>]>) -> Self {
        Self { line: row as u64, heading, fields: Fields::Columns(cells, row) }
    }

    /// Returns a cell; none beyond the end.
    fn cell(&self, place: usize) -> Option<Cell<'_>> {
        match &self.fields {
            Fields::Written(_, fields) => fields.get(place).map(Cell::Text),
            Fields::Columns(cells, row) => match &**cells.get(place)? {
                Cells::Numbers(numbers) if numbers[*row].is_nan() => Some(Cell::Text("")),
                Cells::Numbers(numbers) => Some(Cell::Number(numbers[*row])),
                Cells::Texts(texts) => Some(Cell::Text(&texts[*row])),
            },
        }
    }

    /// Parses the number in a text.
    fn parsed(&self, text: &str) -> Option<f64> {
        match &self.fields {
            Fields::Written(dialect, _) => dialect.number(text),
            Fields::Columns(..) => text.trim().parse().ok(),
        }
    }

    /// Returns a message if there are nonempty cells beyond the heading.
    pub(super) fn too_long(&self) -> Option<String> {
        let Fields::Written(dialect, fields) = &self.fields else { return None };
        let cells = (1..=fields.len()).rev().find(|cells| !self.is_empty(cells - 1))?;
        let columns = self.heading.len();
        (cells > columns).then(|| {
            let between = dialect.delimiter();
            format!(
                "the row has {cells} cells, but the heading has {columns}; quote cells that \
                 contain {between}"
            )
        })
    }

    /// Returns whether a cell is empty.
    pub(super) fn is_empty(&self, place: usize) -> bool {
        matches!(self.cell(place), None | Some(Cell::Text("")))
    }

    /// Returns the finite numbers of some cells, or the reason of the first that has none.
    pub(super) fn numbers(&self, places: &[usize]) -> Result<Vec<f64>, String> {
        places.iter().map(|place| self.number(*place)).collect()
    }

    /// Returns the text of a cell.
    pub(super) fn text(&self, place: usize) -> Cow<'_, str> {
        match self.cell(place) {
            None => "".into(),
            Some(Cell::Text(text)) => meant(text).into(),
            Some(Cell::Number(number)) => number.to_string().into(),
        }
    }

    /// Returns the time in a cell: a number, or the days from 1970-01-01 to a date.
    pub(super) fn time(&self, place: usize) -> Result<f64, String> {
        let text = self.text(place);
        let time = parse_date(&text).map(|(_, time)| time).or_else(|| self.parsed(&text));
        time.filter(|time| time.abs() <= LARGEST).ok_or_else(|| {
            format!("`{}` is `{}`, neither a date nor a number", self.heading[place], text.escape_debug())
        })
    }

    /// Returns the finite number in a cell, or the reason of the failure.
    pub(super) fn number(&self, place: usize) -> Result<f64, String> {
        let name = &self.heading[place];
        let (number, text) = match self.cell(place) {
            None => return Err(format!("the row ends before `{name}`")),
            Some(Cell::Text("")) => return Err(format!("`{name}` is missing")),
            Some(Cell::Text(text)) => (self.parsed(text), text),
            Some(Cell::Number(number)) => (Some(number), ""),
        };
        match number {
            Some(value) if value.abs() <= LARGEST => Ok(value),
            Some(value) if value.is_finite() => Err(format!("`{name}` is `{value:e}`; the maximum is 1e150")),
            Some(value) if text.is_empty() => Err(format!("`{name}` is `{value}`")),
            Some(_) => Err(format!("`{name}` is `{}`", text.escape_debug())),
            None => Err(format!("`{name}` is `{}`, not a number", text.escape_debug())),
        }
    }
}
