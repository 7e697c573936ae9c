//! Sentences of a document by name, beside the numbers of its report.

use std::collections::BTreeMap;

use serde::Serialize;

use super::Document;

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
