//! Keys used by an example file, and the file without one of them.

use std::ops::Range;

use toml::de::{DeTable, DeValue};

/// Occurrence of a key in an example.
pub(crate) struct Use {
    /// Tables that contain it, from the file inwards, without array indices.
    pub(crate) tables: Vec<String>,
    pub(crate) key: String,
    /// Value as written.
    pub(crate) value: String,
    /// Position of `key = value`, if it has this form.
    place: Option<Range<usize>>,
}

/// Returns every key of a file.
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
    /// Returns whether the key is in that table. `NAME` matches any name, and outer tables may be
    /// omitted.
    pub(crate) fn is_in(&self, table: &str) -> bool {
        if table == "the file" {
            return self.tables.is_empty();
        }
        let names: Vec<&str> = table.trim_matches(['[', ']']).split('.').collect();
        let Some(before) = self.tables.len().checked_sub(names.len()) else { return false };
        self.tables[before..].iter().zip(&names).all(|(own, name)| own == name || *name == "NAME")
            // `[source.beam]` is not the `beam` of `[[source.effect]]`, but `[workspace]` is also
            // that of a figure.
            && (before == 0 || names[0] == "workspace")
    }

    /// Returns the file with another value, if the key can be replaced.
    pub(crate) fn replaced(&self, text: &str, value: &str) -> Option<String> {
        let Range { start, end } = self.place.clone()?;
        Some(format!("{}{} = {value}{}", &text[..start], self.key, &text[end..]))
    }

    /// Returns the file without the key, if it can be removed.
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
