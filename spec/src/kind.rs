//! Recognizes a file of another kind than the expected one.

use crate::diagnostic::Diagnostic;
use crate::document::Section;
use crate::option::{MAP_FILE, NamedOption, SETS_FILE, STUDY_FILE};

/// Kinds of files: the table that only they have, their name, and how to pass them.
const KINDS: [(&str, &str, Option<NamedOption>); 4] = [
    ("manipulator", "a spec", None),
    ("study", "a study", Some(STUDY_FILE)),
    ("data", "a map", Some(MAP_FILE)),
    ("plan", "a plan", Some(SETS_FILE)),
];

impl Section<'_> {
    /// Returns `true` if the whole file may be of the kind with the table `own`. If it is of
    /// another kind, that becomes its only diagnostic.
    pub fn is_kind(&self, own: &str) -> bool {
        let Some((_, expected, _)) = KINDS.iter().find(|(table, ..)| *table == own) else { return true };
        if self.get(own).is_some() {
            return true;
        }
        let other = KINDS.iter().find_map(|(table, what, option)| Some((self.get(table)?, what, option)));
        let Some((item, what, option)) = other else { return true };
        let help = match option {
            Some(option) => format!("pass {what} with `{option}`"),
            None => "pass a spec as the first argument: `abbe check SPEC`".to_owned(),
        };
        let mistake = Diagnostic::new(item.key_span, format!("this file is {what}, not {expected}"));
        self.document.mistake(mistake.label(format!("only {what} has this table")).help(help));
        false
    }
}
