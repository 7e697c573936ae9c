//! Rows with the times at which they were measured.

use abbe_codegen::diagnostic::Diagnostics;

use super::map::Map;
use super::rows::Data;
use super::source::Source;

/// The rows of a file, and what stands in its column of dates.
#[derive(Clone, Debug)]
pub struct Dated {
    /// The rows.
    pub data: Data,
    /// What stands in the column of dates, row by row; nothing if the map names none.
    pub dates: Option<Vec<String>>,
}

impl Dated {
    /// Reads what was commanded, what was measured, and when. A row may be there twice.
    pub fn read<'a>(source: impl Into<Source<'a>>, map: &Map) -> Result<Self, Diagnostics> {
        let source = source.into();
        let data = Data::read_wanted(source, map)?;
        let Some(column) = &map.time else { return Ok(Self { data, dates: None }) };
        let table = source.open()?;
        let place = table.heading.iter().position(|name| *name == column.name);
        let place = place.ok_or_else(|| map.missing(&source.name(), &[column], &table.heading))?;
        let mut dates = Vec::new();
        let mut rows = data.observations.iter().map(|row| row.line).peekable();
        for record in table.records {
            let record = record?;
            if rows.next_if_eq(&record.line).is_some() {
                dates.push(record.text(place).into_owned());
            }
        }
        Ok(Self { data, dates: Some(dates) })
    }
}
