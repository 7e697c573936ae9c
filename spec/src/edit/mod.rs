//! Edits of specs and other TOML files as text, and the text of what is added to them.
//!
//! An [`Edits`] changes values, keys and tables of a file; everything that no edit touches stays
//! byte for byte. [`TableText`] and [`mod@write`] format new tables, with the quotes and the
//! digits that all written files have.

mod table_text;
pub mod write;

use std::fmt::Display;

use crate::diagnostic::Span;
use crate::document::{Document, Item, Section};

pub use self::table_text::TableText;

/// Edits of one file.
#[derive(Debug)]
pub struct Edits<'t> {
    text: &'t str,
    list: Vec<(Span, String)>,
}

impl<'t> Edits<'t> {
    /// Returns a file with the edits that `edit` makes; `None` if the text is not TOML, if `edit`
    /// returns none, or if two edits overlap.
    ///
    /// ```
    /// use abbe_spec::edit::Edits;
    ///
    /// let text = "[inputs]  # drift\nt = \"20 K\"\n\n# old\n[fitted]\nt = [1,\n[2]]\n";
    /// let edited = Edits::apply(text, |root, edits| {
    ///     edits.set(&root.get("inputs")?, "t", "\"21 K\"");
    ///     edits.set(&root.get("inputs")?, "u", 0);
    ///     edits.remove_tables(root, &["fitted"]);
    ///     Some(())
    /// });
    /// assert_eq!(edited.as_deref(), Some("[inputs]  # drift\nt = \"21 K\"\nu = 0\n\n"));
    /// let edited = Edits::apply("a = {}", |root, edits| {
    ///     edits.set(&root.get("a")?, "b", 1);
    ///     Some(())
    /// });
    /// assert_eq!(edited.as_deref(), Some("a = { b = 1 }"));
    /// ```
    pub fn apply(text: &'t str, edit: impl FnOnce(&Section<'_>, &mut Self) -> Option<()>) -> Option<String> {
        let document = Document::new("", text);
        let table = document.tables(text)?;
        let mut edits = Self { text, list: Vec::new() };
        edit(&Section::root(&table, &document), &mut edits)?;
        let Self { mut list, .. } = edits;
        list.sort_by_key(|(span, _)| span.start);
        let (mut new, mut end) = (String::new(), 0);
        for (span, with) in list {
            new += text.get(end..span.start)?;
            new += &with;
            end = span.end;
        }
        Some(new + text.get(end..)?)
    }

    /// Replaces a part of the text.
    pub fn replace(&mut self, span: Span, with: impl Display) {
        self.list.push((span, with.to_string()));
    }

    /// Inserts text at an offset.
    pub fn insert(&mut self, at: usize, text: impl Display) {
        self.replace(at..at, text);
    }

    /// Sets a key of a table: replaces its value, or inserts it behind the first key, in the form
    /// that the table has: inline, with a header, or with dotted keys.
    pub fn set(&mut self, table: &Item<'_>, key: &str, value: impl Display) {
        let Some(section) = table.as_table() else { return };
        if let Some(item) = section.get(key) {
            return self.replace(item.span(), value);
        }
        let first = section.items().find(|item| !self.has_header(item));
        let line_end = |at: usize| self.text[at..].find('\n').map_or(self.text.len(), |end| at + end);
        match first {
            Some(first) if self.is_inline(table) => {
                self.insert(first.span().end, format!(", {key} = {value}"));
            }
            None if self.is_inline(table) => {
                let separator = if section.items().next().is_some() { "," } else { "" };
                self.insert(table.span().start + 1, format!(" {key} = {value}{separator} "));
            }
            Some(first) => {
                let before = &self.text[..first.key_span.start];
                let prefix = &before[before.rfind('\n').map_or(0, |newline| newline + 1)..];
                self.insert(line_end(first.span().end), format!("\n{prefix}{key} = {value}"));
            }
            None => self.insert(line_end(table.span().end), format!("\n{key} = {value}")),
        }
    }

    /// Returns true if a table is written in braces.
    pub fn is_inline(&self, item: &Item<'_>) -> bool {
        item.is_table() && self.text[item.span()].starts_with('{')
    }

    fn has_header(&self, item: &Item<'_>) -> bool {
        self.text[item.span()].starts_with('[') && (item.is_table() || item.list().iter().any(Item::is_table))
    }

    /// Removes the tables and arrays of tables with these names, and the comments directly above
    /// their headers.
    pub fn remove_tables(&mut self, root: &Section<'_>, names: &[&str]) {
        let mut headers = Vec::new();
        for item in root.items() {
            self.add_headers(&item, names.contains(&item.key.as_str()), &mut headers);
        }
        headers.sort_unstable();
        let ends = headers.iter().skip(1).map(|(start, _)| *start).chain([self.text.len()]);
        let removed = headers.iter().zip(ends).filter(|((_, is_removed), _)| *is_removed);
        self.list.extend(removed.map(|((start, _), end)| (*start..end, String::new())));
    }

    /// Adds the start of each header below an item, with the comments above it.
    fn add_headers(&self, item: &Item<'_>, is_removed: bool, headers: &mut Vec<(usize, bool)>) {
        let tables = item.list().into_iter().chain(item.is_table().then(|| item.clone()));
        for table in tables.filter(Item::is_table) {
            if self.has_header(&table) {
                let above = self.text[..table.span().start].split_inclusive('\n').rev();
                let own =
                    above.take_while(|line| !line.ends_with('\n') || line.trim_start().starts_with('#'));
                headers.push((table.span().start - own.map(str::len).sum::<usize>(), is_removed));
            }
            let items = table.as_table().into_iter().flat_map(|section| section.items());
            items.for_each(|item| self.add_headers(&item, is_removed, headers));
        }
    }
}
