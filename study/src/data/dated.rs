//! Rows with the times at which they were measured.

use std::path::Path;

use abbe_codegen::diagnostic::Diagnostics;

use super::file::File;
use super::map::Map;
use super::rows::Data;

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
    pub fn read(file: &Path, map: &Map) -> Result<Self, Diagnostics> {
        let data = Data::read_wanted(file, map)?;
        let Some(column) = &map.time else { return Ok(Self { data, dates: None }) };
        let table = File::open(file)?;
        let place = table.heading.iter().position(|name| *name == column.name);
        let place = place.ok_or_else(|| map.missing(file, &[column], &table.heading))?;
        let mut dates = Vec::new();
        let mut rows = data.observations.iter().map(|row| row.line).peekable();
        for record in table.records() {
            let record = record?;
            if rows.next_if_eq(&record.line).is_some() {
                dates.push(record.text(place).to_owned());
            }
        }
        Ok(Self { data, dates: Some(dates) })
    }
}
