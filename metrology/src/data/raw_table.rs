//! Tables of numbers without a map.

use abbe_spec::diagnostic::Diagnostics;

use super::source::{Opened, Source};
use abbe_study::mistake;

/// Cells of a file or a table.
pub(crate) struct RawTable {
    /// Names of the columns.
    pub(crate) heading: Vec<String>,
    /// Numbers by row; NaN for a cell that is not a number.
    pub(crate) rows: Vec<Vec<f64>>,
    /// First line of each column with a cell that is not a number, and the reason.
    pub(crate) slips: Vec<Option<(u64, String)>>,
}

/// Reads all rows.
pub(crate) fn raw_table(source: Source<'_>) -> Result<RawTable, Diagnostics> {
    let Opened { heading, records, .. } = source.open()?;
    let heading = heading.to_vec();
    if source.file().is_some() && heading.iter().any(|name| name.parse::<f64>().is_ok()) {
        let message = "the first line of this file contains numbers";
        let help = "add a heading with a name for each column, such as q1, …, x, y, z, a, b, c";
        return Err(mistake::with_help(source.name(), message, help));
    }
    let (mut rows, mut slips) = (Vec::new(), vec![None; heading.len()]);
    for record in records {
        let record = record?;
        if let Some(reason) = record.too_long() {
            let message = format!("line {}: {reason}", record.line);
            let help = "write one row of numbers in every line below the heading";
            return Err(mistake::with_help(source.name(), message, help));
        }
        let cell = |(place, slip): (usize, &mut Option<(u64, String)>)| {
            record.number(place).unwrap_or_else(|reason| {
                slip.get_or_insert((record.line, reason));
                f64::NAN
            })
        };
        rows.push(slips.iter_mut().enumerate().map(cell).collect());
    }
    Ok(RawTable { heading, rows, slips })
}
