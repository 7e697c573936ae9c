//! Rows, and what their times count.

use abbe_spec::diagnostic::Diagnostics;

use super::date::{Calendar, parse_date};
use super::map::Map;
use super::rows::Data;
use super::source::Source;

/// The rows of a file, and what its column of dates counts.
#[derive(Clone, Debug)]
pub struct Dated {
    /// The rows.
    pub data: Data,
    /// Whether dates or days stand in the column of dates, row by row; nothing if the map names none.
    pub calendars: Option<Vec<Calendar>>,
}

impl Dated {
    /// Reads what was commanded, what was measured, and when. A row may be there twice.
    pub fn read<'a>(source: impl Into<Source<'a>>, map: &Map) -> Result<Self, Diagnostics> {
        let source = source.into();
        let data = Data::read_wanted(source, map)?;
        let Some(column) = &map.time else { return Ok(Self { data, calendars: None }) };
        let table = source.open()?;
        let place = table.heading.iter().position(|name| *name == column.name);
        let place = place.ok_or_else(|| map.missing(&source.name(), &[column], &table.heading))?;
        let mut calendars = Vec::with_capacity(data.observations.len());
        let mut rows = data.observations.iter().map(|row| row.line).peekable();
        for record in table.records {
            let record = record?;
            if rows.next_if_eq(&record.line).is_some() {
                let date = parse_date(&record.text(place));
                calendars.push(date.map_or(Calendar::Days, |(calendar, _)| calendar));
            }
        }
        Ok(Self { data, calendars: Some(calendars) })
    }
}
