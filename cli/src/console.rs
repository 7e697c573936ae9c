//! Messages of running jobs on stderr: notes and, on a terminal, a progress line for jobs that take
//! longer than a second. Work without a count shows the elapsed time instead.

use std::io::{IsTerminal, stderr, stdout};
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::thread;
use std::time::{Duration, Instant};

use abbe_report::text::WIDTH;
use abbe_study::Notes;
use indicatif::{HumanDuration, ProgressBar, ProgressStyle};
use terminal_size::{Width, terminal_size_of};

use crate::output::note;

/// Returns the number of columns of the terminal; [`WIDTH`] if stdout is none, so that files do not
/// depend on it.
pub(crate) fn width() -> usize {
    terminal_size_of(stdout()).map_or(WIDTH, |(Width(columns), _)| columns.into())
}

/// Time before progress is shown.
const PATIENCE: Duration = Duration::from_secs(1);

/// Refresh period of the line without a count.
const BEAT: Duration = Duration::from_millis(250);

/// Progress line at the bottom of the terminal.
struct Line {
    bar: Option<ProgressBar>,
    /// True if the bar has a count.
    counts: bool,
    /// Time of the last update of a count.
    counted: Option<Instant>,
    over: bool,
}

static LINE: Mutex<Line> = Mutex::new(Line { bar: None, counts: false, counted: None, over: false });

impl Line {
    fn hold() -> MutexGuard<'static, Self> {
        LINE.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Removes the line.
    fn clear(&mut self) {
        if let Some(bar) = self.bar.take() {
            bar.finish_and_clear();
        }
    }

    /// Returns the bar of this kind; replaces a bar of the other kind.
    fn show(&mut self, counts: bool, make: impl FnOnce() -> ProgressBar, template: &str) -> &ProgressBar {
        if self.counts != counts {
            self.clear();
        }
        self.counts = counts;
        self.bar.get_or_insert_with(|| {
            let bar = make();
            ProgressStyle::with_template(template).map_or(bar.clone(), |style| bar.with_style(style))
        })
    }
}

/// Starts the line for work without a count: reading, fitting, writing. It ends at [`done`].
pub(crate) fn watch() {
    if !stderr().is_terminal() {
        return;
    }
    let begun = Instant::now();
    // If the system cannot start another thread, there is no line.
    let _ = thread::Builder::new().spawn(move || {
        loop {
            thread::sleep(BEAT);
            let mut line = Line::hold();
            if line.over {
                return;
            }
            let silent = line.counted.unwrap_or(begun).elapsed();
            if silent > PATIENCE {
                let make = || ProgressBar::new_spinner().with_elapsed(begun.elapsed());
                line.show(false, make, "{spinner} running for {elapsed}, Ctrl-C stops").tick();
            }
        }
    });
}

/// Ends the progress line, before results are printed.
pub(crate) fn done() {
    let mut line = Line::hold();
    line.over = true;
    line.clear();
}

/// Shows the notes and the progress of a job on the terminal.
#[derive(Default)]
pub(crate) struct Console {
    /// Start of the current part of the work.
    begun: Option<Instant>,
}

impl Notes for Console {
    fn note(&mut self, text: &str) {
        let mut line = Line::hold();
        line.clear();
        note(&format!("note: {text}"));
    }

    fn warn(&mut self, text: &str) {
        let mut line = Line::hold();
        line.clear();
        note(&format!("warning: {text}"));
    }

    fn progress(&mut self, done: usize, total: usize) {
        let begun = *self.begun.get_or_insert_with(Instant::now);
        if done >= total {
            self.begun = None;
            return Line::hold().clear();
        }
        if begun.elapsed() < PATIENCE || !stderr().is_terminal() {
            return;
        }
        let mut line = Line::hold();
        line.counted = Some(Instant::now());
        let rest = format!("{:#}", HumanDuration(left(begun.elapsed(), done, total)));
        let make = || {
            let bar = ProgressBar::new(total as u64).with_elapsed(begun.elapsed());
            bar.with_position(done as u64).with_message(rest.clone())
        };
        let bar = line.show(true, make, "{bar:30} {pos} of {len} done, {msg} left, Ctrl-C stops");
        bar.set_message(rest.clone());
        bar.set_position(done as u64);
    }
}

/// Estimates the remaining time from the average pace so far, in whole seconds, at least one.
fn left(elapsed: Duration, done: usize, total: usize) -> Duration {
    let rest = total.saturating_sub(done) as f64 / done.max(1) as f64;
    Duration::from_secs((elapsed.as_secs_f64() * rest).ceil().max(1.0) as u64)
}

#[cfg(test)]
mod tests;
