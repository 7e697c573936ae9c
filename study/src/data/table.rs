//! Rows to be written: a heading and numbers.

use serde::Serialize;

/// A table of numbers, for a CSV file.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Table {
    /// The names of its columns.
    pub heading: Vec<String>,
    /// Its rows; what was not measured is an empty field.
    pub rows: Vec<Vec<Option<f64>>>,
    /// The texts of a column before the others, such as the station of every row; none if there is no such column.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub labels: Vec<String>,
}

impl Table {
    /// As text: digits enough for a nanometre.
    pub fn csv(&self) -> String {
        let mut text = self.heading.join(",") + "\n";
        for (i, row) in self.rows.iter().enumerate() {
            let label = self.labels.get(i).map(|label| quoted(label));
            let fields = row.iter().map(|value| value.map_or(String::new(), field));
            let fields = label.into_iter().chain(fields);
            text += &(fields.collect::<Vec<_>>().join(",") + "\n");
        }
        text
    }
}

/// A text as a field: in quotes where it needs them.
fn quoted(text: &str) -> String {
    match text.contains([',', '"', '\n', '\r', '#']) {
        true => format!("\"{}\"", text.replace('"', "\"\"")),
        false => text.to_owned(),
    }
}

fn field(value: f64) -> String {
    let value = format!("{value:.9e}").parse::<f64>().unwrap_or(value);
    format!("{}", value + 0.0)
}
