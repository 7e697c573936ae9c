//! Text of a table: its header, and a line for each key.

use std::fmt::{self, Display, Write};

use super::write::quoted;

/// Lines of a table.
///
/// ```
/// use abbe_spec::edit::TableText;
///
/// let text = TableText::with_header("[[load]]").text("name", "tool").key("mass", 3).to_string();
/// assert_eq!(text, "[[load]]\nname = \"tool\"\nmass = 3\n");
/// ```
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct TableText(String);

impl TableText {
    /// Begins a table with its header.
    pub fn with_header(header: &str) -> Self {
        Self(format!("{header}\n"))
    }

    /// Adds a key with the text of its value.
    pub fn key(mut self, key: &str, value: impl Display) -> Self {
        let _ = writeln!(self.0, "{key} = {value}");
        self
    }

    /// Adds a key whose value is a string.
    pub fn text(self, key: &str, value: &str) -> Self {
        self.key(key, quoted(value))
    }

    /// Adds a key that not every table has.
    pub fn optional(self, key: &str, value: Option<impl Display>) -> Self {
        match value {
            Some(value) => self.key(key, value),
            None => self,
        }
    }

    /// Returns the keys as an inline table.
    pub fn inline(&self) -> String {
        format!("{{ {} }}", self.0.trim_end().replace('\n', ", "))
    }

    /// Adds the lines of other keys, or of tables.
    pub fn then(mut self, lines: impl Display) -> Self {
        let _ = write!(self.0, "{lines}");
        self
    }
}

impl Display for TableText {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.0)
    }
}
