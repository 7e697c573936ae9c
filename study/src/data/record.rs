//! One row below a heading.

use std::borrow::Cow;
use std::sync::Arc;

use abbe_spec::cell::meant;
use abbe_spec::expr::LARGEST;
use csv::StringRecord;

use super::cells::Cells;
use super::date::parse_date;
use super::dialect::Dialect;

/// A record below the heading.
pub(super) struct Record {
    /// Its line in the file, from 1; in a table its row, from 0.
    pub(super) line: u64,
    heading: Arc<[String]>,
    fields: Fields,
}

/// What stands in it.
enum Fields {
    /// In a file: texts.
    Written(Dialect, StringRecord),
    /// In columns: their cells in one row.
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

    /// What stands at a place, none behind its end.
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

    /// The number that a text is.
    fn parsed(&self, text: &str) -> Option<f64> {
        match &self.fields {
            Fields::Written(dialect, _) => dialect.number(text),
            Fields::Columns(..) => text.trim().parse().ok(),
        }
    }

    /// Whether there are cells beyond the heading, and how many in all. Empty ones do not count.
    pub(super) fn too_long(&self) -> Option<String> {
        let Fields::Written(dialect, fields) = &self.fields else { return None };
        let cells = (1..=fields.len()).rev().find(|cells| !self.is_empty(cells - 1))?;
        let columns = self.heading.len();
        (cells > columns).then(|| {
            let between = dialect.delimiter();
            format!(
                "it has {cells} cells, the heading {columns}: is there one of the {between} inside a cell?"
            )
        })
    }

    /// Whether there is nothing at a place.
    pub(super) fn is_empty(&self, place: usize) -> bool {
        matches!(self.cell(place), None | Some(Cell::Text("")))
    }

    /// The finite numbers at some places, or why one is none.
    pub(super) fn numbers(&self, places: &[usize]) -> Result<Vec<f64>, String> {
        places.iter().map(|place| self.number(*place)).collect()
    }

    /// What stands at a place.
    pub(super) fn text(&self, place: usize) -> Cow<'_, str> {
        match self.cell(place) {
            None => "".into(),
            Some(Cell::Text(text)) => meant(text).into(),
            Some(Cell::Number(number)) => number.to_string().into(),
        }
    }

    /// The time at a place: a number, or of a date the days since 1970.
    pub(super) fn time(&self, place: usize) -> Result<f64, String> {
        let text = self.text(place);
        let time = parse_date(&text).map(|(_, time)| time).or_else(|| self.parsed(&text));
        time.filter(|time| time.abs() <= LARGEST).ok_or_else(|| {
            format!("`{}` is `{}`, no date and no number", self.heading[place], text.escape_debug())
        })
    }

    /// The finite number at a place, or why it is none.
    pub(super) fn number(&self, place: usize) -> Result<f64, String> {
        let name = &self.heading[place];
        let (number, text) = match self.cell(place) {
            None => return Err(format!("it ends before `{name}`")),
            Some(Cell::Text("")) => return Err(format!("`{name}` is missing")),
            Some(Cell::Text(text)) => (self.parsed(text), text),
            Some(Cell::Number(number)) => (Some(number), ""),
        };
        match number {
            Some(value) if value.abs() <= LARGEST => Ok(value),
            Some(value) if value.is_finite() => {
                Err(format!("`{name}` is `{value:e}`: numbers go up to 1e150"))
            }
            Some(value) if text.is_empty() => Err(format!("`{name}` is `{value}`")),
            Some(_) => Err(format!("`{name}` is `{}`", text.escape_debug())),
            None => Err(format!("`{name}` is `{}`, not a number", text.escape_debug())),
        }
    }
}
