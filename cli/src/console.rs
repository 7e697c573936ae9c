//! What jobs say while they work: notes on stderr, and how far they are, if somebody watches and it takes longer than a second.

use std::io::{IsTerminal, stderr};
use std::time::{Duration, Instant};

use abbe_study::Notes;
use indicatif::{ProgressBar, ProgressStyle};

use crate::output::note;

/// How long nothing is shown.
const PATIENCE: Duration = Duration::from_secs(1);

/// Whoever watches a job from a terminal.
#[derive(Default)]
pub(crate) struct Console {
    /// When the first part of the work that is shown began.
    begun: Option<Instant>,
    bar: Option<ProgressBar>,
}

impl Console {
    /// Takes the line of the progress away.
    fn clear(&mut self) {
        if let Some(bar) = self.bar.take() {
            bar.finish_and_clear();
        }
    }
}

impl Notes for Console {
    fn note(&mut self, text: &str) {
        self.clear();
        note(&format!("note: {text}"));
    }

    fn warn(&mut self, text: &str) {
        self.clear();
        note(&format!("warning: {text}"));
    }

    fn progress(&mut self, done: usize, total: usize) {
        let begun = *self.begun.get_or_insert_with(Instant::now);
        if done >= total {
            self.begun = None;
            return self.clear();
        }
        if begun.elapsed() < PATIENCE || !stderr().is_terminal() {
            return;
        }
        let bar = self.bar.get_or_insert_with(|| {
            let bar = ProgressBar::new(total as u64).with_elapsed(begun.elapsed());
            let style = ProgressStyle::with_template(
                "{bar:30} {pos} of {len} configurations, {eta} left, Ctrl-C ends it",
            );
            style.map_or(bar.clone(), |style| bar.with_style(style))
        });
        bar.set_position(done as u64);
    }
}

impl Drop for Console {
    fn drop(&mut self) {
        self.clear();
    }
}
