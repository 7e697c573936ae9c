//! A file of numbers of which nobody has said what they are.

use std::path::Path;

use abbe_codegen::diagnostic::Diagnostics;

use super::file::File;
use crate::mistake;

/// The cells of a file.
pub(crate) struct Numbers {
    /// The names of the columns.
    pub(crate) heading: Vec<String>,
    /// Row by row; NaN where there is no number.
    pub(crate) rows: Vec<Vec<f64>>,
    /// Of every column the first line in which it has no number, and why.
    pub(crate) slips: Vec<Option<(u64, String)>>,
}

/// All rows of a file.
pub(crate) fn numbers(path: &Path) -> Result<Numbers, Diagnostics> {
    let file = File::open(path)?;
    let heading = file.heading.to_vec();
    if heading.iter().any(|name| name.parse::<f64>().is_ok()) {
        let message = "the first line of this file has numbers";
        let help = "give it a heading: a name for each column, such as q1, …, x, y, z, a, b, c";
        return Err(mistake::with_help(path.display(), message, help));
    }
    let (mut rows, mut slips) = (Vec::new(), vec![None; heading.len()]);
    for record in file.records() {
        let record = record?;
        if let Some(reason) = record.too_long() {
            let message = format!("line {}: {reason}", record.line);
            return Err(mistake::with_help(
                path.display(),
                message,
                "one row of numbers in every line below the heading",
            ));
        }
        let cell = |(place, slip): (usize, &mut Option<(u64, String)>)| {
            record.number(place).unwrap_or_else(|reason| {
                slip.get_or_insert((record.line, reason));
                f64::NAN
            })
        };
        rows.push(slips.iter_mut().enumerate().map(cell).collect());
    }
    Ok(Numbers { heading, rows, slips })
}
