//! Which of our files a file is, if it is not the one that was to be read.

use crate::diagnostic::Diagnostic;
use crate::document::{Document, Section};

/// The files that are read: the table that only they have, what they are, and how they are given.
const KINDS: [(&str, &str, &str); 4] = [
    ("manipulator", "a spec", "a spec is the first argument of a command: `abbe check SPEC`"),
    ("study", "a study", "give a study by `--study FILE`, after its spec"),
    ("data", "a map", "give a map by `--map FILE`, after its spec"),
    ("plan", "a plan", "give a plan by `--sets FILE`, after its spec and map"),
];

impl Document {
    /// Whether the file can be what is to be read, which has the table `own`. If it is another kind of file, that is
    /// its one mistake.
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
