//! Rows with the calendar of their times.

use abbe_spec::diagnostic::Diagnostics;

use super::map::Map;
use super::rows::Data;
use super::source::Source;
use abbe_study::date::{Calendar, parse_date};

/// Rows of a file, and the calendar of its column of times.
#[derive(Clone, Debug)]
pub struct Dated {
    /// The rows.
    pub data: Data,
    /// Calendar of each row; none if the map names no column of times.
    pub calendars: Option<Vec<Calendar>>,
}

impl Dated {
    /// Reads commands, measurements and times. Repeated rows are kept.
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
