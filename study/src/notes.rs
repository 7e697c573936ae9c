//! What a job says on the way, and whether it is to stop.

use abbe_spec::diagnostic::Diagnostics;

use crate::mistake;

/// Whoever started a job.
///
/// Every function has an answer of its own: `()` hears nothing and never stops a job.
pub trait Notes {
    /// Something that a reader of the report should know: one sentence.
    fn note(&mut self, note: &str) {
        let _ = note;
    }

    /// Something that makes the report doubtful: one sentence.
    fn warn(&mut self, warning: &str) {
        let _ = warning;
    }

    /// So many of all configurations, rows or terms are done; said often, and from 0 on again where a job has several parts.
    fn progress(&mut self, done: usize, total: usize) {
        let _ = (done, total);
    }

    /// Whether the job is to end now, without a report.
    fn stop(&self) -> bool {
        false
    }
}

impl Notes for () {}

impl dyn Notes + '_ {
    /// Ends a job that is to stop: for the places between two parts of it.
    pub fn go_on(&self) -> Result<(), Diagnostics> {
        if self.stop() {
            Err(mistake::with_help("abbe", "stopped before the end", "start it again"))
        } else {
            Ok(())
        }
    }
}
