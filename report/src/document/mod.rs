//! A report as a document: what it says, without the way in which it is shown.
//!
//! A view (`views`) builds the document of a job from its numbers, and knows no renderer. A
//! renderer (`terminal`, `html`) shows any document, and knows no job. `section` has the parts,
//! `table` tables, and `plain` signs in ASCII. Here are short lists of names, and the sentences of
//! a document by name, beside the numbers of its report.

mod plain;
mod section;
mod table;

pub use plain::plain;
pub(crate) use section::{Block, Card, Depth, Figure, Section};
pub(crate) use table::Table;

use std::collections::BTreeMap;

use abbe_study::RunRecord;
use serde::Serialize;

/// Report of a job, in sections.
#[derive(Clone, Debug, Default)]
pub struct Document {
    /// Kind of the report, such as `Errors from measurements`.
    pub(crate) kind: &'static str,
    /// Title of the machine.
    pub(crate) machine: String,
    /// Title of the study or of the map; may be empty.
    pub(crate) title: String,
    /// The result in one sentence.
    pub(crate) headline: String,
    /// Verdict on a tolerance or on limits, if there are any.
    pub(crate) verdict: Option<Verdict>,
    /// A person signs the page.
    pub(crate) is_signed: bool,
    /// Heading of the live panel on a page.
    pub(crate) panel: &'static str,
    /// Sections, those of the first screen first.
    pub(crate) sections: Vec<Section>,
    /// Stated entries, and the options of the run.
    pub(crate) record: RunRecord,
}

/// Verdict on a tolerance or on limits.
#[derive(Clone, Debug)]
pub(crate) struct Verdict {
    pub(crate) is_met: bool,
    pub(crate) text: String,
}

impl Document {
    /// Returns the machine and the result.
    pub(crate) fn first_line(&self) -> String {
        match self.machine.as_str() {
            "" => self.headline.clone(),
            machine => format!("{machine}: {}", self.headline),
        }
    }

    /// Returns the words of the first statement with a name; `None` if there is none.
    ///
    /// ```
    /// use abbe_study::{Machine, Study, analyze::Analyze};
    ///
    /// let machine = Machine::find("pps")?;
    /// let study = Study::find(None, &machine)?;
    /// let document = abbe_report::budget(&Analyze::new(machine, study).run(&mut ())?);
    /// assert_eq!(document.verdict(), Some("Verdict: not met"));
    /// let verdict = document.statement("verdict").unwrap_or_default();
    /// assert_eq!(verdict, "The verdict is on the machine as built, without compensation.");
    /// # Ok::<(), abbe_spec::diagnostic::Diagnostics>(())
    /// ```
    pub fn statement(&self, name: &str) -> Option<&str> {
        let mut statements = self.sections.iter().flat_map(Section::statements);
        statements.find(|statement| statement.name == name).map(|statement| statement.text.as_str())
    }

    /// Returns the verdict in one line; `None` if there is no tolerance and no limit.
    pub fn verdict(&self) -> Option<&str> {
        self.verdict.as_ref().map(|verdict| verdict.text.as_str())
    }

    /// Returns the first line of the document.
    pub fn headline(&self) -> &str {
        &self.headline
    }

    /// Iterates over the rows of the tables that have a column of a name.
    pub fn rows(&self, column: &str) -> impl Iterator<Item = &[String]> {
        let tables =
            self.sections.iter().flat_map(|section| &section.blocks).filter_map(|block| match block {
                Block::Table(table) => Some(table),
                _ => None,
            });
        let tables = tables.filter(move |table| table.columns.iter().any(|one| one.name == column));
        tables.flat_map(|table| &table.rows).map(Vec::as_slice)
    }

    /// Iterates over the names and the words of all statements.
    pub fn statements(&self) -> impl Iterator<Item = (&'static str, &str)> {
        let statements = self.sections.iter().flat_map(Section::statements);
        statements.map(|statement| (statement.name, statement.text.as_str()))
    }
}

/// Returns the first items of a list, separated by commas, and the number of the others.
pub(crate) fn first<T: AsRef<str>>(items: &[T], shown: usize) -> String {
    let names = joined(items.iter().take(shown));
    match items.len().saturating_sub(shown) {
        0 => names,
        more => format!("{names} and {more} more"),
    }
}

/// Returns items separated by commas.
pub(crate) fn joined<T: AsRef<str>>(items: impl IntoIterator<Item = T>) -> String {
    let items: Vec<T> = items.into_iter().collect();
    items.iter().map(AsRef::as_ref).collect::<Vec<&str>>().join(", ")
}

/// A report with the sentences of its document, which JSON and Python have.
#[derive(Debug, Serialize)]
pub struct Worded<'r, R> {
    #[serde(flatten)]
    report: &'r R,
    /// Sentences by their stable names.
    statements: BTreeMap<&'static str, String>,
}

impl Document {
    /// Adds the sentences to the numbers of the report: the answer as `answer`, and each statement
    /// by its name. Statements of one name are one text.
    pub fn worded<'r, R>(&self, report: &'r R) -> Worded<'r, R> {
        let mut statements = BTreeMap::from([("answer", self.first_line())]);
        for (name, text) in self.statements() {
            let words: &mut String = statements.entry(name).or_default();
            let separator = if words.is_empty() { "" } else { " " };
            *words += &format!("{separator}{}", text.replace(abbe_study::number::NO_BREAK, " "));
        }
        Worded { report, statements }
    }
}
