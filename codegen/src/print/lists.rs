//! Lists of numbers that the loops of long chains read.

use crate::program::{Sums, Table};

/// A list of whole or real numbers.
pub(super) struct List<'r> {
    pub(super) name: String,
    pub(super) documentation: &'r str,
    values: Vec<f64>,
    pub(super) is_whole: bool,
}

impl List<'_> {
    /// Returns the numbers as text; `number` prints real ones.
    pub(super) fn entries(&self, number: impl Fn(f64) -> String) -> Vec<String> {
        let entry = |value: &f64| if self.is_whole { value.to_string() } else { number(*value) };
        self.values.iter().map(entry).collect()
    }
}

/// Returns the columns of tables, and the constants, entries, terms and factors of sums, without
/// empty lists.
pub(super) fn lists<'r>(
    tables: impl Iterator<Item = &'r Table>,
    sums: impl Iterator<Item = &'r Sums>,
) -> Vec<List<'r>> {
    let list = |name: &str, end: &str, documentation, is_whole, values: Vec<f64>| List {
        name: format!("{name}_{end}"),
        documentation,
        values,
        is_whole,
    };
    let columns = tables.flat_map(|Table { name, documentation, rows }| {
        let column = |column: usize| rows.iter().map(move |row| row[column] as f64).collect();
        [0, 1].map(|k| list(name, ["0", "1"][k], documentation, true, column(k)))
    });
    let parts = sums.flat_map(|Sums { name, constants, factors }| {
        let part = |take: fn(&(usize, usize, f64)) -> f64| factors.iter().map(take).collect();
        [
            list(name, "CONSTANTS", "Constant term of each entry.", false, constants.clone()),
            list(name, "ENTRIES", "Entries, counted from 0.", true, part(|row| row.0 as f64)),
            list(name, "TERMS", "Term of each of these entries.", true, part(|row| row.1 as f64)),
            list(name, "FACTORS", "Factor of each of these terms.", false, part(|row| row.2)),
        ]
    });
    columns.chain(parts).filter(|list| !list.values.is_empty()).collect()
}
