//! Progress, remarks and cancellation of a running job.

use crate::{diagnostic::Diagnostics, mistake};

/// Receives the remarks and the progress of a running job, and can stop it.
///
/// Every method has a default: `()` ignores all remarks and never stops a job.
pub trait Notes {
    /// Receives one sentence that readers of the report should know.
    fn note(&mut self, note: &str) {
        let _ = note;
    }

    /// Receives one sentence about something that makes the report unreliable.
    fn warn(&mut self, warning: &str) {
        let _ = warning;
    }

    /// Receives the number of configurations, rows or terms that are done, and their total.
    ///
    /// Called often. A job of several parts counts each part from 0.
    fn progress(&mut self, done: usize, total: usize) {
        let _ = (done, total);
    }

    /// Returns `true` to end the job now, without a report.
    fn stop(&self) -> bool {
        false
    }
}

impl Notes for () {}

impl dyn Notes + '_ {
    /// Returns an error if the job is to stop; jobs call it between two parts.
    pub fn go_on(&self) -> Result<(), Diagnostics> {
        if self.stop() {
            Err(mistake::with_help("abbe", "interrupted before the end", "run the command again"))
        } else {
            Ok(())
        }
    }
}
