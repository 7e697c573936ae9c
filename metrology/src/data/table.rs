//! Tables of numbers to be written.

use std::io;

use abbe_spec::csv_writer::{Csv, Heading};
use serde::Serialize;

/// A table of numbers for a CSV file.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Table {
    /// Names of the columns.
    pub heading: Vec<String>,
    /// Unit of each column in the heading of the file; shorter where the last columns have none.
    #[serde(skip)]
    pub units: Vec<String>,
    /// Rows, in the units of the map; a missing number is an empty cell.
    pub rows: Vec<Vec<Option<f64>>>,
    /// Texts of a first column, such as the station of each row; empty if there is none.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub labels: Vec<String>,
}

impl Table {
    /// Formats the table with a resolution of a nanometre. Cells that a spreadsheet would execute
    /// are escaped.
    pub fn csv(&self) -> String {
        let units = self.units.iter().map(String::as_str).chain(std::iter::repeat(""));
        let names = self.heading.iter().zip(units).map(|(name, unit)| match unit {
            "" => name.clone(),
            unit => format!("{name} ({unit})"),
        });
        let heading = Heading { names: names.collect(), labels: self.labels.clone() };
        let written = || -> io::Result<Vec<u8>> {
            let mut csv = Csv::new(Vec::new(), &heading)?;
            for (i, row) in self.rows.iter().enumerate() {
                csv.row(self.labels.get(i).map(String::as_str), row)?;
            }
            csv.finish()
        };
        // Writing to a vector cannot fail.
        String::from_utf8(written().unwrap_or_default()).unwrap_or_default()
    }
}
