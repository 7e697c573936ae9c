//! A page of `docs/reference`: its tables of keys, and its example files.

use std::fs;
use std::path::PathBuf;

use abbe_spec::keys::Keys;

use super::example::Use;

/// Page of the reference.
pub(crate) struct Page {
    pub(crate) name: &'static str,
    path: PathBuf,
    text: String,
}

/// Row of a table: one key.
pub(crate) struct Row {
    /// Tables that the heading names, as `[tool]` and `[[frame]]`, or `the file`.
    pub(crate) tables: Vec<String>,
    pub(crate) key: String,
    /// Valid words, if the value is one of a few.
    pub(crate) choices: Vec<String>,
    /// Value, unit, default and description, as a page has them.
    pub(crate) facts: [String; 4],
    /// Value between backticks, or a reference to one.
    pub(crate) example: String,
    /// Message of a mistake, and its file.
    pub(crate) mistake: String,
    pub(crate) golden: String,
    line: usize,
}

impl Page {
    pub(crate) fn read(name: &'static str) -> Self {
        let path = folder().join(name);
        let text = fs::read_to_string(&path).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
        Self { name, path, text }
    }

    /// Returns every row of a table that begins with `key`.
    pub(crate) fn rows(&self) -> Vec<Row> {
        let (mut rows, mut tables, mut in_table) = (Vec::new(), Vec::new(), false);
        for (line, text) in self.text.lines().enumerate() {
            if text.starts_with('#') {
                tables = spans(text);
                if text.ends_with("the file") {
                    tables.push("the file".to_owned());
                }
            }
            in_table = text.starts_with('|') && (in_table || text.starts_with("| key |"));
            let cells: Vec<&str> = text.trim_matches('|').split(" | ").map(str::trim).collect();
            if !in_table || !cells[0].starts_with('`') {
                continue;
            }
            let [key, value, unit, default, example, what, mistake] = cells[..] else {
                panic!("{}:{}: a row of keys has seven cells, not {}", self.name, line + 1, cells.len());
            };
            let (mistake, golden) = mistake.rsplit_once("](").unwrap_or_default();
            rows.push(Row {
                tables: tables.clone(),
                key: key.trim_matches('`').to_owned(),
                choices: if value.starts_with("`\"") { spans(value) } else { Vec::new() },
                facts: [value, unit, default, what].map(str::to_owned),
                example: example.to_owned(),
                mistake: mistake.trim_start_matches('[').to_owned(),
                golden: golden.trim_end_matches(')').to_owned(),
                line,
            });
        }
        rows
    }

    /// Returns the names in the first cells below a heading.
    pub(crate) fn names(&self, heading: &str) -> Vec<String> {
        let below = self.text.lines().skip_while(|line| *line != heading).skip(1);
        let rows = below.take_while(|line| !line.starts_with('#')).filter(|line| line.starts_with("| `"));
        rows.flat_map(|row| spans(row.split(" | ").next().unwrap_or_default())).collect()
    }

    /// Returns the example files of the page: the blocks with a file name in the first line.
    pub(crate) fn files(&self) -> Vec<(&str, &str)> {
        let blocks = self.text.split("```").skip(1).step_by(2);
        let blocks = blocks.filter_map(|block| block.split_once('\n')).map(|(_, block)| block);
        blocks.filter_map(|block| Some((block.lines().next()?.strip_prefix("# ")?, block))).collect()
    }

    /// Writes the facts of the keys into their rows, and the messages of mistakes beside them.
    pub(crate) fn write(&self, tables: &[&Keys]) {
        let mut lines: Vec<String> = self.text.lines().map(str::to_owned).collect();
        for row in self.rows() {
            let [value, unit, default, what] = row.expected(tables).unwrap_or_else(|| row.facts.clone());
            let said = row.said().unwrap_or_else(|| "?".to_owned());
            let Row { key, example, golden, .. } = &row;
            lines[row.line] = format!(
                "| `{key}` | {value} | {unit} | {default} | {example} | {what} | [{said}]({golden}) |"
            );
        }
        fs::write(&self.path, lines.join("\n") + "\n").unwrap();
    }
}

impl Row {
    /// Returns the value, unit, default and description of the row's key.
    pub(crate) fn expected(&self, tables: &[&Keys]) -> Option<[String; 4]> {
        let table = self.tables.first()?;
        let own = tables.iter().filter(|keys| keys.tables.contains(&table.as_str()));
        let key = own.flat_map(|keys| &keys.keys).find(|key| key.name == self.key)?;
        Some([key.phrase.clone(), key.unit.into(), key.default.into(), key.what.into()])
    }

    /// Returns whether the row describes that key.
    pub(crate) fn describes(&self, key: &Use) -> bool {
        key.key == self.key && self.tables.iter().any(|table| key.is_in(table))
    }

    /// Returns the message of the row's mistake: the one that contains the key, or else the first.
    pub(crate) fn said(&self) -> Option<String> {
        let golden = folder().join(&self.golden);
        let text = fs::read_to_string(&golden).ok()?;
        let messages = text.lines().filter_map(|line| line.strip_prefix("error: ")).collect::<Vec<_>>();
        let own = messages.iter().find(|message| message.contains(&format!("`{}`", self.key)));
        own.or(messages.first()).map(|message| (*message).to_owned())
    }
}

fn folder() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../docs/reference")
}

/// Returns the texts between backticks.
fn spans(text: &str) -> Vec<String> {
    text.split('`').skip(1).step_by(2).map(str::to_owned).collect()
}
