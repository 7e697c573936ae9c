//! How far a sweep is: a line on stderr, if somebody watches and it takes longer than a second.

use std::io::{IsTerminal, stderr};
use std::time::{Duration, Instant};

use indicatif::{ProgressBar, ProgressStyle};

/// How long nothing is shown.
const PATIENCE: Duration = Duration::from_secs(1);

/// The progress of a sweep; the line goes when it is dropped.
pub(crate) struct Progress {
    configurations: usize,
    begun: Instant,
    watched: bool,
    bar: Option<ProgressBar>,
}

impl Progress {
    /// Begins with none of so many configurations done.
    pub(crate) fn new(configurations: usize) -> Self {
        Self { configurations, begun: Instant::now(), watched: stderr().is_terminal(), bar: None }
    }

    /// Everything up to this configuration is done.
    pub(crate) fn reached(&mut self, index: usize) {
        if !self.watched || self.begun.elapsed() < PATIENCE {
            return;
        }
        let bar = self.bar.get_or_insert_with(|| {
            let bar = ProgressBar::new(self.configurations as u64).with_elapsed(self.begun.elapsed());
            let style =
                ProgressStyle::with_template("{bar:40} {percent} % of {len} configurations, {eta} left");
            style.map_or(bar.clone(), |style| bar.with_style(style))
        });
        bar.set_position(index as u64);
    }
}

impl Drop for Progress {
    fn drop(&mut self) {
        if let Some(bar) = &self.bar {
            bar.finish_and_clear();
        }
    }
}
