//! A file of numbers of which nobody has said what they are.

use std::path::Path;

use abbe_codegen::diagnostic::Diagnostics;

use super::file::File;
use crate::mistake;

/// A row, cell by cell; none where there is no number.
type Row = Vec<Option<f64>>;

/// The names of all columns, and the rows.
pub(crate) fn numbers(path: &Path) -> Result<(Vec<String>, Vec<Row>), Diagnostics> {
    let file = File::open(path)?;
    let heading = file.heading.to_vec();
    if heading.iter().any(|name| name.parse::<f64>().is_ok()) {
        let message = "the first line of this file has numbers";
        let help = "give it a heading: a name for each column, such as q1, …, x, y, z, a, b, c";
        return Err(mistake::with_help(path.display(), message, help));
    }
    let mut rows = Vec::new();
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
        rows.push((0..heading.len()).map(|place| record.number(place).ok()).collect());
    }
    Ok((heading, rows))
}
