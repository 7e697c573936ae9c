//! Recognizes a file of another kind than the expected one.

use crate::diagnostic::Diagnostic;
use crate::document::{Document, Section};

/// Kinds of files: the table that only they have, their name, and how to pass them.
const KINDS: [(&str, &str, &str); 4] = [
    ("manipulator", "a spec", "pass a spec as the first argument: `abbe check SPEC`"),
    ("study", "a study", "pass a study with `--study FILE`"),
    ("data", "a map", "pass a map with `--map FILE`"),
    ("plan", "a plan", "pass a plan with `--sets FILE`"),
];

impl Document {
    /// Returns `true` if the file may be of the kind with the table `own`. If it is of another
    /// kind, that becomes its only diagnostic.
    pub fn is_kind(&mut self, root: &Section<'_>, own: &str) -> bool {
        let Some((_, expected, _)) = KINDS.iter().find(|(table, ..)| *table == own) else { return true };
        if root.get(own).is_some() {
            return true;
        }
        let other = KINDS.iter().find_map(|(table, what, help)| Some((root.get(table)?, what, help)));
        let Some((item, what, help)) = other else { return true };
        self.mistake(
            Diagnostic::new(item.key_span, format!("this file is {what}, not {expected}"))
                .label(format!("only {what} has this table"))
                .help(*help),
        );
        false
    }
}
