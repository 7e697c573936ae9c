//! A report as a document: what it says, without the way in which it is shown.
//!
//! A view (`views`) builds the document of a job from its numbers, and knows no renderer. A
//! renderer (`terminal`, `html`) shows any document, and knows no job. `section` has the parts,
//! `table` tables, `list` short lists of names, `plain` signs in ASCII, and `worded` the sentences
//! beside the numbers.

mod list;
mod plain;
mod section;
mod table;
mod worded;

use abbe_study::RunRecord;

pub(crate) use list::{first, joined};
pub use plain::plain;
pub(crate) use section::{Block, Card, Depth, Figure, Section};
pub(crate) use table::Table;
pub use worded::Worded;

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
