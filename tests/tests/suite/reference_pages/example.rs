//! The keys that an example file uses, and the same file without one of them.

use std::ops::Range;

use toml::de::{DeTable, DeValue};

/// A key where it stands in an example.
pub(crate) struct Use {
    /// The tables that it is in, from the file inwards; lists are left out.
    pub(crate) tables: Vec<String>,
    pub(crate) key: String,
    /// The value as it is written.
    pub(crate) value: String,
    /// Where `key = value` stands, if it is written so.
    place: Option<Range<usize>>,
}

/// Every key of a file.
pub(crate) fn uses(text: &str) -> Vec<Use> {
    let mut found = Vec::new();
    let tables = DeTable::parse(text).unwrap_or_else(|error| panic!("{error}"));
    walk(tables.get_ref(), &[], text, &mut found);
    found
}

fn walk(table: &DeTable<'_>, tables: &[String], text: &str, found: &mut Vec<Use>) {
    for (key, value) in table {
        let (from, at) = (key.span(), value.span());
        let key = key.get_ref().to_string();
        let written = text.get(from.end..at.start).is_some_and(|between| between.trim() == "=");
        found.push(Use {
            tables: tables.to_vec(),
            key: key.clone(),
            value: text[at.clone()].to_owned(),
            place: written.then_some(from.start..at.end),
        });
        let inner = [tables, &[key]].concat();
        match value.get_ref() {
            DeValue::Table(table) => walk(table, &inner, text, found),
            DeValue::Array(items) => {
                for item in items.iter() {
                    if let DeValue::Table(table) = item.get_ref() {
                        walk(table, &inner, text, found);
                    }
                }
            }
            _ => {}
        }
    }
}

impl Use {
    /// Whether it is in that table: `NAME` is any name, and what a table stands in need not be said.
    pub(crate) fn is_in(&self, table: &str) -> bool {
        if table == "the file" {
            return self.tables.is_empty();
        }
        let names: Vec<&str> = table.trim_matches(['[', ']']).split('.').collect();
        let Some(before) = self.tables.len().checked_sub(names.len()) else { return false };
        self.tables[before..].iter().zip(&names).all(|(own, name)| own == name || *name == "NAME")
            // `[source.beam]` is not the `beam` of `[[source.effect]]`, but `[workspace]` that of a figure too.
            && (before == 0 || names[0] == "workspace")
    }

    /// The file with another value, if that can be written.
    pub(crate) fn replaced(&self, text: &str, value: &str) -> Option<String> {
        let Range { start, end } = self.place.clone()?;
        Some(format!("{}{} = {value}{}", &text[..start], self.key, &text[end..]))
    }

    /// The file without it, if that can be written.
    pub(crate) fn removed(&self, text: &str) -> Option<String> {
        let Range { start, end } = self.place.clone()?;
        let (before, after) = (&text[..start], &text[end..]);
        if let Some(after) = after.trim_start_matches(' ').strip_prefix(',') {
            return Some(format!("{before}{after}"));
        }
        // The last entry of an inline table.
        let before = before.trim_end_matches(' ');
        Some(format!("{}{after}", before.strip_suffix(',').unwrap_or(before)))
    }
}
