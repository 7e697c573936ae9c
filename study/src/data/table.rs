//! Rows to be written: a heading and numbers.

use serde::Serialize;

/// A table of numbers, for a CSV file.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Table {
    /// The names of its columns.
    pub heading: Vec<String>,
    /// Its rows; what was not measured is an empty field.
    pub rows: Vec<Vec<Option<f64>>>,
}

impl Table {
    /// As text: digits enough for a nanometre.
    pub fn csv(&self) -> String {
        let mut text = self.heading.join(",") + "\n";
        for row in &self.rows {
            let fields = row.iter().map(|value| value.map_or(String::new(), field));
            text += &(fields.collect::<Vec<_>>().join(",") + "\n");
        }
        text
    }
}

fn field(value: f64) -> String {
    let value = format!("{value:.9e}").parse::<f64>().unwrap_or(value);
    format!("{}", value + 0.0)
}
