//! What jobs say on the way: to stderr.

use abbe_study::Notes;

use crate::output;

/// Says everything on stderr.
pub(crate) struct Stderr;

impl Notes for Stderr {
    fn note(&mut self, note: &str) {
        output::note(note);
    }

    fn warn(&mut self, warning: &str) {
        output::note(warning);
    }
}
